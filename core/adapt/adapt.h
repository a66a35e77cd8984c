// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_settings.h"
#include "core/body/body.h"
#include "core/egocentric/egocentric_pose.h"

namespace ego {

/// Posture adaptation (section 6, Algorithm 1): the avatar's posture from an egocentric one.
///
/// Depends on its arguments alone, bit for bit. On the performer's own body it gives back the
/// performed posture, on a uniformly scaled one the same joint angles. Joints that the avatar
/// cannot turn stay at identity; bones without length are allowed everywhere.
void Adapt(const Body& avatar, const EgocentricPose& egocentric, const AdaptSettings& settings,
           Pose& out);

}  // namespace ego
