// SPDX-License-Identifier: MIT
#include "core/skeleton/pose.h"

namespace ego {

ModelPose ForwardKinematics(const Skeleton& skeleton, const Pose& pose) {
  ModelPose model;
  model.position_ws[0] = pose.root_ws;
  model.rotation_ws[0] = skeleton.locked[0] ? kIdentity : pose.rotation_ls[0];
  for (std::size_t i = 1; i < kJointCount; ++i) {
    const std::size_t parent = Index(kParent[i]);
    const Quat& frame = model.rotation_ws[parent];
    model.position_ws[i] = model.position_ws[parent] + frame * skeleton.offset[i];
    model.rotation_ws[i] = skeleton.locked[i] ? frame : frame * pose.rotation_ls[i];
  }
  return model;
}

Pose PoseFromWorldRotations(const std::array<Quat, kJointCount>& rotation_ws, const Vec3& root_ws) {
  Pose pose;
  pose.root_ws = root_ws;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    Quat local =
        i == 0 ? rotation_ws[0] : glm::conjugate(rotation_ws[Index(kParent[i])]) * rotation_ws[i];
    local = glm::normalize(local);
    pose.rotation_ls[i] = local.w < 0.0 ? -local : local;
  }
  return pose;
}

Pose CanonicalPose(const Skeleton& skeleton) {
  Pose pose;
  pose.root_ws = skeleton.offset[0];
  return pose;
}

Pose Mirrored(const Pose& pose) {
  Pose mirrored;
  mirrored.root_ws = {-pose.root_ws.x, pose.root_ws.y, pose.root_ws.z};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Quat& q = pose.rotation_ls[i];
    mirrored.rotation_ls[Index(Mirror(static_cast<HumanoidJoint>(i)))] = {q.w, q.x, -q.y, -q.z};
  }
  mirrored.hand = {pose.hand[1], pose.hand[0]};
  return mirrored;
}

}  // namespace ego
