// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/adapt/limb_chain.h"
#include "core/base/math.h"
#include "core/geometry/lanes.h"

namespace ego {

/// Standard limb IK [34]: the end joint is brought to `end_target`, then the mid joint as near to
/// `mid_target` as turning about the line from base to end allows, bounded by the flexion, and no
/// farther than the chain's `swivel_share`.
/// Starts from `posture` and changes as little of it as needed; a target out of reach is pointed
/// at. Singular cases: a target at the base joint keeps the direction; a mid target on the line
/// from base to end keeps the swivel.
LimbPosture StandardIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target);

/// The same without a mid target: the swivel is kept.
LimbPosture ReachEnd(const LimbChain& chain, const LimbPosture& posture, const Vec3& end_target);

/// Reversed priorities (figure 16): the mid joint is brought to the closest point to its target,
/// then base twist and flexion bring the end as near to its own as they can, the twist bounded by
/// the flexion. Singular cases: an end target at the mid joint keeps the flexion; one on the upper
/// bone's line keeps the twist.
LimbPosture ReversedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target);

/// Both, interpolated in joint-angle space: gamma 0 is the standard, 1 the reversed solution
/// (appendix C).
LimbPosture BlendedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                      const Vec3& end_target, double gamma);

/// What one limb of a pair is to do; the members are the arguments above.
struct LimbTask {
  const LimbChain* chain = nullptr;
  LimbPosture start;
  Vec3 mid_target{0.0};
  Vec3 end_target{0.0};
  double gamma = 0.0;
};
/// Two limbs at once, each exactly as it would be alone, on any processor.
std::array<LimbPosture, 2> BlendedIk(const std::array<LimbTask, 2>& task,
                                     LaneWidth lanes = FastestLanes());

/// The twist that may be used of a wanted `angle` at a flexion: the least of |angle|, flexion and
/// pi - |angle|, without a kink, signed. Zero for a straight limb and for a half turn, where the
/// direction is undecided.
double BoundTwist(double angle, double flexion);

}  // namespace ego
