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

/// Square of a distance from a point beyond which no triangle counts.
double SquareHorizon(std::span<const TrianglePair> mesh, const Lanes3& p, double e2) {
  Lanes least = Splat(std::numeric_limits<double>::max());
  Lanes nearest{};
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    const Lanes3 d = p - mesh[k].center;
    const Lanes square = Dot(d, d);
    nearest = Select(square < least, Splat(static_cast<double>(k)), nearest);
    least = Min(least, square);
  }
  const std::size_t lane = least[1] < least[0] ? 1 : 0;
  const Lanes3 away = ClosestOnPair(mesh[static_cast<std::size_t>(nearest[lane])], p).away;
  return kNegligible * (Dot(away, away)[lane] + e2);
}

}  // namespace

SignedDistance SmoothMeshDistance(std::span<const TrianglePair> mesh, const Vec3& p, double epsilon,
                                  double width) {
  if (mesh.empty()) return {width, Vec3{0.0}};
  const double e2 = epsilon * epsilon;
  const Lanes3 point = Splat(p);
  const Lanes horizon = Splat(std::sqrt(SquareHorizon(mesh, point, e2)));
  Lanes weights{};
  Lanes planes{};
  Lanes squares{};
  Lanes3 normals;
  Lanes3 aways;
  for (const TrianglePair& triangle : mesh) {
    const Lanes3 from_center = point - triangle.center;
    const Lanes bound = horizon + triangle.reach;
    const Lanes height = Dot(triangle.normal, from_center);
    const LaneMask counts =
        (Dot(from_center, from_center) <= bound * bound) & (Abs(height) <= horizon);
    if (!Any(counts)) continue;
    const Lanes3 away = ClosestOnPair(triangle, point).away;
    const Lanes square = Dot(away, away);
    const Lanes ratio = Splat(e2) / (square + Splat(e2));
    const Lanes ratio2 = ratio * ratio;
    const Lanes weight = Select(counts, triangle.area * (ratio2 * ratio2), Lanes{});
    weights += weight;
    planes += weight * height;
    squares += weight * square;
    normals += weight * triangle.normal;
    aways += weight * away;
  }
  const double weight_sum = Sum(weights);
  if (!(weight_sum > 0.0)) return {width, Vec3{0.0}};
  const double plane = Sum(planes) / weight_sum;
  const double away = std::sqrt(Sum(squares) / weight_sum);
  const double outside =
      1.0 - (1.0 - Smoothstep(plane / (2.0 * epsilon))) * (1.0 - Smoothstep(away / width - 1.0));
  const Vec3 normal = Sum(normals) / weight_sum;
  const Vec3 away_gradient = away > 1e-12 ? Sum(aways) / (weight_sum * away) : normal;
  return {plane + outside * (away - plane), glm::mix(normal, away_gradient, outside)};
}

Box Box::Of(std::span<const Vec3> points) {
  if (points.empty()) return {};
  Box box{points[0], points[0]};
  for (const Vec3& p : points) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

double Box::Distance(const Vec3& p) const {
  return glm::length(glm::max(Vec3{0.0}, glm::max(low - p, p - high)));
}

}  // namespace ego
