// SPDX-License-Identifier: MIT
#include "core/adapt/stance.h"

#include <algorithm>

#include "core/adapt/denormalize.h"
#include "core/geometry/smooth.h"

namespace ego {

void LockStance(AdaptState& state, Limb leg) {
  const double height = state.scale * state.settings.stance_height;
  if (!(height > 0.0)) return;
  const PointCoordinates& ankle = state.egocentric.point[Index(EndPoint(leg))];
  double other = ankle.mesh_importance_max;
  for (const CapsuleRelation& r : ankle.capsule) other = std::max(other, r.importance);
  const double share = ankle.ground.importance / (ankle.ground.importance + other);
  const double sole = ankle.ground.gap * state.avatar.standing_root_height;
  const double lock = Smoothstep(2.0 - sole / height) * Smoothstep((share - 0.5) / 0.4);
  if (!(lock > 0.0)) return;
  const LimbChain& chain = state.chain[Index(leg)];
  const LimbPosture& posture = state.limb[Index(leg)];
  const Vec3 end = Place(chain, posture).end;
  state.Apply(leg, ReachEnd(chain, posture, glm::mix(end, DenormalizeGround(state, leg), lock)));
}

}  // namespace ego
