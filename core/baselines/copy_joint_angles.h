// SPDX-License-Identifier: MIT
#pragma once

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A captured posture on another body by joint angles alone: the root position scaled by the
/// standing root heights (equation 1), every joint with the performer's rotation. What the posture
/// initialisation (section 6.1) starts from and what every method is compared with.
///
/// On a body whose joints can all turn, local rotations are copied bit for bit. Where the avatar
/// cannot turn a joint (Skeleton::locked) its children keep the performer's rotation in the world;
/// a spine joint takes over the rotation of the locked ones above it, so that the chest still
/// faces where the performer's does.
void CopyJointAngles(const Body& performer, const Pose& pose, const Body& avatar, Pose& out);

/// The same from angles that have left their body: `performer_ms` are the world rotations that the
/// performer's skeleton had, `root_ws` the avatar's own root position.
void CopyJointAngles(const std::array<Quat, kJointCount>& rotation_ls,
                     const std::array<Quat, kJointCount>& rotation_ws, const Vec3& root_ws,
                     const Skeleton& avatar, Pose& out);

}  // namespace ego
