// SPDX-License-Identifier: MIT
#include "core/egocentric/mesh_relations.h"

#include <algorithm>

namespace ego {
namespace {

static_assert(kTrunkPairCount % 2 == 0 && kTrianglePairCount % 2 == 0, "pairs come in twos");

/// What some of the triangles add.
struct Part {
  double sum = 0.0;  // of their importances
  double max = 0.0;
  double priority = 0.0;
  Vec3 inside{0.0};
  std::array<Vec3, kMaxPathLength> along{};  // the other two as in MeshRelations, world space
};

/// The importances of triangles (appendix A, equations 1 and 2; see `Proximity` and
/// `Orthogonality`), added to lanes of the totals.
template <class V>
struct LaneTotal {
  V sum{};
  V max{};
  V priority{};
};
template <class V>
EGO_LANES_INLINE V Importances(const MeshQuery& query, const ImportanceTotal& total, const V& along,
                               const V& reach, const V& gap, LaneTotal<V>& lanes) {
  // Cosine over saturated gap as one quotient.
  const V softness = Splat<V>(query.softness);
  const V length = reach + softness;
  const LaneMask<V> is_long = length > Splat<V>(1e-12);
  const V one = Splat<V>(1.0);
  const V divisor = Select<V>(is_long, length, one);
  const V cosine =
      Select<V>(is_long, Max<V>(along + softness, Splat<V>(query.floor) * length), one);
  const V importance = cosine / (divisor * Max<V>(gap, Splat<V>(total.epsilon)));
  lanes.sum += importance;
  lanes.max = Max<V>(lanes.max, importance);
  lanes.priority =
      Max<V>(lanes.priority, total.gamma_epsilon == total.epsilon
                                 ? importance
                                 : cosine / (divisor * Max<V>(gap, Splat<V>(total.gamma_epsilon))));
  return importance;
}

/// The bones to the point, in the order of MeshPaths::bone, and what triangles ask along them.
template <class V>
struct Columns {
  std::array<LaneVectors<V>, kMaxPathLength> direction;
  std::array<V, kMaxPathLength> length;
  std::array<LaneVectors<V>, kMaxPathLength> along{};
};

/// Equations 4 and 5: the gap over tau, spread over the bones again. `direction` are the unit
/// displacements, `weight` the importances times the gaps.
template <class V>
EGO_LANES_INLINE void SpreadOverBones(const MeshPaths::OfPair& first,
                                      const MeshPaths::OfPair& second,
                                      const LaneVectors<V>& direction, const V& weight,
                                      double least_factor, Columns<V>& columns) {
  const std::size_t used = kLaneCount<V> == 2 ? first.used : std::max(first.used, second.used);
  std::array<V, kMaxPathLength> factor;
  V tau{};
  for (std::size_t i = 0; i < used; ++i) {
    factor[i] = Join<V>(first.on_path[i], second.on_path[i]) *
                (Splat<V>(kLeastCosine) + Abs<V>(Dot(direction, columns.direction[i])));
    tau += columns.length[i] * factor[i];
  }
  const LaneVectors<V> step = (weight / Max<V>(tau, Splat<V>(least_factor))) * direction;
  for (std::size_t i = 0; i < used; ++i) columns.along[i] += factor[i] * step;
}

/// Importances and barycentric coordinates times them, by pair.
struct PairWeights {
  std::array<Lanes, kTrianglePairCount> b;
  std::array<Lanes, kTrianglePairCount> c;
};

/// Every second pair from `first` on, or all pairs where the lanes take two.
template <class V>
EGO_LANES_INLINE void RelatePart(const MeshQuery& query, std::size_t first, std::size_t end,
                                 const ImportanceTotal& total,
                                 std::array<Lanes, kTrianglePairCount>& triangle,
                                 PairWeights& weights, Part& part) {
  const LaneVectors<V> point = Splat<V>(query.point);
  const V one = Splat<V>(1.0);
  const V thickness = Splat<V>(query.thickness);
  const V per_thickness = Splat<V>(query.thickness > 0.0 ? 1.0 / query.thickness : 0.0);
  const bool is_thick = query.thickness > 0.0;
  Columns<V> columns;
  for (std::size_t i = 0; i < query.paths.length; ++i) {
    const std::size_t bone = query.paths.bone[i];
    columns.direction[i] = Splat<V>(query.posed.bone_direction[bone]);
    columns.length[i] = Splat<V>(query.constants.bone_length[bone]);
  }
  LaneTotal<V> lanes;
  LaneVectors<V> inside_sum{};
  for (std::size_t t = first; t < end; t += 2) {
    const std::size_t u = kLaneCount<V> == 2 ? t : t + 1;
    const TriangleLanes<V> triangles = Join<V>(query.posed.triangle[t], query.posed.triangle[u]);
    const ClosestLanes<V> closest = ClosestOnTriangles(triangles, point);
    const V reach = Sqrt<V>(Dot(closest.away, closest.away));
    const LaneMask<V> is_away = reach > Splat<V>(1e-12);
    const LaneVectors<V> direction =
        Select<V>(is_away, (one / Select<V>(is_away, reach, one)) * closest.away, triangles.normal);
    const V gap = reach - thickness;
    const V importance =
        Importances<V>(query, total, Dot(closest.away, triangles.normal), reach, gap, lanes);
    Store<V>(importance, &triangle[t]);
    Store<V>(importance * closest.b, &weights.b[t]);
    Store<V>(importance * closest.c, &weights.c[t]);
    const V inside = is_thick ? Min<V>(one, reach * per_thickness) : one;
    inside_sum += (importance * inside) * direction;
    SpreadOverBones<V>(query.paths.Of(t), query.paths.Of(u), direction,
                       importance * Max<V>(V{}, gap), query.least_factor, columns);
  }
  part.sum += Sum(lanes.sum);
  part.max = std::max(part.max, Largest(lanes.max));
  part.priority = std::max(part.priority, Largest(lanes.priority));
  part.inside += Sum(inside_sum);
  for (std::size_t i = 0; i < query.paths.length; ++i) part.along[i] += Sum(columns.along[i]);
}

void RelateInTwoLanes(const MeshQuery& query, std::size_t first, std::size_t end,
                      const ImportanceTotal& total, std::array<Lanes, kTrianglePairCount>& triangle,
                      PairWeights& weights, Part& part) {
  RelatePart<Lanes>(query, first, end, total, triangle, weights, part);
  RelatePart<Lanes>(query, first + 1, end, total, triangle, weights, part);
}

EGO_WIDE_LANES_TARGET
void RelateInFourLanes(const MeshQuery& query, std::size_t first, std::size_t end,
                       const ImportanceTotal& total,
                       std::array<Lanes, kTrianglePairCount>& triangle, PairWeights& weights,
                       Part& part) {
  RelatePart<WideLanes>(query, first, end, total, triangle, weights, part);
}

}  // namespace

MeshRelations RelateToMesh(const MeshQuery& query, std::size_t first, std::size_t end,
                           ImportanceTotal& total, std::array<Lanes, kTrianglePairCount>& triangle,
                           std::array<double, kSampleCount>& sample, LaneWidth lanes) {
  PairWeights weights;
  Part part;
  if (lanes == LaneWidth::kFour) {
    RelateInFourLanes(query, first, end, total, triangle, weights, part);
  } else {
    RelateInTwoLanes(query, first, end, total, triangle, weights, part);
  }
  const std::array<SampleTriangle, kTriangleCount>& corners = SampleTriangles();
  for (std::size_t t = first; t < end; ++t) {
    const Lanes a = Max<Lanes>(triangle[t] - weights.b[t] - weights.c[t], Lanes{});
    for (std::size_t lane = 0; lane < kLaneCount<Lanes>; ++lane) {
      const SampleTriangle& corner = corners[2 * t + lane];
      sample[Index(corner[0])] += a[lane];
      sample[Index(corner[1])] += weights.b[t][lane];
      sample[Index(corner[2])] += weights.c[t][lane];
    }
  }
  total.sum += part.sum;
  total.max = std::max(total.max, part.max);
  total.priority = std::max(total.priority, part.priority);
  MeshRelations relations;
  relations.importance = part.sum;
  relations.inside = part.inside * query.posed.hips;
  for (std::size_t i = 0; i < query.paths.length; ++i) {
    relations.along[i] = part.along[i] * query.posed.hips;
  }
  return relations;
}

}  // namespace ego
