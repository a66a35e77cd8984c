// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Keeps both segments of a limb on their side of every other limb's segments (section 6.3): maps
/// the egocentric planes, relaxes them (appendix B), activates them in proportion to `w` (figure
/// 14) and brings the segments into the half-spaces, one after the other in an order that
/// mirroring keeps. `overlap` is the share of both radii by which segments may sink into each
/// other: 0 holds the skins apart, 0.5 little more than the order of the bones. Reads the other
/// limbs where they are, changes nothing but the result.
LimbPosture EnsureSpatialOrder(const AdaptState& state, Limb limb, const LimbPosture& posture,
                               double w, double overlap = 0.0);

}  // namespace ego
