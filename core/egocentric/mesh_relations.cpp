// SPDX-License-Identifier: MIT
#include "core/egocentric/mesh_relations.h"

namespace ego {
namespace {

/// What does not change from triangle to triangle.
struct Points {
  QuadVectors position;
  Quad thickness;
  Quad per_thickness;  // 0 without thickness
};

/// The bones to the points by column of MeshPaths.
struct Bones {
  std::array<QuadVectors, kMaxPathLength> vector;
  /// Sum of the lengths from a column on, times `kLeastCosine`: the part of tau that no direction
  /// changes.
  std::array<Quad, kMaxPathLength + 1> least;
  std::array<Quad, kMaxPathLength> per_length;  // 0 for a bone without length
};

Points PointsOf(const GroupQuery& query) {
  Points points;
  for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
    const std::size_t j = Index(kPointGroups[query.group][lane]);
    points.position.Set(lane, query.posed.point[j]);
    const double thickness = query.own_thickness ? query.constants.thickness[j] : 0.0;
    points.thickness[lane] = thickness;
    points.per_thickness[lane] = thickness > 0.0 ? 1.0 / thickness : 0.0;
  }
  return points;
}

void BonesOf(const GroupQuery& query, const MeshPaths& paths, Bones& bones) {
  bones.least[paths.length] = {};
  for (std::size_t i = paths.length; i-- > 0;) {
    for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
      const std::size_t bone = paths.bone[i][lane];
      const double length = query.constants.bone_length[bone];
      bones.vector[i].Set(lane, length * query.bone_direction[bone]);
      bones.least[i][lane] = bones.least[i + 1][lane] + kLeastCosine * length;
      bones.per_length[i][lane] = length > 0.0 ? 1.0 / length : 0.0;
    }
  }
}

/// Sums over triangles, for as many points as there are lanes.
template <class V>
struct Totals {
  V sum{};
  V max{};
  V priority{};
  std::array<V, kSampleCount> sample{};
};

/// From the points to the closest ones of a triangle.
template <class V>
struct Displacements {
  LaneVectors<V> direction;
  V length;
  V importance;
};

/// Closest points, importances (appendix A, equations 1 and 2; see `Proximity` and `Orthogonality`)
/// and the shares of the triangle's corners.
template <class V>
EGO_LANES_INLINE Displacements<V> Displace(const GroupQuery& query,
                                           const TriangleLanes<V>& triangle,
                                           const SampleTriangle& corner,
                                           const LaneVectors<V>& point, const V& thickness,
                                           Totals<V>& totals) {
  const V one = Splat<V>(1.0);
  const ClosestLanes<V> closest = ClosestOnTriangles(triangle, point);
  const V reach = Sqrt<V>(Dot(closest.away, closest.away));
  const LaneMask<V> is_away = reach > Splat<V>(1e-12);
  const V distance = Select<V>(is_away, reach, one);
  const V softness = Splat<V>(query.softness);
  const V length = reach + softness;
  const LaneMask<V> is_long = length > Splat<V>(1e-12);
  const V divisor = Select<V>(is_long, length, one);
  const V along = Dot(closest.away, triangle.normal) + softness;
  const V cosine = Select<V>(is_long, Max<V>(along, Splat<V>(query.floor) * length), one);
  // All three quotients by one division.
  const V gap = Max<V>(reach - thickness, Splat<V>(query.epsilon));
  const V gamma_gap = Max<V>(reach - thickness, Splat<V>(query.gamma_epsilon));
  const V gaps = divisor * (gap * gamma_gap);
  const V inverse = one / (distance * gaps);
  const V scaled = cosine * (inverse * distance);
  Displacements<V> found;
  found.length = reach;
  found.direction = Select<V>(is_away, (inverse * gaps) * closest.away, triangle.normal);
  found.importance = scaled * gamma_gap;
  totals.sum += found.importance;
  totals.max = Max<V>(totals.max, found.importance);
  totals.priority = Max<V>(totals.priority, scaled * gap);
  const V b = found.importance * closest.b;
  const V c = found.importance * closest.c;
  totals.sample[Index(corner[0])] += Max<V>(found.importance - b - c, V{});
  totals.sample[Index(corner[1])] += b;
  totals.sample[Index(corner[2])] += c;
  return found;
}

/// What triangles ask along the bones, by column: of |s cos alpha|, and of the least cosine, which
/// counts for this column and all after it.
template <class V>
struct Alongs {
  std::array<LaneVectors<V>, kMaxPathLength> by_cosine{};
  std::array<LaneVectors<V>, kMaxPathLength> from_here{};
};

/// Equations 4 and 5: the gap over tau, spread over the bones again, which are those from `begin`
/// on. `weight` are the importances times the gaps.
template <class V>
EGO_LANES_INLINE void SpreadOverBones(const Bones& bones, std::size_t begin, std::size_t end,
                                      std::size_t first, const LaneVectors<V>& direction,
                                      const V& weight, double least_factor, Alongs<V>& along) {
  std::array<V, kMaxPathLength> part;
  V tau = Load<V>(bones.least[begin], first);
  for (std::size_t i = begin; i < end; ++i) {
    part[i] = Abs<V>(Dot(direction, Load<V>(bones.vector[i], first)));
    tau += part[i];
  }
  const LaneVectors<V> step = (weight / Max<V>(tau, Splat<V>(least_factor))) * direction;
  along.from_here[begin] += step;
  for (std::size_t i = begin; i < end; ++i) along.by_cosine[i] += part[i] * step;
}

