// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/model/finger_rig.h"
#include "core/skeleton/humanoid.h"
#include "core/skeleton/humanoid_map.h"
#include "core/skeleton/joint_tree.h"
#include "core/skeleton/pose.h"
#include "core/skeleton/rest_alignment.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// How a canonical skeleton drives the nodes of a file's rig.
///
/// Every node hangs rigidly on one humanoid joint, its driver: the nearest mapped ancestor or
/// itself. With M the node's transform in the canonical pose and H the driver's rigid motion
/// away from the canonical pose, the posed node is H * M, exactly, whatever axes, scales, helper
/// joints and missing joints the rig has (H * F * M where a finger bends by F):
///   H_j = translate(p_j) * rotate(R_j) * translate(-c_j),  c_j = canonical position of joint j.
struct Rig {
  Skeleton skeleton;                   // metres, ground at y = 0
  std::array<int, kJointCount> node;   // node of each joint, -1 for a virtual one
  std::vector<HumanoidJoint> driver;   // per node
  std::vector<Mat4> canonical_global;  // per node: M, stage space, metres
  double metres_per_unit = 1.0;        // how the file's unit was read
  FingerRig fingers;
};

/// World transforms (file units to metres) of all nodes for a posed skeleton. `node_global` has
/// one entry per node. Hands stay flat.
void PoseNodes(const Rig& rig, const ModelPose& pose, std::span<Mat4> node_global);
/// The same with bent fingers, left and right hand.
void PoseNodes(const Rig& rig, const ModelPose& pose, const std::array<HandShape, 2>& hand,
               std::span<Mat4> node_global);
/// All of a pose.
void PoseNodes(const Rig& rig, const Pose& pose, std::span<Mat4> node_global);

/// Puts a joint tree on its aligned skeleton. A node's driver is its nearest mapped ancestor (or
/// itself). A node that deforms a mesh but has no mapped ancestor below the hips although it
/// stands away from them (IK targets under the root) follows the mapped joint it stands at.
/// `deforms` says per node whether it moves any mesh; empty: all may.
Rig BuildRig(const JointTree& tree, std::span<const Mat4> rest_global, const HumanoidMap& map,
             const Alignment& alignment, const std::vector<bool>& deforms = {});

}  // namespace ego
