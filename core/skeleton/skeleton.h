// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>

#include "core/base/math.h"
#include "core/skeleton/humanoid.h"

namespace ego {

/// Bone lengths and directions of one humanoid in the canonical pose.
///
/// The canonical pose is the T-pose: standing upright, facing +Z, arms along +X (left) and -X
/// (right), palms down, legs along -Y, feet parallel and forward, soles on the ground y = 0, hips
/// above the origin. Every joint's own frame is world-aligned there, so that equal local rotations
/// mean equal joint angles on every body (paper, section 8: one canonical pose for all).
struct Skeleton {
  /// From the parent joint to the joint in the canonical pose, metres. For the hips: their
  /// position in stage space, (0, standing height, 0). A virtual joint (one that the rig lacks)
  /// has the offset zero.
  std::array<Vec3, kJointCount> offset{};
  /// Joints whose local rotation is always identity because the rig cannot turn them (for example
  /// the spine of a rig that has none, or a hand whose fingers hang on the forearm).
  std::bitset<kJointCount> locked;
};

/// Joint positions in the canonical pose, model space, metres.
std::array<Vec3, kJointCount> CanonicalPositions(const Skeleton& skeleton);

/// Length of the bone from the parent to this joint, metres.
double BoneLength(const Skeleton& skeleton, HumanoidJoint joint);

/// The skeleton with every offset multiplied by `factor`.
Skeleton Scaled(const Skeleton& skeleton, double factor);

}  // namespace ego
