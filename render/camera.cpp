// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace ego {
namespace {

constexpr double kMaxPitch = 0.5 * kPi;
constexpr double kMinDistance = 0.05;
constexpr double kMaxDistance = 500.0;
constexpr double kWheelStep = 1.12;

double Aspect(ViewportSize size) {
  if (size.width <= 0 || size.height <= 0) return 1.0;
  return static_cast<double>(size.width) / static_cast<double>(size.height);
}

}  // namespace

Vec3 Camera::Forward() const {
  return {-std::cos(pitch) * std::sin(yaw), -std::sin(pitch), -std::cos(pitch) * std::cos(yaw)};
}
// From the yaw alone, so that it is defined at the poles.
Vec3 Camera::Right() const { return {std::cos(yaw), 0.0, -std::sin(yaw)}; }
Vec3 Camera::Up() const { return glm::cross(Right(), Forward()); }
Vec3 Camera::Position() const { return target_ws - distance * Forward(); }

Mat4 Camera::View() const {
  const Vec3 r = Right(), u = Up(), f = Forward(), p = Position();
  Mat4 view{1.0};
  for (int i = 0; i < 3; ++i) {
    view[i][0] = r[i];
    view[i][1] = u[i];
    view[i][2] = -f[i];
  }
  view[3] = Vec4{-glm::dot(r, p), -glm::dot(u, p), glm::dot(f, p), 1.0};
  return view;
}

double Camera::Near() const { return std::clamp(0.02 * distance, 0.005, 0.5); }
double Camera::Far() const { return std::max(120.0, 4.0 * distance); }

Mat4 Camera::Projection(ViewportSize size) const {
  return glm::perspective(fov_y, Aspect(size), Near(), Far());
}

std::optional<Vec3> Camera::Project(const Vec3& point_ws, ViewportSize size) const {
  if (size.width <= 0 || size.height <= 0) return std::nullopt;
  const Vec3 d = point_ws - Position();
  const double depth = glm::dot(d, Forward());
  if (depth < Near()) return std::nullopt;
  const double focal = 0.5 * size.height / std::tan(0.5 * fov_y);  // pixels
  return Vec3{0.5 * size.width + focal * glm::dot(d, Right()) / depth,
              0.5 * size.height - focal * glm::dot(d, Up()) / depth, depth};
}

Vec3 Camera::RayThrough(const Vec2& pixel, ViewportSize size) const {
  const double slope = 2.0 * std::tan(0.5 * fov_y) / std::max(1, size.height);
  return glm::normalize(Forward() + slope * (pixel.x - 0.5 * size.width) * Right() -
                        slope * (pixel.y - 0.5 * size.height) * Up());
}

double Camera::MetresPerPixel(ViewportSize size) const {
  return 2.0 * distance * std::tan(0.5 * fov_y) / std::max(1, size.height);
}

void Camera::Orbit(const Vec2& drag, ViewportSize size) {
  const double angle = kPi / std::max(1, size.height);
  yaw = std::remainder(yaw - angle * drag.x, 2.0 * kPi);
  pitch = std::clamp(pitch + angle * drag.y, -kMaxPitch, kMaxPitch);
}

void Camera::Pan(const Vec2& drag, ViewportSize size) {
  target_ws += MetresPerPixel(size) * (drag.y * Up() - drag.x * Right());
}

void Camera::Zoom(double steps, const Vec2& cursor, ViewportSize size) {
  const double before = distance;
  distance = std::clamp(distance * std::pow(kWheelStep, -steps), kMinDistance, kMaxDistance);
  const Vec2 from_center = cursor - 0.5 * Vec2{size.width, size.height};
  const double metres = MetresPerPixel(size) * (before / distance - 1.0);
  target_ws += metres * (from_center.x * Right() - from_center.y * Up());
}

void Camera::Frame(const Box3& box, ViewportSize size, double margin) {
  if (box.IsEmpty()) return;
  // Every corner p (relative to the target) bounds the distance d from below on each side:
  // |p.right| <= (d + p.forward) * tan(half angle). The target then moves in the picture plane
  // until both opposite bounds agree, which perspective makes a small linear programme; a few
  // rounds of centring solve it closely.
  const double tan_y = std::tan(0.5 * fov_y) * (1.0 - 2.0 * std::clamp(margin, 0.0, 0.45));
  const double tan_x = tan_y * Aspect(size);
  const Vec3 r = Right(), u = Up(), f = Forward();
  target_ws = box.Center();
  std::array<Vec3, 8> corner;
  for (unsigned i = 0; i < 8; ++i) {
    corner[i] = {(i & 1u) != 0u ? box.max.x : box.min.x, (i & 2u) != 0u ? box.max.y : box.min.y,
                 (i & 4u) != 0u ? box.max.z : box.min.z};
  }
  double needed = kMinDistance;
  for (int round = 0; round < 12; ++round) {
    needed = kMinDistance;
    for (const Vec3& c : corner) {
      const Vec3 p = c - target_ws;
      const double depth = glm::dot(p, f);
      needed = std::max({needed, std::abs(glm::dot(p, r)) / tan_x - depth,
                         std::abs(glm::dot(p, u)) / tan_y - depth});
    }
    Vec2 low{1e300}, high{-1e300};  // slopes at which the corners appear from that distance
    for (const Vec3& c : corner) {
      const Vec3 p = c - target_ws;
      const double depth = std::max(needed + glm::dot(p, f), kMinDistance);
      const Vec2 slope{glm::dot(p, r) / depth, glm::dot(p, u) / depth};
      low = glm::min(low, slope);
      high = glm::max(high, slope);
    }
    target_ws += needed * 0.5 * ((low.x + high.x) * r + (low.y + high.y) * u);
  }
  distance = std::clamp(needed, kMinDistance, kMaxDistance);
}

void Camera::Look(StandardView view) {
  switch (view) {
    case StandardView::kThreeQuarter:
      yaw = Camera{}.yaw;
      pitch = Camera{}.pitch;
      return;
    case StandardView::kFront:
      yaw = pitch = 0.0;
      return;
    case StandardView::kSide:
      yaw = 0.5 * kPi;
      pitch = 0.0;
      return;
    case StandardView::kTop:
      yaw = 0.0;
      pitch = kMaxPitch;
      return;
  }
}

}  // namespace ego
