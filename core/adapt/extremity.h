// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// The world rotation of a hand or foot aligned with the surface (section 6.5, equation 3): the
/// smallest rotation of `rotation_ws` that brings its surface normal to the weighted mean of what
/// the primitives ask; the performer's own direction of a foot counts as a surface at `leg_gap`.
/// Where they cancel, and where hand or foot cannot turn, it stays.
Quat AlignExtremity(const AdaptState& state, Limb limb, const Quat& rotation_ws);

}  // namespace ego
