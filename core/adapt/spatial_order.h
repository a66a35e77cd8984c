// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Keeps both segments of a limb on their side of every other limb's segments (section 6.3): maps
/// the egocentric planes, relaxes them (appendix B), activates them in proportion to `w` (figure
/// 14) and brings the segments into the half-spaces, one after the other in an order that
/// mirroring keeps. Reads the other limbs where they are, changes nothing but the result.
LimbPosture EnsureSpatialOrder(const AdaptState& state, Limb limb, const LimbPosture& posture,
                               double w);

}  // namespace ego
