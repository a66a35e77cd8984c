// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/body/body.h"
#include "core/skeleton/pose.h"
#include "render/stage_view.h"

namespace ego {

/// How brightly a spot glows whose skin is this far from other skin, both in metres: 1 up to half
/// a percent of the body's height, falling to 0 at one and a half.
double GlowStrength(double gap, double height);

/// Where palms, fingertips and wrists of a body touch itself: appends a glowing spot for each.
/// World space of the pose; `scale` multiplies the positions, for bodies shown at another size.
void AppendContactGlows(const Body& body, const Pose& pose, double scale,
                        std::vector<ContactGlow>& glows);

}  // namespace ego
