// SPDX-License-Identifier: MIT
#include "core/egocentric/kinematic_path.h"

#include <algorithm>
#include <cstddef>

#include "core/base/check.h"

namespace ego {
namespace {

/// Joints from the hips (index 0 of the chain) down to `joint`; parents come before children.
struct Chain {
  std::array<std::size_t, kMaxPathLength> joint{};
  std::size_t length = 0;
};

constexpr Chain ChainTo(HumanoidJoint joint) {
  Chain up;
  for (std::size_t j = Index(joint);; j = Index(kParent[j])) {
    up.joint[up.length++] = j;
    if (j == 0) break;
  }
  Chain down;
  for (std::size_t k = up.length; k-- > 0;) down.joint[down.length++] = up.joint[k];
  return down;
}

constexpr KinematicPath MakePath(HumanoidJoint from, LimbPoint to) {
  const Chain a = ChainTo(from);
  const Chain b = ChainTo(JointOf(to));
  std::size_t common = 0;
  while (common < a.length && common < b.length && a.joint[common] == b.joint[common]) ++common;
  KinematicPath path;
  const auto add = [&](std::size_t bone) {
    path.bone[path.length++] = static_cast<std::uint8_t>(bone);
  };
  for (std::size_t k = a.length; k-- > common;) add(a.joint[k]);
  for (std::size_t k = common; k < b.length; ++k) add(b.joint[k]);
  if (IsHandPoint(to)) add(HandBone(to));
  return path;
}

using PathTable = std::array<std::array<KinematicPath, kLimbPointCount>, kJointCount>;

/// Feet and toes carry nothing that other points relate to.
constexpr bool CarriesSurface(HumanoidJoint joint) {
  using J = HumanoidJoint;
  return joint != J::kLeftFoot && joint != J::kRightFoot && joint != J::kLeftToes &&
         joint != J::kRightToes;
}

constexpr PathTable MakeTable() {
  PathTable table{};
  for (std::size_t from = 0; from < kJointCount; ++from) {
    if (!CarriesSurface(static_cast<HumanoidJoint>(from))) continue;
    for (std::size_t to = 0; to < kLimbPointCount; ++to) {
      table[from][to] = MakePath(static_cast<HumanoidJoint>(from), static_cast<LimbPoint>(to));
    }
  }
  return table;
}

constexpr PathTable kPathTable = MakeTable();

/// The bones that the paths from a joint to the points of a group run along at place `i`.
std::array<std::uint8_t, kPointGroupSize> BonesAt(HumanoidJoint from, const PointGroup& to,
                                                  std::size_t i) {
  std::array<std::uint8_t, kPointGroupSize> bone{};
  for (std::size_t lane = 0; lane < to.size(); ++lane) {
    const KinematicPath& path = PathBetween(from, to[lane]);
    bone[lane] = i < path.length ? path.bone[i] : std::uint8_t{0};
  }
  return bone;
}

std::size_t LongestPath(HumanoidJoint from, const PointGroup& to) {
  std::size_t longest = 0;
  for (const LimbPoint j : to)
    longest = std::max<std::size_t>(longest, PathBetween(from, j).length);
  return longest;
}

MeshPaths MakeMeshPaths(std::size_t first, std::size_t end, const PointGroup& to) {
  MeshPaths paths;
  HumanoidJoint farthest = ParentJoint(first);
  for (std::size_t t = first; t < end; ++t) {
    if (LongestPath(ParentJoint(t), to) > LongestPath(farthest, to)) farthest = ParentJoint(t);
  }
  paths.length = LongestPath(farthest, to);
  for (std::size_t i = 0; i < paths.length; ++i) paths.bone[i] = BonesAt(farthest, to, i);
  for (std::size_t t = first; t < end; ++t) {
    const std::size_t length = LongestPath(ParentJoint(t), to);
    paths.begin[t] = static_cast<std::uint8_t>(paths.length - length);
    for (std::size_t i = 0; i < length; ++i) {
      EGO_CHECK(BonesAt(ParentJoint(t), to, i) == paths.bone[paths.begin[t] + i]);
    }
  }
  return paths;
}

using AllMeshPaths = std::array<MeshPaths, kPointGroupCount>;

AllMeshPaths MakeAllMeshPaths(std::size_t first, std::size_t end) {
  AllMeshPaths all;
  for (std::size_t g = 0; g < kPointGroupCount; ++g) {
    all[g] = MakeMeshPaths(first, end, kPointGroups[g]);
  }
  return all;
}

}  // namespace

const KinematicPath& PathBetween(HumanoidJoint from, LimbPoint to) {
  return kPathTable[Index(from)][Index(to)];
}

const MeshPaths& PathsFromTrunk(std::size_t group) {
  static const AllMeshPaths kAll = MakeAllMeshPaths(0, kTrunkTriangleCount);
  return kAll[group];
}

const MeshPaths& PathsFromHead(std::size_t group) {
  static const AllMeshPaths kAll = MakeAllMeshPaths(kTrunkTriangleCount, kTriangleCount);
  return kAll[group];
}

}  // namespace ego
