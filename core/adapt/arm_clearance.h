// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Keeps the arms out of trunk, head and the other limbs as far as the performer's were, and the
/// hands on what the performer's touch. The 48 planes order limbs among themselves; nothing in the
/// text keeps a forearm out of a thick belly.
///
/// With c the performer's own clearance of a sample, scaled by the heights, the avatar's is asked
/// to be at least c where c < 0 and m (1 - exp(-c / m)) beyond: never more than the performer's, so
/// that identity and scale are exact. Wrist, palm and fingertip near a surface are asked for c
/// itself, from both sides. Each step is one damped least-squares solution over the shoulders,
/// elbows and hands of both arms (see ArmSolve).
void KeepArmsClear(AdaptState& state);

}  // namespace ego
