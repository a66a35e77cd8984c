// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Puts a standing foot exactly where the root's scale puts its ground point and height: ground
/// contact is otherwise only the largest of many relations. The share grows smoothly as the
/// sole comes down to the ground and the ground rules the ankle's importance.
void LockStance(AdaptState& state, Limb leg);

}  // namespace ego
