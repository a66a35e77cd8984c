// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"
#include "core/adapt/denormalize.h"

namespace ego {

/// Turns the hand of an arm that is too short for the end joint's target towards what it is to
/// touch, and brings the target after it: an outstretched arm and its hand reach farther than the
/// arm does with the hand across. As far as that is needed and the performer's hand is near a
/// surface; not at all where the target is within reach, so that identity and scale stay exact.
void ReachWithHand(AdaptState& state, Limb arm, LimbTargets& targets);

}  // namespace ego
