// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/skeleton/humanoid.h"
#include "core/skeleton/joint_names.h"
#include "core/skeleton/joint_tree.h"

namespace ego {

/// A joint tree without what can be no joint of a humanoid (twist, IK and face joints by their
/// names; leaves that deform nothing), each joint under its nearest kept ancestor.
struct BodyTree {
  std::vector<Vec3> position;  // rest, file space, per joint of the full tree
  std::vector<NameVote> vote;  // per joint of the full tree
  std::vector<bool> kept;
  std::vector<int> parent;                 // nearest kept ancestor, also of joints left out
  std::vector<std::vector<int>> children;  // kept children of kept joints
  std::vector<double> reach;               // longest way down from a kept joint, file units

  bool IsAncestor(int ancestor, int joint) const;  // strictly above
  int CommonAncestor(int a, int b) const;          // either itself; -1 when there is none
  Vec3 At(int joint) const { return position[static_cast<std::size_t>(joint)]; }
  const NameVote& Vote(int joint) const { return vote[static_cast<std::size_t>(joint)]; }
  const std::vector<int>& Children(int joint) const {
    return children[static_cast<std::size_t>(joint)];
  }
  int Parent(int joint) const { return parent[static_cast<std::size_t>(joint)]; }
};

/// `deforms` as in HumanoidHints; `declared` joints are kept whatever their names say.
BodyTree MakeBodyTree(const JointTree& tree, const std::vector<bool>& deforms,
                      const std::array<int, kJointCount>& declared);

/// One limb as found; -1 where the rig has no such joint.
struct FoundLimb {
  int base = -1;
  int mid = -1;
  int end = -1;  // may be missing
  int tip = -1;  // toes; arms: unused
  bool named = false;
};
using FoundLimbs = std::array<FoundLimb, kLimbCount>;

/// A limb whose base and mid joint are told by names. `end` may lie outside the limb's branch (IK
/// rigs), then it is the joint of that name.
std::optional<FoundLimb> LimbByName(const BodyTree& tree, Limb limb);

/// All four limbs by shape alone: two mirrored pairs of chains on one trunk, those that run on
/// along the trunk are the legs. Left and right are not known here: "left" is the first of a pair,
/// the same side for arms and legs.
std::optional<FoundLimbs> LimbsByShape(const BodyTree& tree);

}  // namespace ego
