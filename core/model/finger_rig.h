// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/skeleton/hand_shape.h"
#include "core/skeleton/humanoid.h"
#include "core/skeleton/joint_tree.h"

namespace ego {

/// Two hands, five digits, three joints each.
inline constexpr std::size_t kMostFingerJoints = 30;

/// The finger joints of a rig, by the names of its nodes, and the axes they bend about. Rigs
/// without fingers have none; their hands stay as they are.
struct FingerRig {
  struct Joint {
    int parent = -1;           // into `joints`: the joint of the same finger before it
    std::size_t side = 0;      // 0: left hand
    std::size_t digit = 0;     // as in HandShape
    std::size_t segment = 0;   // 0: knuckle, 1, 2
    Vec3 position_ms{0.0};     // canonical pose
    Vec3 axis{0.0, 0.0, 1.0};  // canonical pose, unit; positive angles bend
  };
  std::vector<Joint> joints;  // parents first, at most kMostFingerJoints
  /// Per node of the rig: the joint of a finger that it hangs on, -1 for none. Empty without
  /// fingers.
  std::vector<int> joint_of;
};

/// Finds the fingers below the two hands. A metacarpal bone is none, but the thumb's. `driver` and
/// `canonical_global` as in Rig.
FingerRig FindFingers(const JointTree& tree, std::span<const HumanoidJoint> driver,
                      std::span<const Mat4> canonical_global);

/// The motion of each finger joint away from the flat hand, canonical pose: left and right hand.
/// `motion` has one entry per joint.
void BendFingers(const FingerRig& fingers, const std::array<HandShape, 2>& hand,
                 std::span<Mat4> motion);

}  // namespace ego
