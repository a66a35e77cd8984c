// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Brings the root to the height at which the legs of feet on or near the ground have the bend that
/// the performer's have, or less where their wanted places are farther apart than that bend allows.
/// The root's scale alone stretches legs that are short for their root's height, and squats too
/// deep with them. To be called before anything is adapted.
void StandOnLegs(AdaptState& state);

/// Puts a standing foot exactly where the root's scale puts its ground point and height: ground
/// contact is otherwise only the largest of many relations. The share grows smoothly as the
/// sole comes down to the ground and the ground rules the ankle's importance.
void LockStance(AdaptState& state, Limb leg);

}  // namespace ego