/// One mesh: the triangles from `begin` up to `end`. For the points from `first` on.
template <class V>
EGO_LANES_INLINE void RelateToMesh(const GroupQuery& query, const Points& points,
                                   const MeshPaths& paths, const Bones& bones, std::size_t first,
                                   std::size_t begin, std::size_t end, Totals<V>& totals,
                                   MeshRelations& relations, TriangleImportances& importance) {
  const std::array<SampleTriangle, kTriangleCount>& corners = SampleTriangles();
  const LaneVectors<V> point = Load<V>(points.position, first);
  const V thickness = Load<V>(points.thickness, first);
  const V per_thickness = Load<V>(points.per_thickness, first);
  const LaneMask<V> is_thick = thickness > V{};
  const V one = Splat<V>(1.0);
  const V before = totals.sum;
  LaneVectors<V> inside_sum{};
  Alongs<V> along;
  for (std::size_t t = begin; t < end; ++t) {
    const TriangleLanes<V> triangle = Splat<V>(query.posed.triangle[t / 4], t % 4);
    const Displacements<V> found =
        Displace<V>(query, triangle, corners[t], point, thickness, totals);
    Store<V>(found.importance, importance[t], first);
    const V inside = Select<V>(is_thick, Min<V>(one, found.length * per_thickness), one);
    inside_sum += (found.importance * inside) * found.direction;
    SpreadOverBones<V>(bones, paths.begin[t], paths.length, first, found.direction,
                       found.importance * Max<V>(V{}, found.length - thickness), query.least_factor,
                       along);
  }
  const Mat3& hips = query.posed.hips;
  const auto in_hips = [&](const LaneVectors<V>& v) __attribute__((always_inline)) {
    return LaneVectors<V>{Dot(v, Splat<V>(hips[0])), Dot(v, Splat<V>(hips[1])),
                          Dot(v, Splat<V>(hips[2]))};
  };
  Store<V>(totals.sum - before, relations.importance, first);
  Store<V>(in_hips(inside_sum), relations.inside, first);
  LaneVectors<V> least{};
  for (std::size_t i = 0; i < paths.length; ++i) {
    least += Splat<V>(kLeastCosine) * along.from_here[i];
    const LaneVectors<V> all = Load<V>(bones.per_length[i], first) * along.by_cosine[i] + least;
    Store<V>(in_hips(all), relations.along[i], first);
  }
}

/// Both meshes, for the points from `first` on.
template <class V>
EGO_LANES_INLINE void RelatePoints(const GroupQuery& query, const Points& points,
                                   const Bones& to_trunk, const Bones& to_head, std::size_t first,
                                   MeshCoordinates& relations, Importances& total,
                                   TriangleImportances& triangle) {
  Totals<V> totals;
  RelateToMesh<V>(query, points, PathsFromTrunk(query.group), to_trunk, first, 0,
                  kTrunkTriangleCount, totals, relations.trunk, triangle);
  RelateToMesh<V>(query, points, PathsFromHead(query.group), to_head, first, kTrunkTriangleCount,
                  kTriangleCount, totals, relations.head, triangle);
  for (std::size_t s = 0; s < kSampleCount; ++s) {
    Store<V>(totals.sample[s], relations.sample[s], first);
  }
  Store<V>(totals.sum, total.sum, first);
  Store<V>(totals.max, total.max, first);
  Store<V>(totals.priority, total.priority, first);
}

void RelateInTwoLanes(const GroupQuery& query, const Points& points, const Bones& to_trunk,
                      const Bones& to_head, MeshCoordinates& relations, Importances& total,
                      TriangleImportances& triangle) {
  RelatePoints<Lanes>(query, points, to_trunk, to_head, 0, relations, total, triangle);
  RelatePoints<Lanes>(query, points, to_trunk, to_head, 2, relations, total, triangle);
}

EGO_WIDE_LANES_TARGET
void RelateInFourLanes(const GroupQuery& query, const Points& points, const Bones& to_trunk,
                       const Bones& to_head, MeshCoordinates& relations, Importances& total,
                       TriangleImportances& triangle) {
  RelatePoints<WideLanes>(query, points, to_trunk, to_head, 0, relations, total, triangle);
}

void Scale(const Quad& share, Quad& values) {
  for (std::size_t lane = 0; lane < share.size(); ++lane) values[lane] *= share[lane];
}

void Scale(const Quad& share, QuadVectors& vectors) {
  Scale(share, vectors.x);
  Scale(share, vectors.y);
  Scale(share, vectors.z);
}

void Scale(const Quad& share, std::size_t length, MeshRelations& relations) {
  Scale(share, relations.importance);
  Scale(share, relations.inside);
  for (std::size_t i = 0; i < length; ++i) Scale(share, relations.along[i]);
}

}  // namespace

void RelateToMeshes(const GroupQuery& query, MeshCoordinates& relations, Importances& total,
                    TriangleImportances& triangle, LaneWidth lanes) {
  const Points points = PointsOf(query);
  Bones to_trunk;
  Bones to_head;
  BonesOf(query, PathsFromTrunk(query.group), to_trunk);
  BonesOf(query, PathsFromHead(query.group), to_head);
  if (lanes == LaneWidth::kFour) {
    RelateInFourLanes(query, points, to_trunk, to_head, relations, total, triangle);
  } else {
    RelateInTwoLanes(query, points, to_trunk, to_head, relations, total, triangle);
  }
}

void ScaleMeshCoordinates(const Quad& share, std::size_t group, MeshCoordinates& coordinates) {
  for (Quad& weight : coordinates.sample) Scale(share, weight);
  Scale(share, PathsFromTrunk(group).length, coordinates.trunk);
  Scale(share, PathsFromHead(group).length, coordinates.head);
}

}  // namespace ego
