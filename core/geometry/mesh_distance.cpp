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

using Mesh = std::span<const TriangleQuad>;

/// The triangle whose centroid is nearest to `p`; of equally near ones of a lane the first.
template <class V>
EGO_LANES_INLINE std::size_t NearestCentroid(Mesh mesh, const LaneVectors<V>& point) {
  Quad nearest;
  Quad least;
  for (std::size_t first = 0; first < 4; first += kLaneCount<V>) {
    V square_least = Splat<V>(std::numeric_limits<double>::max());
    V index{};
    for (std::size_t q = 0; q < mesh.size(); ++q) {
      const LaneVectors<V> d = point - Load<V>(mesh[q].center, first);
      const V square = Dot(d, d);
      index = Select<V>(square < square_least, Splat<V>(static_cast<double>(q)), index);
      square_least = Min<V>(square_least, square);
    }
    Store<V>(index, nearest, first);
    Store<V>(square_least, least, first);
  }
  std::size_t lane = 0;
  for (std::size_t k = 1; k < 4; ++k) {
    if (least[k] < least[lane]) lane = k;
  }
  return 4 * static_cast<std::size_t>(nearest[lane]) + lane;
}

/// Distance from a point beyond which no triangle counts.
template <class V>
EGO_LANES_INLINE double Horizon(Mesh mesh, const LaneVectors<V>& point, double e2) {
  const std::size_t nearest = NearestCentroid<V>(mesh, point);
  const std::size_t first = nearest % 4 / kLaneCount<V> * kLaneCount<V>;
  const LaneVectors<V> away = ClosestOnTriangles(Load<V>(mesh[nearest / 4], first), point).away;
  return std::sqrt(kNegligible * (Dot(away, away)[nearest % 4 - first] + e2));
}

/// Weighted sums over triangles, by their place among four.
struct Sums {
  Quad weight;
  Quad plane;
  Quad square;
  QuadVectors normal;
  QuadVectors away;
};

template <class V>
EGO_LANES_INLINE void SumTriangles(Mesh mesh, const LaneVectors<V>& point, std::size_t first,
                                   double square_epsilon, double far, Sums& sums) {
  const V e2 = Splat<V>(square_epsilon);
  const V horizon = Splat<V>(far);
  V weights{};
  V planes{};
  V squares{};
  LaneVectors<V> normals{};
  LaneVectors<V> aways{};
  for (const TriangleQuad& quad : mesh) {
    const TriangleLanes<V> triangle = Load<V>(quad, first);
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
  Store<V>(weights, sums.weight, first);
  Store<V>(planes, sums.plane, first);
  Store<V>(squares, sums.square, first);
  Store<V>(normals, sums.normal, first);
  Store<V>(aways, sums.away, first);
}

void SumInTwoLanes(Mesh mesh, const Vec3& p, double e2, Sums& sums) {
  const Lanes3 point = Splat<Lanes>(p);
  const double horizon = Horizon<Lanes>(mesh, point, e2);
  SumTriangles<Lanes>(mesh, point, 0, e2, horizon, sums);
  SumTriangles<Lanes>(mesh, point, 2, e2, horizon, sums);
}

EGO_WIDE_LANES_TARGET
void SumInFourLanes(Mesh mesh, const Vec3& p, double e2, Sums& sums) {
  const LaneVectors<WideLanes> point = Splat<WideLanes>(p);
  const double horizon = Horizon<WideLanes>(mesh, point, e2);
  SumTriangles<WideLanes>(mesh, point, 0, e2, horizon, sums);
}

double Total(const Quad& four) { return (four[0] + four[1]) + (four[2] + four[3]); }
Vec3 Total(const QuadVectors& four) { return {Total(four.x), Total(four.y), Total(four.z)}; }

}  // namespace

SignedDistance SmoothMeshDistance(std::span<const TriangleQuad> mesh, const Vec3& p, double epsilon,
                                  double width, LaneWidth lanes) {
  if (mesh.empty()) return {width, Vec3{0.0}};
  const double e2 = epsilon * epsilon;
  Sums sums;
  if (lanes == LaneWidth::kFour) {
    SumInFourLanes(mesh, p, e2, sums);
  } else {
    SumInTwoLanes(mesh, p, e2, sums);
  }
  const double weight = Total(sums.weight);
  if (!(weight > 0.0)) return {width, Vec3{0.0}};
  const double plane = Total(sums.plane) / weight;
  const double away = std::sqrt(Total(sums.square) / weight);
  const double outside =
      1.0 - (1.0 - Smoothstep(plane / (2.0 * epsilon))) * (1.0 - Smoothstep(away / width - 1.0));
  const Vec3 normal = Total(sums.normal) / weight;
  const Vec3 away_gradient = away > 1e-12 ? Total(sums.away) / (weight * away) : normal;
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

}  // namespace ego
