// SPDX-License-Identifier: MIT
#include "core/adapt/denormalize.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/half_space.h"
#include "core/adapt/joint_target.h"
#include "core/egocentric/capsule_relations.h"
#include "core/geometry/rotation.h"

namespace ego {
namespace {

/// From the end joint to a point of the hand, as the hand will end.
Vec3 HandOffset(const AdaptState& state, LimbPoint j) {
  if (!IsHandPoint(j)) return Vec3{0.0};
  return state.extremity_ws[Index(LimbOf(j))] *
         state.constants.hand_point_offset[Index(j) - kLimbJointCount];
}

/// The half-spaces of the legs for an arm's point (section 6.1), deflated by the segment that ends
/// in it; points of the hand are taken back to the wrist. Points of legs are left alone.
class LegRegion {
 public:
  LegRegion(const AdaptState& state, LimbPoint j) : hand_(HandOffset(state, j)) {
    const Limb arm = LimbOf(j);
    if (!IsArm(arm)) return;
    const auto segment = static_cast<LimbSegment>(2 * Index(arm) + (j == MidPoint(arm) ? 0 : 1));
    for (; count_ < leg_.size(); ++count_) {
      const std::size_t slot = 2 + count_;
      leg_[count_] =
          MapPlane(state.egocentric.plane[Index(segment)][slot],
                   state.posed.capsule[Index(OtherSegment(arm, slot))], state.avatar.height);
      leg_[count_].offset +=
          state.avatar.surface.limb_radius[Index(segment)] + glm::dot(leg_[count_].normal, hand_);
    }
  }
  /// The point, brought onto every boundary that it lies outside of.
  Vec3 Inside(Vec3 p) const {
    for (std::size_t k = 0; k < count_; ++k) {
      const double distance = leg_[k].Distance(p);
      if (distance < 0.0) p -= distance * leg_[k].normal;
    }
    return p;
  }

 private:
  Vec3 hand_;
  std::array<HalfSpace, 4> leg_;
  std::size_t count_ = 0;
};

Vec3 PartnerEnd(const AdaptState& state, Limb limb) {
  return state.posed.point[Index(EndPoint(Mirror(limb)))];
}

Vec3 Resolve(const LinearTarget& target, const Vec3& partner_end) {
  return target.constant + target.on_partner * partner_end;
}

/// The nearest point that the limb's end can reach.
Vec3 WithinReach(const LimbChain& chain, const Vec3& target) {
  const Vec3 offset = target - chain.base_ws;
  const double distance = glm::length(offset);
  const double reach = chain.Reach();
  return distance > reach ? chain.base_ws + offset * (reach / distance) : target;
}

}  // namespace

void MeasureCapsuleReach(AdaptState& state) {
  for (std::size_t group = 0; group < kPointGroupCount; ++group) {
    std::array<Quad, kOtherCapsuleCount> reach;
    CapsuleReaches(state.avatar, state.constants, state.egocentric.form, group,
                   state.egocentric.capsule_distance[group], reach);
    for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
      auto& of_point = state.capsule_reach[Index(kPointGroups[group][lane])];
      for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
        of_point[slot] = reach[slot][lane];
      }
    }
  }
}

Vec3 DenormalizeGround(const AdaptState& state, Limb leg) {
  const GroundRelation& relation = state.egocentric.point[Index(EndPoint(leg))].ground;
  const double h_root = state.avatar.standing_root_height;
  const Vec3& root = state.posed.pose.position_ws[0];
  const Vec3 sole{root.x + h_root * relation.offset.x, h_root * relation.gap,
                  root.z + h_root * relation.offset.y};
  if (!state.egocentric.form.sole_contact) return sole;
  const SoleOffset offset = MeasureSole(state.avatar, state.constants, leg,
                                        state.extremity_ws[Index(leg)], relation.on_ball);
  const Vec2& standing = state.standing_place[IsLeft(leg) ? 0 : 1];
  return sole + Vec3{standing.x, 0.0, standing.y} -
         Vec3{offset.middle.x, offset.low, offset.middle.z};
}

