// SPDX-License-Identifier: MIT
#include "core/adapt/body_sum.h"

namespace ego {
namespace {

/// Lengths on this body by column of MeshPaths, and the points' own thickness.
struct Lengths {
  std::array<Quad, kMaxPathLength> bone;
  Quad thickness{};
};

Lengths LengthsOf(const BodyConstants& constants, const MeshPaths& paths, std::size_t group,
                  bool own_thickness) {
  Lengths lengths;
  for (std::size_t i = 0; i < paths.length; ++i) {
    for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
      lengths.bone[i][lane] = constants.bone_length[paths.bone[i][lane]];
    }
  }
  for (std::size_t lane = 0; own_thickness && lane < kPointGroupSize; ++lane) {
    lengths.thickness[lane] = constants.thickness[Index(kPointGroups[group][lane])];
  }
  return lengths;
}

/// One crude mesh (see MeshRelations), whose samples are those from `begin` up to `end`, for the
/// points from `first` on.
template <class V>
EGO_LANES_INLINE void SumMesh(const MeshCoordinates& mesh, const MeshRelations& relations,
                              const Lengths& lengths, std::size_t columns, const PosedBody& posed,
                              std::size_t begin, std::size_t end, std::size_t first,
                              QuadVectors& sum) {
  LaneVectors<V> position{};
  for (std::size_t s = begin; s < end; ++s) {
    position += Load<V>(mesh.sample[s], first) * Splat<V>(posed.sample[s]);
  }
  LaneVectors<V> displacement =
      Load<V>(lengths.thickness, first) * Load<V>(relations.inside, first);
  for (std::size_t i = 0; i < columns; ++i) {
    displacement += Load<V>(lengths.bone[i], first) * Load<V>(relations.along[i], first);
  }
  const Mat3& hips = posed.hips;
  Store<V>(position + displacement.x * Splat<V>(hips[0]) + displacement.y * Splat<V>(hips[1]) +
               displacement.z * Splat<V>(hips[2]),
           sum, first);
}

template <class V>
EGO_LANES_INLINE void SumMeshes(const MeshCoordinates& mesh, const std::array<Lengths, 2>& lengths,
                                const PosedBody& posed, std::size_t group, std::size_t first,
                                BodySum& sum) {
  SumMesh<V>(mesh, mesh.trunk, lengths[0], PathsFromTrunk(group).length, posed, 0,
             kTrunkSampleCount, first, sum.trunk);
  SumMesh<V>(mesh, mesh.head, lengths[1], PathsFromHead(group).length, posed, kTrunkSampleCount,
             kSampleCount, first, sum.head);
}

void SumInTwoLanes(const MeshCoordinates& mesh, const std::array<Lengths, 2>& lengths,
                   const PosedBody& posed, std::size_t group, BodySum& sum) {
  SumMeshes<Lanes>(mesh, lengths, posed, group, 0, sum);
  SumMeshes<Lanes>(mesh, lengths, posed, group, 2, sum);
}

EGO_WIDE_LANES_TARGET
void SumInFourLanes(const MeshCoordinates& mesh, const std::array<Lengths, 2>& lengths,
                    const PosedBody& posed, std::size_t group, BodySum& sum) {
  SumMeshes<WideLanes>(mesh, lengths, posed, group, 0, sum);
}

/// Of the triangles from `first` on of every four.
template <class V>
EGO_LANES_INLINE void SumNormals(const NormalCoordinates& normal, const PosedBody& posed,
                                 std::size_t first, QuadVectors& sums) {
  LaneVectors<V> sum{};
  for (std::size_t q = 0; q < kTriangleQuadCount; ++q) {
    const LaneVectors<V> weight = Load<V>(normal.triangle[q], first);
    sum += weight.x * Load<V>(posed.triangle[q].normal, first);
    sum += weight.y * Load<V>(posed.tangent[q].along, first);
    sum += weight.z * Load<V>(posed.tangent[q].third, first);
  }
  Store<V>(sum, sums, first);
}

void SumNormalsInTwoLanes(const NormalCoordinates& normal, const PosedBody& posed,
                          QuadVectors& sums) {
  SumNormals<Lanes>(normal, posed, 0, sums);
  SumNormals<Lanes>(normal, posed, 2, sums);
}

EGO_WIDE_LANES_TARGET
void SumNormalsInFourLanes(const NormalCoordinates& normal, const PosedBody& posed,
                           QuadVectors& sums) {
  SumNormals<WideLanes>(normal, posed, 0, sums);
}

}  // namespace

BodySum SumOverBody(const MeshCoordinates& mesh, const BodyConstants& constants,
                    const PosedBody& posed, std::size_t group, bool own_thickness,
                    LaneWidth lanes) {
  const std::array<Lengths, 2> lengths = {
      LengthsOf(constants, PathsFromTrunk(group), group, own_thickness),
      LengthsOf(constants, PathsFromHead(group), group, own_thickness)};
  BodySum sum;
  if (lanes == LaneWidth::kFour) {
    SumInFourLanes(mesh, lengths, posed, group, sum);
  } else {
    SumInTwoLanes(mesh, lengths, posed, group, sum);
  }
  return sum;
}

Vec3 SumOfNormals(const NormalCoordinates& normal, const PosedBody& posed, LaneWidth lanes) {
  QuadVectors sums;
  if (lanes == LaneWidth::kFour) {
    SumNormalsInFourLanes(normal, posed, sums);
  } else {
    SumNormalsInTwoLanes(normal, posed, sums);
  }
  return (sums.At(0) + sums.At(1)) + (sums.At(2) + sums.At(3));
}

}  // namespace ego
