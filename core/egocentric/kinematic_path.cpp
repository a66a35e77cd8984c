// SPDX-License-Identifier: MIT
#include "core/egocentric/kinematic_path.h"

namespace ego {
namespace {

/// Joints from the hips (index 0 of the chain) down to `joint`; parents come before children.
struct Chain {
  std::array<std::size_t, kMaxPathLength> joint{};
  std::size_t length = 0;
};

Chain ChainTo(HumanoidJoint joint) {
  Chain up;
  for (std::size_t j = Index(joint);; j = Index(kParent[j])) {
    up.joint[up.length++] = j;
    if (j == 0) break;
  }
  Chain down;
  for (std::size_t k = up.length; k-- > 0;) down.joint[down.length++] = up.joint[k];
  return down;
}

KinematicPath MakePath(HumanoidJoint from, LimbPoint to) {
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

PathTable MakeTable() {
  PathTable table;
  for (std::size_t from = 0; from < kJointCount; ++from) {
    for (std::size_t to = 0; to < kLimbPointCount; ++to) {
      table[from][to] = MakePath(static_cast<HumanoidJoint>(from), static_cast<LimbPoint>(to));
    }
  }
  return table;
}

}  // namespace

const KinematicPath& PathBetween(HumanoidJoint from, LimbPoint to) {
  static const PathTable kTable = MakeTable();
  return kTable[Index(from)][Index(to)];
}

}  // namespace ego
