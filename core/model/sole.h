// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/model/character.h"

namespace ego {

/// How a foot would tip over if it were set down as it is in the canonical pose: the slope, seen
/// from the side, of the ground that its skin touches below the middle of the foot, in radians,
/// positive when the toes are lower than the heel. It is the edge of the lower convex hull there,
/// so heels and arches count as the plane they stand on. Nothing for a foot without skin (less
/// than three vertices that foot and toes carry by half or more) or without length: a tenth of its
/// height.
std::optional<double> SoleSlope(const Character& character, bool left);

}  // namespace ego
