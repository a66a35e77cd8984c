// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Equation 2 of one tuple on the avatar: reference point plus denormalised displacement, world
/// space. `reach` is the length of the displacement (AdaptState::capsule_reach).
inline Vec3 DenormalizeCapsule(const CapsuleRelation& relation, const PosedCapsule& capsule,
                               double reach) {
  return capsule.At(relation.axial) + reach * (capsule.frame * relation.direction_ls);
}
/// An ankle against the ground: where it must be for the sole to keep its place and height in
/// standing root heights, with the foot turned as it will end.
Vec3 DenormalizeGround(const AdaptState& state, Limb leg);

/// Fills `capsule_reach`, which no posture changes.
void MeasureCapsuleReach(AdaptState& state);

/// Sums over trunk and head for all points and normals, from the triangles in place.
void SumBody(AdaptState& state);

/// Where a limb's mid and end joints are wanted.
struct LimbTargets {
  Vec3 mid{0.0};
  Vec3 end{0.0};
};

/// Equation 2 for a limb against everything in its current place. The end joint of an arm is wanted
/// where wrist, palm and fingertip agree: the mean of what each asks of the wrist, with the square
/// of its largest importance, so that what touches decides.
LimbTargets TargetsOf(const AdaptState& state, Limb limb);

/// The same for both limbs of a pair at once. The end joints' mutual relations are solved exactly:
/// two hands that hold each other would otherwise run away together, since each only knows where
/// the other is. A target out of reach is drawn to where the limb can reach before the partner's is
/// taken from it.
std::array<LimbTargets, 2> TargetsOfPair(const AdaptState& state, Limb left);

/// Targets of an arm for the initial posture (section 6.1): the other arm is ignored, and every
/// component is brought into the half-spaces of the legs before the mean is taken; trunk and head
/// are one component each.
LimbTargets InitialTargets(const AdaptState& state, Limb arm);

}  // namespace ego
