// SPDX-License-Identifier: MIT
#include "core/baselines/copy_joint_angles.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// The joint whose world rotation `joint` shows: itself, or the last of the locked spine joints
/// that follow it.
J ShownJoint(const Skeleton& avatar, J joint) {
  if (joint != J::kSpine && joint != J::kChest) return joint;
  J shown = joint;
  while (shown != J::kUpperChest) {
    const J next = static_cast<J>(Index(shown) + 1);
    if (!avatar.locked[Index(next)]) break;
    shown = next;
  }
  return shown;
}

}  // namespace

void CopyJointAngles(const std::array<Quat, kJointCount>& rotation_ls,
                     const std::array<Quat, kJointCount>& rotation_ws, const Vec3& root_ws,
                     const Skeleton& avatar, Pose& out) {
  out.root_ws = root_ws;
  if (avatar.locked.none()) {
    out.rotation_ls = rotation_ls;
    return;
  }
  std::array<Quat, kJointCount> world;
  std::array<bool, kJointCount> follows;  // the avatar's joint has the performer's world rotation
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const std::size_t parent = Index(kParent[i]);
    const Quat& frame = i == 0 ? kIdentity : world[parent];
    if (avatar.locked[i]) {
      out.rotation_ls[i] = kIdentity;
      world[i] = frame;
      follows[i] = false;
      continue;
    }
    const J shown = ShownJoint(avatar, static_cast<J>(i));
    follows[i] = Index(shown) == i;
    const bool same = follows[i] && (i == 0 || follows[parent]);
    world[i] = rotation_ws[Index(shown)];
    out.rotation_ls[i] = same ? rotation_ls[i] : glm::normalize(glm::conjugate(frame) * world[i]);
  }
}

void CopyJointAngles(const Body& performer, const Pose& pose, const Body& avatar, Pose& out) {
  const ModelPose posed = ForwardKinematics(performer.skeleton, pose);
  const double scale = avatar.standing_root_height / performer.standing_root_height;
  std::array<Quat, kJointCount> local = pose.rotation_ls;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (performer.skeleton.locked[i]) local[i] = kIdentity;
  }
  CopyJointAngles(local, posed.rotation_ws, scale * pose.root_ws, avatar.skeleton, out);
}

}  // namespace ego
