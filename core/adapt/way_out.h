// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"
#include "core/egocentric/clearance.h"

namespace ego {

/// Which way leads out of trunk (obstacle 0) or head (1) for a point of contact of an arm (0 wrist,
/// 1 palm, 2 fingertip), world space: the side on which the performer's is. Near the performer's
/// skin the gradient of its distance; farther off the importance-weighted mean of the directions
/// from all triangles (the v-hat of equation 6). Unlike the nearest way out it does not turn over
/// deep inside. At most unit length, shorter where the performer's own side is not clear.
Vec3 WayOut(const AdaptState& state, Limb arm, std::size_t contact, std::size_t obstacle);

/// A wrist's target at which wrist, palm and fingertip lie no deeper in trunk and head than the
/// performer's, or less deep than at `target`: moved the way out around the shoulder. What lies
/// beyond a short arm's reach is pointed at straight through the body otherwise.
Vec3 OutOfBody(const AdaptState& state, const BodyObstacles& body, Limb arm, const Vec3& target);

}  // namespace ego
