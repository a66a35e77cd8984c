// SPDX-License-Identifier: MIT
#include "core/adapt/hand_reach.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// In arm's lengths beyond the arm's reach: over which a target becomes too far.
constexpr double kRamp = 0.20;
/// What is used of the way to pointing straight at the place, at most: there the angle would end
/// in a kink.
constexpr double kMostTurn = 0.9;
/// 1 + cosine of hand and place below which the way round is undecided.
constexpr double kOpposite = 0.3;

/// How near the performer's hand is to any surface, 0 to 1.
double Nearness(const AdaptState& state, Limb arm) {
  double priority = 0.0;
  for (const LimbPoint j : {EndPoint(arm), PalmPoint(arm), FingertipPoint(arm)}) {
    priority = std::max(priority, state.egocentric.point[Index(j)].priority);
  }
  const double scaled = priority * state.settings.hand_reach_gap / 1.78;
  return scaled * scaled / (1.0 + scaled * scaled);
}

/// Angle whose 2 (1 - cosine) is `q`.
double AngleOfChord(double q) { return 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(q))); }

}  // namespace

void ReachWithHand(AdaptState& state, Limb arm, LimbTargets& targets) {
  const LimbChain& chain = state.chain[Index(arm)];
  if (!chain.has_bones || state.avatar.skeleton.locked[Index(JointsOf(arm).end)]) return;
  const double wanted = glm::distance(targets.end, chain.base_ws);
  const double beyond = SoftRamp(wanted - chain.Reach(), kRamp * chain.Reach());
  if (!(beyond > 0.0)) return;
  const double near = Nearness(state, arm);
  if (!(near > 0.0)) return;
  const Quat hand_ws = state.extremity_ws[Index(arm)];
  const Vec3 hand = hand_ws * state.joint_target[Index(arm)][1].hand_offset_ls;
  const Vec3 place = targets.end + hand - chain.base_ws;
  const double lengths = glm::length(hand) * glm::length(place);
  if (!(lengths > 1e-12)) return;

  // Wrist, hand and place by the law of cosines: 2 (1 - cosine) of the angle between hand and
  // place, and how much less of it brings the wrist nearer by `beyond`.
  const double cosine = glm::dot(hand, place) / lengths;
  const double now = 2.0 * std::max(0.0, 1.0 - cosine);
  const double most = kMostTurn * now;
  if (!(most > 0.0)) return;
  const double nearer = wanted - beyond;
  const double needed = (wanted * wanted - nearer * nearer) / lengths;
  const double used = needed / std::sqrt(1.0 + needed * needed / (most * most));
  const double angle = near * Smoothstep((1.0 + cosine) / kOpposite) *
                       (AngleOfChord(now) - AngleOfChord(now - used));
  const Quat turn = FromRotationVector(angle * NormalizedOr(glm::cross(hand, place), Vec3{0.0}));
  state.TurnExtremity(arm, glm::normalize(turn * hand_ws));
  targets.end -= turn * hand - hand;
}

}  // namespace ego
