// SPDX-License-Identifier: MIT
#include "core/model/rig.h"

#include <limits>

#include "core/base/check.h"

namespace ego {
namespace {

/// The mapped joint nearest to a point of the rest pose; of joints in one place the last, so that
/// a foot's helper follows the foot and not the shin that ends there.
HumanoidJoint NearestJoint(const HumanoidMap& map, const Alignment& alignment, const Vec3& point) {
  HumanoidJoint nearest = HumanoidJoint::kHips;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (map.joint[j].node < 0) continue;
    const double distance = glm::length(alignment.rest_position[j] - point);
    if (distance <= best) {
      best = distance;
      nearest = static_cast<HumanoidJoint>(j);
    }
  }
  return nearest;
}

}  // namespace

void PoseNodes(const Rig& rig, const ModelPose& pose, std::span<Mat4> node_global) {
  EGO_CHECK(node_global.size() == rig.driver.size());
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(rig.skeleton);
  std::array<Mat4, kJointCount> motion;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    motion[j] = glm::mat4_cast(pose.rotation_ws[j]);
    motion[j][3] = Vec4(pose.position_ws[j] - pose.rotation_ws[j] * canonical[j], 1.0);
  }
  for (std::size_t n = 0; n < node_global.size(); ++n) {
    node_global[n] = motion[Index(rig.driver[n])] * rig.canonical_global[n];
  }
}

void PoseNodes(const Rig& rig, const ModelPose& pose, const std::array<HandShape, 2>& hand,
               std::span<Mat4> node_global) {
  PoseNodes(rig, pose, node_global);
  constexpr std::array<HandShape, 2> kFlat{};
  std::array<Mat4, kMostFingerJoints> bent;
  const std::size_t count = rig.fingers.joints.size();
  if (count == 0 || hand == kFlat) return;
  BendFingers(rig.fingers, hand, std::span(bent).first(count));
  std::array<Mat4, 2> motion;
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(rig.skeleton);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t j = Index(side == 0 ? HumanoidJoint::kLeftHand : HumanoidJoint::kRightHand);
    motion[side] = glm::mat4_cast(pose.rotation_ws[j]);
    motion[side][3] = Vec4(pose.position_ws[j] - pose.rotation_ws[j] * canonical[j], 1.0);
  }
  for (std::size_t n = 0; n < node_global.size(); ++n) {
    if (rig.fingers.joint_of[n] < 0) continue;
    const auto joint = static_cast<std::size_t>(rig.fingers.joint_of[n]);
    node_global[n] = motion[rig.fingers.joints[joint].side] * bent[joint] * rig.canonical_global[n];
  }
}

void PoseNodes(const Rig& rig, const Pose& pose, std::span<Mat4> node_global) {
  PoseNodes(rig, ForwardKinematics(rig.skeleton, pose), pose.hand, node_global);
}

Rig BuildRig(const JointTree& tree, std::span<const Mat4> rest_global, const HumanoidMap& map,
             const Alignment& alignment, const std::vector<bool>& deforms) {
  const std::size_t count = tree.joints.size();
  EGO_CHECK(rest_global.size() == count);
  EGO_CHECK(deforms.empty() || deforms.size() == count);
  Rig rig;
  rig.skeleton = alignment.skeleton;
  rig.metres_per_unit = alignment.metres_per_unit;
  std::vector<int> mapped(count, -1);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    rig.node[j] = map.joint[j].node;
    if (rig.node[j] >= 0) mapped[static_cast<std::size_t>(rig.node[j])] = static_cast<int>(j);
  }
  // Roots and the joints above the hips carry the whole body; a joint beside it that moves skin
  // belongs where it stands.
  std::vector<bool> above(count, false);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (rig.node[j] < 0) continue;
    for (int n = tree.joints[static_cast<std::size_t>(rig.node[j])].parent; n >= 0;
         n = tree.joints[static_cast<std::size_t>(n)].parent) {
      above[static_cast<std::size_t>(n)] = true;
    }
  }
  rig.driver.assign(count, HumanoidJoint::kHips);
  std::vector<bool> settled(count, false);
  rig.canonical_global.resize(count);
  std::array<Mat4, kJointCount> canonical_from_rest;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    canonical_from_rest[j] = alignment.CanonicalFromRest(static_cast<HumanoidJoint>(j));
  }
  for (std::size_t n = 0; n < count; ++n) {
    const int parent = tree.joints[n].parent;
    if (mapped[n] >= 0) {
      rig.driver[n] = static_cast<HumanoidJoint>(mapped[n]);
      settled[n] = true;
    } else if (parent >= 0 && settled[static_cast<std::size_t>(parent)]) {
      rig.driver[n] = rig.driver[static_cast<std::size_t>(parent)];
      settled[n] = true;
    } else if (!above[n] && !deforms.empty() && deforms[n]) {
      rig.driver[n] = NearestJoint(map, alignment, Vec3(rest_global[n][3]));
      settled[n] = true;
    }
    rig.canonical_global[n] = canonical_from_rest[Index(rig.driver[n])] * rest_global[n];
  }
  rig.fingers = FindFingers(tree, rig.driver, rig.canonical_global);
  return rig;
}

}  // namespace ego
