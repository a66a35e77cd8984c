// SPDX-License-Identifier: MIT
#include "core/geometry/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Triangles this many times farther (as squares, with the smoothing) than the nearest weigh less
/// than 1.6e-5 of it and are left out: the distance changes by micrometres.
constexpr double kNegligible = 16.0;

const TrianglePair kNone{};  // without area: weighs nothing

/// The pair whose centroid is nearest to `p`, and which of both.
struct Nearest {
  std::size_t pair = 0;
  std::size_t lane = 0;
};
template <class V>
EGO_LANES_INLINE Nearest NearestCentroid(std::span<const TrianglePair> mesh, const Vec3& p) {
  constexpr std::size_t kPairs = kLaneCount<V> / 2;
  const LaneVectors<V> point = Splat<V>(p);
  V least = Splat<V>(std::numeric_limits<double>::max());
  V nearest{};
  for (std::size_t k = 0; k < mesh.size(); k += kPairs) {
    const std::size_t other = std::min(k + 1, mesh.size() - 1);  // once more at the end: no harm
    const LaneVectors<V> d = point - Join<V>(mesh[k].center, mesh[other].center);
    const V square = Dot(d, d);
    nearest = Select<V>(square < least, Splat<V>(static_cast<double>(k)), nearest);
    least = Min<V>(least, square);
  }
  // Of equally near ones the first, in any width.
  Nearest found;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < kLaneCount<V>; ++l) {
    const std::size_t pair =
        std::min(static_cast<std::size_t>(nearest[l]) + l / 2, mesh.size() - 1);
    if (least[l] < best || (least[l] == best && pair < found.pair)) found = {pair, l % 2};
    best = std::min(best, static_cast<double>(least[l]));
  }
  return found;
}

/// Distance from a point beyond which no triangle counts.
template <class V>
EGO_LANES_INLINE double Horizon(std::span<const TrianglePair> mesh, const Vec3& p, double e2) {
  const Nearest nearest = NearestCentroid<V>(mesh, p);
  const Lanes3 away = ClosestOnTriangles(mesh[nearest.pair], Splat(p)).away;
  return std::sqrt(kNegligible * (Dot(away, away)[nearest.lane] + e2));
}

/// Weighted sums over triangles.
struct Sums {
  double weight = 0.0;
  double plane = 0.0;
  double square = 0.0;
  Vec3 normal{0.0};
  Vec3 away{0.0};
  friend Sums operator+(const Sums& a, const Sums& b) {
    return {a.weight + b.weight, a.plane + b.plane, a.square + b.square, a.normal + b.normal,
            a.away + b.away};
  }
};

/// Sums over every second pair from `first` on, or over all pairs where the lanes take two.
template <class V>
EGO_LANES_INLINE Sums SumTriangles(std::span<const TrianglePair> mesh, std::size_t first,
                                   const Vec3& p, double square_epsilon, double far) {
  const LaneVectors<V> point = Splat<V>(p);
  const V e2 = Splat<V>(square_epsilon);
  const V horizon = Splat<V>(far);
  V weights{};
  V planes{};
  V squares{};
  LaneVectors<V> normals{};
  LaneVectors<V> aways{};
  for (std::size_t k = first; k < mesh.size(); k += 2) {
    const TriangleLanes<V> triangle = Join<V>(mesh[k], k + 1 < mesh.size() ? mesh[k + 1] : kNone);
    const LaneVectors<V> from_center = point - triangle.center;
    const V bound = horizon + triangle.reach;
    const V height = Dot(triangle.normal, from_center);
    const LaneMask<V> counts =
        (Dot(from_center, from_center) <= bound * bound) & (Abs<V>(height) <= horizon);
    if (!Any<V>(counts)) continue;
    const LaneVectors<V> away = ClosestOnTriangles(triangle, point).away;
    const V square = Dot(away, away);
    const V ratio = e2 / (square + e2);
    const V ratio2 = ratio * ratio;
    const V weight = Select<V>(counts, triangle.area * (ratio2 * ratio2), V{});
    weights += weight;
    planes += weight * height;
    squares += weight * square;
    normals += weight * triangle.normal;
    aways += weight * away;
  }
  return {Sum(weights), Sum(planes), Sum(squares), Sum(normals), Sum(aways)};
}

Sums SumInTwoLanes(std::span<const TrianglePair> mesh, const Vec3& p, double e2) {
  const double horizon = Horizon<Lanes>(mesh, p, e2);
  return SumTriangles<Lanes>(mesh, 0, p, e2, horizon) +
         SumTriangles<Lanes>(mesh, 1, p, e2, horizon);
}

EGO_WIDE_LANES_TARGET
Sums SumInFourLanes(std::span<const TrianglePair> mesh, const Vec3& p, double e2) {
  const double horizon = Horizon<WideLanes>(mesh, p, e2);
  return SumTriangles<WideLanes>(mesh, 0, p, e2, horizon);
}

}  // namespace

SignedDistance SmoothMeshDistance(std::span<const TrianglePair> mesh, const Vec3& p, double epsilon,
                                  double width, LaneWidth lanes) {
  if (mesh.empty()) return {width, Vec3{0.0}};
  const double e2 = epsilon * epsilon;
  const Sums sum =
      lanes == LaneWidth::kFour ? SumInFourLanes(mesh, p, e2) : SumInTwoLanes(mesh, p, e2);
  if (!(sum.weight > 0.0)) return {width, Vec3{0.0}};
  const double plane = sum.plane / sum.weight;
  const double away = std::sqrt(sum.square / sum.weight);
  const double outside =
      1.0 - (1.0 - Smoothstep(plane / (2.0 * epsilon))) * (1.0 - Smoothstep(away / width - 1.0));
  const Vec3 normal = sum.normal / sum.weight;
  const Vec3 away_gradient = away > 1e-12 ? sum.away / (sum.weight * away) : normal;
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
