// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/math.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// Local rotations of the base and mid joints.
struct LimbPosture {
  Quat base = kIdentity;
  Quat mid = kIdentity;
};

/// A limb's two joints as they can turn: what does not change during the limb loop.
struct LimbChain {
  Vec3 base_ws{0.0};          // shoulder or hip
  Quat frame_ws = kIdentity;  // of the base joint's parent
  Vec3 upper_ls{0.0};         // base to mid, canonical pose
  Vec3 lower_ls{0.0};         // mid to end, canonical pose
  Vec3 hinge_ls{0.0};         // canonical flexion axis
  // The same bones as unit vectors and lengths; zero vectors for a limb without bones.
  Vec3 upper_unit{0.0};
  Vec3 lower_unit{0.0};
  double upper_length = 0.0;
  double lower_length = 0.0;
  Vec3 hinge_across{0.0};  // unit: the part of the hinge at right angles to the upper bone
  bool has_bones = false;
  bool base_locked = false;
  bool mid_locked = false;
  LimbPosture captured;           // the captured joint angles
  double captured_deficit = 0.0;  // 1 - cos(flexion) of the captured joint angles
  double captured_flexion = 0.0;  // signed, radians
  double reach_softness = 0.0;    // AdaptSettings
  double swivel_share = 1.0;      // of the swivel towards the mid joint's target

  double Reach() const { return upper_length + lower_length; }
};

/// Where a posture puts the limb, world space.
struct LimbPlacement {
  Quat base_ws = kIdentity;
  Quat mid_ws = kIdentity;
  Vec3 mid{0.0};
  Vec3 end{0.0};
};
LimbPlacement Place(const LimbChain& chain, const LimbPosture& posture);

/// Chain of a limb of a skeleton whose parent joint is placed; `captured` are its joint angles
/// before any adaptation.
LimbChain MakeChain(const Skeleton& skeleton, Limb limb, const Vec3& base_ws, const Quat& frame_ws,
                    const LimbPosture& captured, double reach_softness);

/// How far the canonical hinge pulls the flexion axis, as a sine: it rules below 20 degrees.
inline constexpr double kHingeWeight = 0.35;

/// Flexion of the mid joint, measured on the actual bones: captured elbows are no perfect hinges.
/// The axis is the normal of both bones, drawn towards the canonical hinge where they are nearly
/// straight; signed, so that an over-stretched knee is a small negative angle.
struct Flexion {
  Vec3 axis_ls{0.0};      // unit, at right angles to the upper bone, in the base joint's frame
  double angle = 0.0;     // of the lower bone's part in the hinge plane
  double in_plane = 1.0;  // length of that part, in [0, 1]
};
Flexion MeasureFlexion(const LimbChain& chain, const Quat& mid);

}  // namespace ego
