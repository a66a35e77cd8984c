// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/egocentric/limb_point.h"
#include "core/egocentric/posed_body.h"

namespace ego {

struct AdaptState;

/// Equation 2 for a limb's mid or end joint with its points and relations collapsed into what the
/// avatar's posture leaves of them: every term lambda-hat (x + v) is linear in the ends and the
/// frame of its capsule. Made once per frame.
struct JointTarget {
  struct OnCapsule {
    double start = 0.0;
    double end = 0.0;
    Vec3 offset_ls{0.0};  // in the bone frame
  };
  /// Share of each point's sum over trunk and head: of a mid joint or a leg's end one point, of an
  /// arm's end wrist, palm and fingertip.
  std::array<LimbPoint, 3> point{};
  std::array<double, 3> on_body{};
  std::size_t point_count = 0;
  /// The other limbs' segments by slot, then the other hand; those up to `capsule_count` matter.
  std::array<OnCapsule, kOtherCapsuleCount> on_capsule{};
  std::array<std::uint8_t, kOtherCapsuleCount> slot{};
  std::size_t capsule_count = 0;
  double on_partner = 0.0;   // of the partner's end joint
  double on_ground = 0.0;    // of where the ground wants an ankle
  double on_captured = 0.0;  // of where the captured joint angles put a leg's joint
  Vec3 hand_offset_ls{0.0};  // from the wrist to the mean of an arm's points
};

/// How much a point of a hand counts among the three: what touches decides.
double HandWeight(const AdaptState& state, LimbPoint j);

/// Mid and end of a limb; needs `capsule_reach`.
std::array<JointTarget, 2> MakeJointTargets(const AdaptState& state, Limb limb);

/// A wanted position that depends on the partner's end joint: constant + on_partner * partner.
struct LinearTarget {
  Vec3 constant{0.0};
  double on_partner = 0.0;
};
/// Mid and end in the current state of the body.
std::array<LinearTarget, 2> Evaluate(const AdaptState& state, Limb limb);

}  // namespace ego
