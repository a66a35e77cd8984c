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

/// By point of a group where its path begins.
using Origins = std::array<HumanoidJoint, kPointGroupSize>;
using BoneQuad = std::array<std::uint8_t, kPointGroupSize>;

/// The bones that the paths to the points of a group run along at place `i`.
BoneQuad BonesAt(const Origins& from, const PointGroup& to, std::size_t i) {
  BoneQuad bone{};
  for (std::size_t lane = 0; lane < to.size(); ++lane) {
    const KinematicPath& path = PathBetween(from[lane], to[lane]);
    bone[lane] = i < path.length ? path.bone[i] : std::uint8_t{0};
  }
  return bone;
}

std::size_t LongestPath(const Origins& from, const PointGroup& to) {
  std::size_t longest = 0;
  for (std::size_t lane = 0; lane < to.size(); ++lane) {
    longest = std::max<std::size_t>(longest, PathBetween(from[lane], to[lane]).length);
  }
  return longest;
}

Origins OriginsOf(std::size_t triangle) {
  Origins from;
  from.fill(ParentJoint(triangle));
  return from;
}

MeshPaths MakeMeshPaths(std::size_t first, std::size_t end, const PointGroup& to) {
  MeshPaths paths;
  Origins farthest = OriginsOf(first);
  for (std::size_t t = first; t < end; ++t) {
    if (LongestPath(OriginsOf(t), to) > LongestPath(farthest, to)) farthest = OriginsOf(t);
  }
  paths.length = LongestPath(farthest, to);
  for (std::size_t i = 0; i < paths.length; ++i) paths.bone[i] = BonesAt(farthest, to, i);
  for (std::size_t t = first; t < end; ++t) {
    const std::size_t length = LongestPath(OriginsOf(t), to);
    paths.begin[t] = static_cast<std::uint8_t>(paths.length - length);
    for (std::size_t i = 0; i < length; ++i) {
      EGO_CHECK(BonesAt(OriginsOf(t), to, i) == paths.bone[paths.begin[t] + i]);
    }
  }
  return paths;
}

CapsulePaths MakeCapsulePaths(std::size_t group) {
  const PointGroup& to = kPointGroups[group];
  CapsulePaths paths;
  for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
    if (slot == kHandSlot && !IsArm(LimbOf(to[0]))) continue;
    Origins from;
    for (std::size_t lane = 0; lane < to.size(); ++lane) {
      const Limb limb = LimbOf(to[lane]);
      from[lane] =
          slot == kHandSlot ? JointsOf(Mirror(limb)).end : StartJoint(OtherSegment(limb, slot));
    }
    CapsulePaths::Path& path = paths.from[slot];
    path.length = LongestPath(from, to);
    for (std::size_t i = 0; i < path.length; ++i) {
      const BoneQuad bone = BonesAt(from, to, i);
      const auto known = paths.bone.begin() + static_cast<std::ptrdiff_t>(paths.bone_count);
      const auto found = std::find(paths.bone.begin(), known, bone);
      if (found == known) {
        EGO_CHECK(paths.bone_count < kMaxGroupBones);
        paths.bone[paths.bone_count++] = bone;
      }
      path.bone[i] = static_cast<std::uint8_t>(found - paths.bone.begin());
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

const CapsulePaths& PathsFromCapsules(std::size_t group) {
  static const std::array<CapsulePaths, kPointGroupCount> kAll = {
      MakeCapsulePaths(0), MakeCapsulePaths(1), MakeCapsulePaths(2)};
  return kAll[group];
}

}  // namespace ego
