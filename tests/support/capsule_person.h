// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/character.h"

namespace ego::test {

/// A simple closed-form character for tests that must not depend on the generated people: tubes
/// and ellipsoids around the template skeleton, skinned smoothly along the spine and at elbows and
/// knees. Its surface is known: see the members.
struct CapsulePersonOptions {
  double height = 1.78;
  double belly = 0.0;         // added to the belly's front, metres at 1.78
  double left_arm = 1.0;      // thickness factor: an asymmetric person
  double arm_radius = 0.045;  // at 1.78
  double leg_radius = 0.065;
  bool rigid = false;  // every vertex on one joint, each piece a part of its own
};
Character MakeCapsulePerson(const CapsulePersonOptions& options = {});

/// The character reflected in x = 0, left and right exchanged, in a file of its own.
Character Mirrored(const Character& character);

/// The character with its mesh, rig and skeleton in a unit `factor` times as large.
Character Scaled(const Character& character, double factor);

}  // namespace ego::test
