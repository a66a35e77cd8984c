// SPDX-License-Identifier: MIT
#include "core/adapt/extremity.h"

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {

Quat AlignExtremity(const AdaptState& state, Limb limb, const Quat& rotation_ws) {
  if (state.avatar.skeleton.locked[Index(JointsOf(limb).end)]) return rotation_ws;
  const EgocentricPose& egocentric = state.egocentric;
  const PointCoordinates& coordinates = egocentric.point[Index(OrientingPoint(egocentric, limb))];
  const NormalCoordinates& deviation = egocentric.normal[Index(limb)];

  Vec3 sum = state.normal_sum[Index(limb)] + coordinates.ground.importance * deviation.ground;
  for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
    const PosedCapsule& capsule = state.posed.capsule[Index(OtherSegment(limb, slot))];
    sum += coordinates.capsule[slot].importance * (capsule.frame * deviation.capsule[slot]);
  }
  const BodySurface& surface = state.avatar.surface;
  const std::size_t side = IsLeft(limb) ? 0 : 1;
  const Vec3& normal_ms =
      IsArm(limb) ? surface.hand[side].palm_normal_ms : surface.foot[side].sole_normal_ms;
  // Feet keep to the captured joint angles as their ankles do.
  const double gap = IsArm(limb) ? 0.0 : state.settings.leg_gap / 1.78;
  if (gap > 0.0) {
    const double anchor = 1.0 / (gap * coordinates.importance_sum);
    sum = (sum + anchor * (rotation_ws * normal_ms)) / (1.0 + anchor);
  }
  const double length = glm::length(sum);
  if (length < 1e-6) return rotation_ws;

  const Quat turn =
      SmallestRotation(rotation_ws * normal_ms, sum / length, rotation_ws * Vec3{1.0, 0.0, 0.0});
  // Opposed requests shorten the sum; below a third of full agreement they count in part.
  const double part = Smoothstep(3.0 * length);
  return glm::normalize((part < 1.0 ? Slerp(kIdentity, turn, part) : turn) * rotation_ws);
}

}  // namespace ego
