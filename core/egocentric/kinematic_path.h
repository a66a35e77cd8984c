// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/body/body_surface.h"
#include "core/egocentric/limb_point.h"

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

/// The paths from all triangles of one crude mesh to the four points of a group, side by side. A
/// column is the bones that the four paths run along at the same place; the triangles hang along
/// one chain of joints, so that every path is the end of the longest.
struct MeshPaths {
  /// Bone 0, which has no length, where a point's path has ended.
  std::array<std::array<std::uint8_t, kPointGroupSize>, kMaxPathLength> bone{};
  std::size_t length = 0;
  std::array<std::uint8_t, kTriangleCount> begin{};  // by triangle: its path's first column
};
const MeshPaths& PathsFromTrunk(std::size_t group);
const MeshPaths& PathsFromHead(std::size_t group);

/// Added to every cosine, so that tau stays above zero where all bones are at right angles to the
/// displacement and the ratio of two bodies' tau is always a convex mean of their bones' ratios.
inline constexpr double kLeastCosine = 0.01;

/// The paths from the capsules that a group's points relate to (`OtherSegment`, then the other
/// hand), side by side likewise.
inline constexpr std::size_t kMaxGroupBones = 24;
struct CapsulePaths {
  struct Path {
    std::array<std::uint8_t, kMaxPathLength> bone{};  // of those below
    std::size_t length = 0;
  };
  std::array<Path, kOtherCapsuleCount> from{};  // by slot; of legs' groups not from a hand
  /// All that any path runs along.
  std::array<std::array<std::uint8_t, kPointGroupSize>, kMaxGroupBones> bone{};
  std::size_t bone_count = 0;
};
const CapsulePaths& PathsFromCapsules(std::size_t group);

}  // namespace ego
