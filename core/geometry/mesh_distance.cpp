// SPDX-License-Identifier: MIT
#include "core/geometry/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/smooth.h"

namespace ego {
namespace {

using Mesh = std::span<const TriangleQuad>;

/// Weighted sums over triangles, by their place among four.
struct Sums {
  Quad weight;
  Quad plane;
  Quad square;
  QuadVectors normal;
  QuadVectors away;
};

template <class V>
EGO_LANES_INLINE void SumTriangles(Mesh mesh, const Vec3& p, std::size_t first,
                                   double square_epsilon, Sums& sums) {
  const LaneVectors<V> point = Splat<V>(p);
  const V e2 = Splat<V>(square_epsilon);
  V weights{};
  V planes{};
  V squares{};
  LaneVectors<V> normals{};
  LaneVectors<V> aways{};
  for (const TriangleQuad& quad : mesh) {
    const TriangleLanes<V> triangle = Load<V>(quad, first);
    const LaneVectors<V> away = ClosestOnTriangles(triangle, point).away;
    const V square = Dot(away, away);
    const V ratio = e2 / (square + e2);
    const V ratio2 = ratio * ratio;
    const V weight = triangle.area * (ratio2 * ratio2);
    weights += weight;
    planes += weight * Dot(triangle.normal, point - triangle.a);
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
  SumTriangles<Lanes>(mesh, p, 0, e2, sums);
  SumTriangles<Lanes>(mesh, p, 2, e2, sums);
}

EGO_WIDE_LANES_TARGET
void SumInFourLanes(Mesh mesh, const Vec3& p, double e2, Sums& sums) {
  SumTriangles<WideLanes>(mesh, p, 0, e2, sums);
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
