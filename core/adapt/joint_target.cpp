// SPDX-License-Identifier: MIT
#include "core/adapt/joint_target.h"

#include <span>

#include "core/adapt/adapt_state.h"
#include "core/adapt/denormalize.h"

namespace ego {
namespace {

/// Terms by slot, before those that matter are put together.
using Terms = std::array<JointTarget::OnCapsule, kOtherCapsuleCount>;

void AddPoint(const AdaptState& state, LimbPoint j, double weight, JointTarget& target,
              Terms& terms) {
  const Limb limb = LimbOf(j);
  const PointCoordinates& coordinates = state.egocentric.point[Index(j)];
  const auto& reach = state.capsule_reach[Index(j)];
  target.point[target.point_count] = j;
  target.on_body[target.point_count++] = weight;
  for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
    const CapsuleRelation& relation = coordinates.capsule[slot];
    const double share = weight * relation.importance;
    terms[slot].start += share * (1.0 - relation.axial);
    terms[slot].offset_ls += share * reach[slot] * relation.direction_ls;
    const LimbSegment other = OtherSegment(limb, slot);
    if (LimbOf(other) == Mirror(limb) && IsLower(other)) {
      target.on_partner += share * relation.axial;
    } else {
      terms[slot].end += share * relation.axial;
    }
  }
  // The other hand begins at the partner's end joint.
  const CapsuleRelation& hand = coordinates.hand;
  const double share = weight * hand.importance;
  terms[kHandSlot].start -= share * hand.axial;
  terms[kHandSlot].end += share * hand.axial;
  terms[kHandSlot].offset_ls += share * reach[kHandSlot] * hand.direction_ls;
  target.on_partner += share;
  target.on_ground += weight * coordinates.ground.importance;
  if (IsHandPoint(j)) {
    target.hand_offset_ls += weight * state.constants.hand_point_offset[Index(j) - kLimbJointCount];
  }
}

void Collect(const Terms& terms, JointTarget& target) {
  for (std::size_t slot = 0; slot < terms.size(); ++slot) {
    const JointTarget::OnCapsule& term = terms[slot];
    if (term.start == 0.0 && term.end == 0.0 && term.offset_ls == Vec3{0.0}) continue;
    target.slot[target.capsule_count] = static_cast<std::uint8_t>(slot);
    target.on_capsule[target.capsule_count++] = term;
  }
}

/// A leg's joint, drawn to where the captured joint angles put it. The ground is left to
/// `LockStance`, which holds feet by their height alone.
JointTarget MakeLegTarget(const AdaptState& state, LimbPoint j) {
  JointTarget target;
  Terms terms;
  const double gap = state.settings.leg_gap / 1.78;
  if (!(gap > 0.0)) {
    AddPoint(state, j, 1.0, target, terms);
  } else {
    const PointCoordinates& coordinates = state.egocentric.point[Index(j)];
    const double anchor = 1.0 / (gap * coordinates.importance_sum);
    const double sum = 1.0 - coordinates.ground.importance + anchor;
    AddPoint(state, j, 1.0 / sum, target, terms);
    target.on_ground = 0.0;
    target.on_captured = anchor / sum;
  }
  Collect(terms, target);
  return target;
}

/// What the points of an arm's end ask of its end joint together, or an elbow.
JointTarget MakeArmTarget(const AdaptState& state, std::span<const LimbPoint> points) {
  double sum = 0.0;
  for (const LimbPoint j : points) sum += HandWeight(state, j);
  JointTarget target;
  Terms terms;
  for (const LimbPoint j : points) AddPoint(state, j, HandWeight(state, j) / sum, target, terms);
  Collect(terms, target);
  return target;
}

LinearTarget EvaluateOne(const AdaptState& state, Limb limb, const JointTarget& target) {
  Vec3 sum{0.0};
  for (std::size_t k = 0; k < target.point_count; ++k) {
    const BodySum& body = state.body_sum[GroupOf(target.point[k])];
    const std::size_t lane = LaneOf(target.point[k]);
    sum += target.on_body[k] * (body.trunk.At(lane) + body.head.At(lane));
  }
  for (std::size_t k = 0; k < target.capsule_count; ++k) {
    const std::size_t slot = target.slot[k];
    const PosedCapsule& capsule = slot == kHandSlot
                                      ? state.posed.hand[Index(Mirror(limb))]
                                      : state.posed.capsule[Index(OtherSegment(limb, slot))];
    const JointTarget::OnCapsule& on = target.on_capsule[k];
    sum += on.start * capsule.start + on.end * capsule.end + capsule.frame * on.offset_ls;
  }
  if (target.on_ground > 0.0) sum += target.on_ground * DenormalizeGround(state, limb);
  return {sum, target.on_partner};
}

}  // namespace

double HandWeight(const AdaptState& state, LimbPoint j) {
  const double gap = 1.0 / state.egocentric.point[Index(j)].importance_max;
  const double softened = 1.0 / (gap + state.settings.hand_softness / 1.78);
  return softened * softened;
}

std::array<JointTarget, 2> MakeJointTargets(const AdaptState& state, Limb limb) {
  if (!IsArm(limb)) {
    return {MakeLegTarget(state, MidPoint(limb)), MakeLegTarget(state, EndPoint(limb))};
  }
  const std::array<LimbPoint, 1> mid = {MidPoint(limb)};
  const std::array<LimbPoint, 3> end = {EndPoint(limb), PalmPoint(limb), FingertipPoint(limb)};
  const std::size_t count = state.egocentric.form.hand_points ? 3 : 1;
  return {MakeArmTarget(state, mid), MakeArmTarget(state, std::span(end).first(count))};
}

std::array<LinearTarget, 2> Evaluate(const AdaptState& state, Limb limb) {
  const std::array<JointTarget, 2>& target = state.joint_target[Index(limb)];
  std::array<LinearTarget, 2> wanted = {EvaluateOne(state, limb, target[0]),
                                        EvaluateOne(state, limb, target[1])};
  if (IsArm(limb)) {
    wanted[1].constant -= state.extremity_ws[Index(limb)] * target[1].hand_offset_ls;
  } else if (target[1].on_captured > 0.0) {
    const LimbChain& chain = state.chain[Index(limb)];
    const LimbPlacement captured = Place(chain, chain.captured);
    wanted[0].constant += target[0].on_captured * captured.mid;
    wanted[1].constant += target[1].on_captured * captured.end;
  }
  return wanted;
}

}  // namespace ego