void SumBody(AdaptState& state) {
  for (std::size_t group = 0; group < kPointGroupCount; ++group) {
    state.body_sum[group] = SumOverBody(state.egocentric.mesh[group], state.constants, state.posed,
                                        group, state.egocentric.form.own_thickness);
  }
  for (const Limb limb : kLimbs) {
    state.normal_sum[Index(limb)] = SumOfNormals(state.egocentric.normal[Index(limb)], state.posed);
  }
}

LimbTargets TargetsOf(const AdaptState& state, Limb limb) {
  const Vec3 partner = PartnerEnd(state, limb);
  const std::array<LinearTarget, 2> open = Evaluate(state, limb);
  return {Resolve(open[0], partner), Resolve(open[1], partner)};
}

std::array<LimbTargets, 2> TargetsOfPair(const AdaptState& state, Limb left) {
  const std::array<Limb, 2> limb = {left, Mirror(left)};
  const std::array<std::array<LinearTarget, 2>, 2> joint = {Evaluate(state, limb[0]),
                                                            Evaluate(state, limb[1])};
  const std::array<LinearTarget, 2> open = {joint[0][1], joint[1][1]};
  // end_k = c_k + m_k end_other, both at once. The shares are below one by what trunk, head and
  // ground have; the floor only matters for a point that touches nothing but its partner.
  const double determinant = std::max(1e-3, 1.0 - open[0].on_partner * open[1].on_partner);
  std::array<Vec3, 2> end;
  for (std::size_t k = 0; k < 2; ++k) {
    const LinearTarget& own = open[k];
    const LinearTarget& other = open[1 - k];
    const double shortfall =
        determinant - (1.0 - own.on_partner * other.on_partner);  // zero but for the floor
    end[k] = (own.constant + own.on_partner * other.constant +
              shortfall * state.posed.point[Index(EndPoint(limb[k]))]) /
             determinant;
  }
  const std::array<Vec3, 2> reached = {WithinReach(state.chain[Index(limb[0])], end[0]),
                                       WithinReach(state.chain[Index(limb[1])], end[1])};
  std::array<LimbTargets, 2> targets;
  for (std::size_t k = 0; k < 2; ++k) {
    targets[k].end = Resolve(open[k], reached[1 - k]);
    targets[k].mid = Resolve(joint[k][0], reached[1 - k]);
  }
  return targets;
}

LimbTargets InitialTargets(const AdaptState& state, Limb arm) {
  const auto target_of = [&](LimbPoint j) {
    const PointCoordinates& coordinates = state.egocentric.point[Index(j)];
    const LegRegion region(state, j);
    const MeshCoordinates& mesh = state.egocentric.mesh[GroupOf(j)];
    const BodySum& body = state.body_sum[GroupOf(j)];
    const std::size_t lane = LaneOf(j);
    Vec3 sum{0.0};
    double importance = 0.0;
    const auto add = [&](const Vec3& part, double share) {
      if (share > 0.0) sum += share * region.Inside(part / share);
      importance += share;
    };
    add(body.trunk.At(lane), mesh.trunk.importance[lane]);
    add(body.head.At(lane), mesh.head.importance[lane]);
    for (std::size_t slot = 2; slot < kOtherSegmentCount; ++slot) {  // 0, 1: the other arm
      const LimbSegment other = OtherSegment(arm, slot);
      const CapsuleRelation& relation = coordinates.capsule[slot];
      sum += relation.importance *
             region.Inside(DenormalizeCapsule(relation, state.posed.capsule[Index(other)],
                                              state.capsule_reach[Index(j)][slot]));
      importance += relation.importance;
    }
    return sum / importance - HandOffset(state, j);
  };

  LimbTargets targets;
  targets.mid = target_of(MidPoint(arm));
  if (!state.egocentric.form.hand_points) {
    targets.end = target_of(EndPoint(arm));
    return targets;
  }
  double sum = 0.0;
  for (const LimbPoint j : {EndPoint(arm), PalmPoint(arm), FingertipPoint(arm)}) {
    const double weight = HandWeight(state, j);
    targets.end += weight * target_of(j);
    sum += weight;
  }
  targets.end /= sum;
  return targets;
}

}  // namespace ego
