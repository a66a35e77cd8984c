// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/body/body_surface.h"
#include "core/egocentric/limb_point.h"
#include "core/geometry/lanes.h"

namespace ego {

/// The bones that kinematic paths run along: bone k ends at joint k (and begins at its parent);
/// after the joints' come the four from a wrist to a palm or fingertip, in the order of LimbPoint.
inline constexpr std::size_t kBoneCount = kJointCount + 4;
constexpr std::size_t HandBone(LimbPoint point) {
  return kJointCount + Index(point) - kLimbJointCount;
}

/// Longest path: from a calf up the thigh and the trunk to the other end of the body, a fingertip.
inline constexpr std::size_t kMaxPathLength = 10;

/// The bones s_1 .. s_n between the joint that carries a reference point and a limb point (section
/// 5.2). Each counts by the absolute cosine, so their signs along the path do not matter.
struct KinematicPath {
  std::array<std::uint8_t, kMaxPathLength> bone{};
  std::uint8_t length = 0;
};

/// The path from joint `from` up to the common ancestor and down to `to`. The same on every body.
/// Feet and toes carry no reference point; from them the path is empty.
const KinematicPath& PathBetween(HumanoidJoint from, LimbPoint to);

/// The paths from all triangles of one crude mesh to one limb point, side by side: all bones that
/// any of them runs along, the shortest path's first, and which of them each does.
struct MeshPaths {
  std::array<std::uint8_t, kMaxPathLength> bone{};
  std::size_t length = 0;
  /// Of a pair of triangles, by the joint that carries the first: the bones up to the last one that
  /// one of both paths has, and 1 in a lane where its path has the bone, else 0.
  struct OfPair {
    std::size_t used = 0;
    std::array<Lanes, kMaxPathLength> on_path{};
  };
  std::array<OfPair, kJointCount> by_joint{};
  std::array<std::uint8_t, kTriangleCount / 2> joint{};  // of every pair of both meshes
  const OfPair& Of(std::size_t pair) const { return by_joint[joint[pair]]; }
};
const MeshPaths& PathsFromTrunk(LimbPoint to);
const MeshPaths& PathsFromHead(LimbPoint to);

/// Added to every cosine, so that tau stays above zero where all bones are at right angles to the
/// displacement and the ratio of two bodies' tau is always a convex mean of their bones' ratios.
inline constexpr double kLeastCosine = 0.01;

/// Absolute cosines |cos alpha_i| of a path's bones to a displacement (equation 4).
using PathCosines = std::array<float, kMaxPathLength>;

/// tau = sum of |s_i| |cos alpha_i| (equation 5).
inline double PathFactor(const KinematicPath& path, const PathCosines& cosine,
                         const std::array<double, kBoneCount>& bone_length) {
  double tau = 0.0;
  for (std::size_t i = 0; i < path.length; ++i) {
    tau += bone_length[path.bone[i]] * (kLeastCosine + static_cast<double>(cosine[i]));
  }
  return tau;
}

/// Fills the cosines of a unit `direction` to the bones and returns tau of the same body, as
/// `PathFactor` does. A bone without length has the cosine 0. `bone_direction` are unit vectors in
/// the same space.
inline double MeasurePath(const KinematicPath& path, const Vec3& direction,
                          const std::array<Vec3, kBoneCount>& bone_direction,
                          const std::array<double, kBoneCount>& bone_length, PathCosines& cosine) {
  double tau = 0.0;
  for (std::size_t i = 0; i < path.length; ++i) {
    const std::size_t bone = path.bone[i];
    cosine[i] = static_cast<float>(std::abs(glm::dot(direction, bone_direction[bone])));
    tau += bone_length[bone] * (kLeastCosine + static_cast<double>(cosine[i]));
  }
  return tau;
}

}  // namespace ego
