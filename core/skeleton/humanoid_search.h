// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/skeleton/humanoid_map.h"
#include "core/skeleton/limb_search.h"

namespace ego {

/// The state of one search for a humanoid; the steps fill `map`.
struct HumanoidSearch {
  const JointTree& tree;
  const HumanoidHints& hints;
  BodyTree body;
  HumanoidMap map;

  const std::string& NameOf(int node) const {
    return tree.joints[static_cast<std::size_t>(node)].name;
  }
  int Node(HumanoidJoint j) const { return map.Node(j); }
  Vec3 At(HumanoidJoint j) const { return body.At(Node(j)); }
  bool Declared(HumanoidJoint j) const { return hints.node[Index(j)] >= 0; }
  /// Keeps what the file declares.
  void Set(HumanoidJoint j, int node, double confidence, std::string reason) {
    if (!Declared(j)) map.joint[Index(j)] = {node, confidence, std::move(reason)};
  }
};

/// Fingers, thumbs, finger and toe tips below the mapped hands and feet (or, where a hand is
/// missing, below the forearm).
void FindTips(HumanoidSearch& search);

/// Puts "left" on the body's left: always where shape alone found the limbs, and where feet,
/// thumbs and knees together contradict the names. Needs all limbs, the head and the tips.
void SettleSides(HumanoidSearch& search, bool limbs_named);

}  // namespace ego
