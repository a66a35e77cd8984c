// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/skeleton/humanoid.h"
#include "core/skeleton/joint_tree.h"

namespace ego {

/// Which node of a joint tree plays which humanoid joint.
struct HumanoidMap {
  struct Entry {
    int node = -1;            // -1: the rig has none; a virtual joint stands in
    double confidence = 0.0;  // 0 to 1
    std::string reason;       // why this node, or why none; one clause for a person
  };
  std::array<Entry, kJointCount> joint;
  /// Fingertips and toe tips where the rig shows them (last finger or toe node), else -1. Used
  /// for hand and foot lengths. Left, right.
  std::array<int, 2> fingertip{-1, -1};
  std::array<int, 2> toe_tip{-1, -1};
  /// First nodes of the index and little finger (knuckles) and of the thumb, else -1: they say
  /// which way a palm looks. Left, right.
  std::array<int, 2> index_base{-1, -1};
  std::array<int, 2> little_base{-1, -1};
  std::array<int, 2> thumb_base{-1, -1};
  /// Sentences about what was doubtful or left out, for the user.
  std::vector<std::string> notes;

  int Node(HumanoidJoint j) const { return joint[Index(j)].node; }
};

/// What a file says beyond names and rest positions.
struct HumanoidHints {
  /// Node of each joint where the file declares it (VRM human bones), else -1. Declared joints are
  /// taken as they are.
  std::array<int, kJointCount> node = Unknown();
  /// Per joint of the tree: it deforms a mesh. Empty: unknown, all may.
  std::vector<bool> deforms;

 private:
  static constexpr std::array<int, kJointCount> Unknown() {
    std::array<int, kJointCount> all{};
    for (int& n : all) n = -1;
    return all;
  }
};

/// Finds the humanoid in a joint tree: what the hints declare, else names and shape together. The
/// shape of the rest pose decides (one trunk, two chains down, two out, one up, in any axes and
/// unit), names are votes; trees whose names say nothing are mapped by shape alone, trees whose
/// rest pose has no shape (all bones on one line) by names alone.
///
/// A map has hips, upper and lower arms and legs and the head; everything else may be missing
/// (node -1 with a reason). Of more than three spine joints those nearest to 1/4, 1/2 and 3/4 of
/// the way up the trunk are taken, the others ride on them. Left is the body's left.
/// Error: one sentence that names the missing joints and what was seen instead.
Result<HumanoidMap> MapHumanoid(const JointTree& tree, const HumanoidHints& hints = {});

}  // namespace ego
