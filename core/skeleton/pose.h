// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/skeleton/hand_shape.h"
#include "core/skeleton/humanoid.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// Joint angles and root position of one instant. Free of the body's size but for the root.
struct Pose {
  /// Position of the hips joint, world space, metres (paper: G).
  Vec3 root_ws{0.0};
  /// Rotation of each joint relative to its parent; identity in the canonical pose. For the hips:
  /// the rotation in world space.
  std::array<Quat, kJointCount> rotation_ls = Filled();
  /// How the fingers are bent, left and right. Rides along: no method reads it.
  std::array<HandShape, 2> hand{};

 private:
  static constexpr std::array<Quat, kJointCount> Filled() {
    std::array<Quat, kJointCount> all{};
    for (Quat& q : all) q = kIdentity;
    return all;
  }
};

/// Joint transforms of one instant in world space: the bone frames of a posed skeleton.
struct ModelPose {
  std::array<Vec3, kJointCount> position_ws{};
  std::array<Quat, kJointCount> rotation_ws{};

  const Vec3& Position(HumanoidJoint joint) const { return position_ws[Index(joint)]; }
  const Quat& Rotation(HumanoidJoint joint) const { return rotation_ws[Index(joint)]; }
};

/// Places every joint: p_j = p_parent + R_parent offset_j, R_j = R_parent r_j. Locked joints take
/// identity whatever the pose holds.
ModelPose ForwardKinematics(const Skeleton& skeleton, const Pose& pose);

/// The pose whose forward kinematics has these world rotations and this root. Rotations are
/// normalised and, where the sign is free, w >= 0.
Pose PoseFromWorldRotations(const std::array<Quat, kJointCount>& rotation_ws, const Vec3& root_ws);

/// The standing canonical pose of a skeleton.
Pose CanonicalPose(const Skeleton& skeleton);

/// The pose reflected in the plane x = 0 with left and right exchanged.
Pose Mirrored(const Pose& pose);

}  // namespace ego
