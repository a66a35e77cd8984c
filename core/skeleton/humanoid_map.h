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

  int Node(HumanoidJoint j) const { return joint[Index(j)].node; }
};

}  // namespace ego
