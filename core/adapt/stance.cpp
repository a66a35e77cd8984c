// SPDX-License-Identifier: MIT
#include "core/adapt/stance.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/denormalize.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Share of a leg's length that it is stretched to where the performer's is bent more.
constexpr double kUsableReach = 0.975;
/// Rise over leg length that makes the leg that needs less of it e times as heavy.
constexpr double kLowerLegWins = 0.3;
/// Way to the standing place, over the leg's length, from which on it counts less, and at which it
/// is given up.
constexpr double kTooFar = 0.1;
constexpr double kGivesUp = 0.8;
/// Metres below which a foot is as near to the ground as counts.
constexpr double kContactGap = 0.0004;

}  // namespace

void StandOnLegs(AdaptState& state) {
  const double near = state.scale * state.settings.root_height_fade;
  if (!(near > 0.0)) return;
  double weight_sum = 0.0;
  double rise_sum = 0.0;
  double in_air = 1.0;
  for (const Limb leg : {Limb::kLeftLeg, Limb::kRightLeg}) {
    const LimbChain& chain = state.chain[Index(leg)];
    const double gap = state.egocentric.point[Index(EndPoint(leg))].ground.gap;
    const double share = 1.0 - Smoothstep(gap * state.avatar.standing_root_height / near);
    if (!(share > 0.0) || !chain.has_bones) continue;
    const double reach = chain.Reach();
    const Vec3 to_hip = chain.base_ws - DenormalizeGround(state, leg);
    const Vec3 captured = chain.base_ws - Place(chain, chain.captured).end;
    // As long as the captured leg is, or nearly straight if that is longer.
    const double longest = std::max(glm::length(captured), kUsableReach * reach);
    const double room = longest * longest - to_hip.x * to_hip.x - to_hip.z * to_hip.z;
    const double least = 0.25 * reach * reach;  // a wider stance is left out of reach
    const double highest = std::sqrt(least + SoftRamp(room, 2.0 * least));
    const double wanted = captured.y - SoftRamp(captured.y - highest, 0.03 * reach);
    const double rise = wanted - to_hip.y;
    const double weight =
        share * std::exp(std::clamp(-rise / (kLowerLegWins * reach), -30.0, 30.0));
    weight_sum += weight;
    rise_sum += weight * rise;
    in_air *= 1.0 - share;
  }
  if (!(weight_sum > 0.0)) return;
  state.MoveRoot({0.0, (1.0 - in_air) * rise_sum / weight_sum, 0.0});
}

void LockStance(AdaptState& state, Limb leg) {
  const double height = state.scale * state.settings.stance_height;
  if (!(height > 0.0)) return;
  const PointCoordinates& ankle = state.egocentric.point[Index(EndPoint(leg))];
  double other = ankle.mesh_importance_max;
  for (const CapsuleRelation& r : ankle.capsule) other = std::max(other, r.importance);
  // A foot that something else is nearer to than the ground, as in sitting cross-legged, is not
  // standing. Heights up to `height` count as on the ground: floors are not known better.
  const double sole = ankle.ground.gap * state.avatar.standing_root_height;
  const double above = std::max(sole - height, kContactGap * state.scale) / state.avatar.height;
  const double ground = 1.0 / above;
  const double share = ground / (ground + other * ankle.importance_sum);
  const double fade = state.scale * state.settings.stance_fade;
  const double lock = Smoothstep(1.0 + (height - sole) / fade) * Smoothstep((share - 0.5) / 0.4);
  if (!(lock > 0.0)) return;
  const LimbChain& chain = state.chain[Index(leg)];
  const LimbPosture& posture = state.limb[Index(leg)];
  const Vec3 end = Place(chain, posture).end;
  // The farther from where the leg would have put it, the less: a leg that is very short for the
  // root's scale would be thrown between both as the foot comes down, and where its foot belongs
  // beside its own hip, nothing that it could do looks like standing.
  const Vec3 ground_end = DenormalizeGround(state, leg);
  const double off = glm::distance(ground_end, end) / chain.Reach();
  const double held = lock * (1.0 - Smoothstep((off - kTooFar) / (kGivesUp - kTooFar)));
  state.Apply(leg, ReachEnd(chain, posture, glm::mix(end, ground_end, held)));
}

}  // namespace ego
