// SPDX-License-Identifier: MIT
#include "core/egocentric/kinematic_path.h"

#include <algorithm>
#include <cstddef>

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

MeshPaths MakeMeshPaths(std::size_t first, std::size_t end, LimbPoint to) {
  std::array<HumanoidJoint, kTriangleCount> from{};
  std::size_t count = 0;
  for (std::size_t t = first; t < end; ++t) from[count++] = ParentJoint(t);
  std::stable_sort(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count),
                   [to](HumanoidJoint a, HumanoidJoint b) {
                     return PathBetween(a, to).length < PathBetween(b, to).length;
                   });
  MeshPaths paths;
  for (std::size_t k = 0; k < count; ++k) {
    const KinematicPath& path = PathBetween(from[k], to);
    for (std::size_t i = 0; i < path.length; ++i) {
      const auto found = paths.bone.begin() + static_cast<std::ptrdiff_t>(paths.length);
      if (std::find(paths.bone.begin(), found, path.bone[i]) != found) continue;
      paths.bone[paths.length++] = path.bone[i];
    }
  }
  for (std::size_t t = first; t < end; ++t) {
    const std::size_t joint = Index(ParentJoint(t - t % 2));
    paths.joint[t / 2] = static_cast<std::uint8_t>(joint);
    MeshPaths::OfPair& pair = paths.by_joint[joint];
    const KinematicPath& path = PathBetween(ParentJoint(t), to);
    for (std::size_t column = 0; column < paths.length; ++column) {
      const auto path_end = path.bone.begin() + path.length;
      if (std::find(path.bone.begin(), path_end, paths.bone[column]) == path_end) continue;
      pair.on_path[column][t % 2] = 1.0;
      pair.used = std::max(pair.used, column + 1);
    }
  }
  return paths;
}

using AllMeshPaths = std::array<MeshPaths, kLimbPointCount>;

AllMeshPaths MakeAllMeshPaths(std::size_t first, std::size_t end) {
  AllMeshPaths all;
  for (std::size_t j = 0; j < kLimbPointCount; ++j) {
    all[j] = MakeMeshPaths(first, end, static_cast<LimbPoint>(j));
  }
  return all;
}

}  // namespace

const KinematicPath& PathBetween(HumanoidJoint from, LimbPoint to) {
  return kPathTable[Index(from)][Index(to)];
}

const MeshPaths& PathsFromTrunk(LimbPoint to) {
  static const AllMeshPaths kAll = MakeAllMeshPaths(0, kTrunkTriangleCount);
  return kAll[Index(to)];
}

const MeshPaths& PathsFromHead(LimbPoint to) {
  static const AllMeshPaths kAll = MakeAllMeshPaths(kTrunkTriangleCount, kTriangleCount);
  return kAll[Index(to)];
}

}  // namespace ego
