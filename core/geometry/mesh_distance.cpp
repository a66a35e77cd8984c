// SPDX-License-Identifier: MIT
#include "core/geometry/mesh_distance.h"

#include <cmath>
#include <limits>

#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Triangles this many times farther (as squares, with the smoothing) than the nearest weigh less
/// than 1.6e-5 of it and are left out: the distance changes by micrometres.
constexpr double kNegligible = 16.0;

double SquareDistance(const Triangle& triangle, const Vec3& p) {
  const Vec3 away = p - AtBarycentric(triangle, ClosestOnTriangle(triangle, p));
  return glm::dot(away, away);
}

/// Square of a distance from a point beyond which no triangle counts.
double SquareHorizon(std::span<const Triangle> mesh, const Vec3& p, double e2) {
  double least = std::numeric_limits<double>::max();
  const Triangle* nearest = nullptr;
  for (const Triangle& triangle : mesh) {
    const Vec3 d = p - triangle.center;
    const double square = glm::dot(d, d);
    if (square < least) {
      least = square;
      nearest = &triangle;
    }
  }
  return nearest == nullptr ? 0.0 : kNegligible * (SquareDistance(*nearest, p) + e2);
}

}  // namespace

SignedDistance SmoothMeshDistance(std::span<const Triangle> mesh, const Vec3& p, double epsilon,
                                  double width) {
  const double e2 = epsilon * epsilon;
  double weight_sum = 0.0;
  double plane_sum = 0.0;
  double square_sum = 0.0;
  Vec3 normal_sum{0.0};
  Vec3 away_sum{0.0};
  const double horizon = std::sqrt(SquareHorizon(mesh, p, e2));
  for (const Triangle& triangle : mesh) {
    const Vec3 from_center = p - triangle.center;
    const double bound = horizon + triangle.reach;
    if (glm::dot(from_center, from_center) > bound * bound) continue;
    const double height = glm::dot(triangle.normal, from_center);
    if (std::abs(height) > horizon) continue;
    const Vec3 away = p - AtBarycentric(triangle, ClosestOnTriangle(triangle, p));
    const double square = glm::dot(away, away);
    const double ratio = e2 / (square + e2);
    const double ratio2 = ratio * ratio;
    const double weight = triangle.area * ratio2 * ratio2;
    weight_sum += weight;
    plane_sum += weight * height;
    square_sum += weight * square;
    normal_sum += weight * triangle.normal;
    away_sum += weight * away;
  }
  if (!(weight_sum > 0.0)) return {width, Vec3{0.0}};
  const double plane = plane_sum / weight_sum;
  const double away = std::sqrt(square_sum / weight_sum);
  const double outside =
      1.0 - (1.0 - Smoothstep(plane / (2.0 * epsilon))) * (1.0 - Smoothstep(away / width - 1.0));
  const Vec3 away_gradient =
      away > 1e-12 ? away_sum / (weight_sum * away) : normal_sum / weight_sum;
  return {plane + outside * (away - plane),
          glm::mix(normal_sum / weight_sum, away_gradient, outside)};
}

Box Box::Of(std::span<const Triangle> mesh) {
  if (mesh.empty()) return {};
  Box box{mesh[0].a, mesh[0].a};
  for (const Triangle& triangle : mesh) {
    for (const Vec3& p : {triangle.a, triangle.b, triangle.c}) {
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  }
  return box;
}

double Box::Distance(const Vec3& p) const {
  return glm::length(glm::max(Vec3{0.0}, glm::max(low - p, p - high)));
}

}  // namespace ego
