// SPDX-License-Identifier: MIT
#include "assets/calibration/crude_mesh.h"

#include <algorithm>

namespace ego {
namespace {

using Corners = std::array<Vec3, 3>;

Corners CornersOf(const SamplePlaces& places, std::size_t triangle) {
  const SampleTriangle& t = SampleTriangles()[triangle];
  return {places[Index(t[0])], places[Index(t[1])], places[Index(t[2])]};
}

double SoundnessOf(const Corners& p, const Corners& usual, const Vec3& middle) {
  const Vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double area2 = glm::length(cross);
  const double longest =
      std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
  if (!(longest > 0.0) || area2 < 0.02 * longest * longest) return 0.0;
  const Vec3 normal = cross / area2;
  const Vec3 usual_normal = glm::normalize(glm::cross(usual[1] - usual[0], usual[2] - usual[0]));
  const Vec3 out = (p[0] + p[1] + p[2]) / 3.0 - middle;
  const double outward = glm::dot(normal, out) / std::max(glm::length(out), 1e-12);
  return std::max(glm::dot(normal, usual_normal), 0.5 * outward);
}

/// Whether an edge passes through the inside of a triangle.
bool Pierces(const Vec3& from, const Vec3& to, const Corners& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double a = glm::dot(from - t[0], normal);
  const double b = glm::dot(to - t[0], normal);
  if (!(a * b < 0.0)) return false;
  const Vec3 at = from + a / (a - b) * (to - from);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = t[k];
    const Vec3& q = t[(k + 1) % 3];
    if (!(glm::dot(glm::cross(q - p, at - p), normal) > 0.0)) return false;
  }
  return true;
}

bool Cross(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (Pierces(a[k], a[(k + 1) % 3], b) || Pierces(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

}  // namespace

std::array<double, kTriangleCount> Soundness(const SamplePlaces& places,
                                             const SamplePlaces& usual) {
  Vec3 trunk{0.0};
  Vec3 head{0.0};
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    if (i < kTrunkSampleCount) {
      trunk += places[i] / static_cast<double>(kTrunkSampleCount);
    } else {
      head += places[i] / static_cast<double>(kSampleCount - kTrunkSampleCount);
    }
  }
  std::array<double, kTriangleCount> sound{};
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    sound[t] = SoundnessOf(CornersOf(places, t), CornersOf(usual, t),
                           t < kTrunkTriangleCount ? trunk : head);
  }
  return sound;
}

std::vector<std::pair<std::size_t, std::size_t>> CrossingTriangles(const SamplePlaces& places) {
  std::vector<std::pair<std::size_t, std::size_t>> crossing;
  const auto share_a_corner = [](const SampleTriangle& a, const SampleTriangle& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](SamplePoint p) { return std::find(b.begin(), b.end(), p) != b.end(); });
  };
  for (std::size_t i = 0; i < kTriangleCount; ++i) {
    const std::size_t end = i < kTrunkTriangleCount ? kTrunkTriangleCount : kTriangleCount;
    for (std::size_t j = i + 1; j < end; ++j) {
      if (share_a_corner(SampleTriangles()[i], SampleTriangles()[j])) continue;
      if (Cross(CornersOf(places, i), CornersOf(places, j))) crossing.emplace_back(i, j);
    }
  }
  return crossing;
}

}  // namespace ego
