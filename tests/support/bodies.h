// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/body/body.h"

namespace ego::test {

/// A body made from the template, for what the studio's cast (studio_motions.h) does not have:
/// lengths in metres, thicknesses as factors of the template's.
struct BodyShape {
  double height = 1.78;
  double arm_length = 0.55;  // shoulder to wrist
  double leg_length = 0.84;  // hip to ankle
  double upper_arm_radius = 0.048;
  double lower_arm_radius = 0.036;
  double upper_leg_radius = 0.075;
  double lower_leg_radius = 0.050;
  double belly = 0.0;       // metres that the belly bulges beyond the template's
  double hand_scale = 1.0;  // of the template's hand at this height
};
Body MakeBody(std::string_view name, const BodyShape& shape);

/// A body of rigs' poverty: no clavicles, no neck, one spine joint, no hands of its own, no toes.
Body PoorRig();
/// Cartoon proportions: legs of a fifth of its height under hips twice as wide, short thick arms, a
/// round belly. Most contacts are out of its reach.
Body Stubby();

/// The body reflected in x = 0, left and right exchanged.
Body Mirrored(const Body& body);

}  // namespace ego::test
