// SPDX-License-Identifier: MIT
#include "core/egocentric/mesh_relations.h"

namespace ego {
namespace {

/// The bones to the point, in the order of MeshPaths::bone, and what the triangles ask along them.
struct Columns {
  Columns(const MeshQuery& query) {
    for (std::size_t i = 0; i < query.paths.length; ++i) {
      const std::size_t bone = query.paths.bone[i];
      direction[i] = Splat(query.posed.bone_direction[bone]);
      length[i] = Splat(query.constants.bone_length[bone]);
    }
  }
  std::array<Lanes3, kMaxPathLength> direction;
  std::array<Lanes, kMaxPathLength> length{};
  std::array<Lanes3, kMaxPathLength> along;
};

/// The importances of two triangles (appendix A, equations 1 and 2; see `Proximity` and
/// `Orthogonality`), added to lanes of the totals.
struct LaneTotal {
  Lanes sum{};
  Lanes max{};
  Lanes priority{};
};
Lanes Importances(const MeshQuery& query, const ImportanceTotal& total, Lanes along, Lanes reach,
                  Lanes gap, LaneTotal& lanes) {
  const Lanes one = Splat(1.0);
  const Lanes softness = Splat(query.softness);
  const Lanes denominator = reach + softness;
  const Lanes cosine = Select(denominator > Splat(1e-12), (along + softness) / denominator, one);
  const Lanes orthogonality = Max(cosine, Splat(query.floor));
  const Lanes importance = orthogonality / Max(gap, Splat(total.epsilon));
  lanes.sum += importance;
  lanes.max = Max(lanes.max, importance);
  lanes.priority = Max(lanes.priority, orthogonality / Max(gap, Splat(total.gamma_epsilon)));
  return importance;
}

/// Equations 4 and 5 for two triangles: the gap over tau, spread over the bones again. `direction`
/// are the unit displacements, `weight` the importances times the gaps.
void SpreadOverBones(const MeshPaths::OfPair& pair, const Lanes3& direction, Lanes weight,
                     double least_factor, Columns& columns) {
  std::array<Lanes, kMaxPathLength> factor;
  Lanes tau{};
  for (std::size_t i = 0; i < pair.used; ++i) {
    factor[i] = pair.on_path[i] * (Splat(kLeastCosine) + Abs(Dot(direction, columns.direction[i])));
    tau += columns.length[i] * factor[i];
  }
  const Lanes3 step = (weight / Max(tau, Splat(least_factor))) * direction;
  for (std::size_t i = 0; i < pair.used; ++i) columns.along[i] += factor[i] * step;
}

}  // namespace

MeshRelations RelateToMesh(const MeshQuery& query, std::size_t first, std::size_t end,
                           ImportanceTotal& total, std::array<Lanes, kTrianglePairCount>& triangle,
                           std::array<double, kSampleCount>& sample) {
  const std::array<SampleTriangle, kTriangleCount>& corners = SampleTriangles();
  const Lanes3 point = Splat(query.point);
  const Lanes one = Splat(1.0);
  const Lanes thickness = Splat(query.thickness);
  const double per_thickness = query.thickness > 0.0 ? 1.0 / query.thickness : 0.0;
  Columns columns(query);
  LaneTotal lanes;
  Lanes3 inside_sum;
  for (std::size_t t = first; t < end; ++t) {
    const TrianglePair& pair = query.posed.triangle[t];
    const ClosestPair closest = ClosestOnPair(pair, point);
    const Lanes reach = Sqrt(Dot(closest.away, closest.away));
    const LaneMask is_away = reach > Splat(1e-12);
    const Lanes3 direction =
        Select(is_away, (one / Select(is_away, reach, one)) * closest.away, pair.normal);
    const Lanes gap = reach - thickness;
    const Lanes importance =
        Importances(query, total, Dot(closest.away, pair.normal), reach, gap, lanes);
    triangle[t] = importance;
    const Lanes b = importance * closest.b;
    const Lanes c = importance * closest.c;
    const Lanes a = Max(importance - b - c, Lanes{});
    for (std::size_t lane = 0; lane < kLaneCount; ++lane) {
      const SampleTriangle& corner = corners[2 * t + lane];
      sample[Index(corner[0])] += a[lane];
      sample[Index(corner[1])] += b[lane];
      sample[Index(corner[2])] += c[lane];
    }
    const Lanes inside = query.thickness > 0.0 ? Min(one, reach * Splat(per_thickness)) : one;
    inside_sum += (importance * inside) * direction;
    SpreadOverBones(query.paths.pair[Index(ParentJoint(2 * t))], direction,
                    importance * Max(Lanes{}, gap), query.least_factor, columns);
  }
  const double sum = Sum(lanes.sum);
  total.sum += sum;
  total.max = std::max(total.max, Largest(lanes.max));
  total.priority = std::max(total.priority, Largest(lanes.priority));
  MeshRelations relations;
  relations.importance = sum;
  relations.inside = Sum(inside_sum) * query.posed.hips;
  for (std::size_t i = 0; i < query.paths.length; ++i) {
    relations.along[i] = Sum(columns.along[i]) * query.posed.hips;
  }
  return relations;
}

}  // namespace ego
