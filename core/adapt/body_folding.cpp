// SPDX-License-Identifier: MIT
#include "core/adapt/body_folding.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/denormalize.h"
#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Smaller of both hips' forward flexions, radians, faded in.
double StandingBound(const AdaptState& state) {
  const Quat to_hips = glm::conjugate(state.posed.pose.rotation_ws[0]);
  double flexion = kPi;
  for (const Limb leg : {Limb::kLeftLeg, Limb::kRightLeg}) {
    const LimbJoints joints = JointsOf(leg);
    const Vec3 thigh =
        to_hips * (state.posed.pose.Position(joints.mid) - state.posed.pose.Position(joints.base));
    flexion = std::min(flexion, std::max(0.0, std::atan2(thigh.z, -thigh.y)));
  }
  const double begin = Radians(state.settings.folding_begin);
  const double full = Radians(state.settings.folding_full);
  return full > begin ? flexion * Smoothstep((flexion - begin) / (full - begin)) : flexion;
}

double WantedPitch(const AdaptState& state) {
  const Vec3& root = state.posed.pose.position_ws[0];
  const Vec3 axis = state.posed.pose.rotation_ws[0] * Vec3{1.0, 0.0, 0.0};
  double sine = 0.0;
  double cosine = 0.0;
  double leg_importance = 0.0;
  double all_importance = 0.0;
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
    for (const LimbPoint j : {MidPoint(arm), EndPoint(arm)}) {
      const PointCoordinates& coordinates = state.egocentric.point[Index(j)];
      const Vec3 achieved = Perpendicular(state.posed.point[Index(j)] - root, axis);
      all_importance += coordinates.importance_sum;
      for (std::size_t slot = 2; slot < kOtherSegmentCount; ++slot) {
        const CapsuleRelation& relation = coordinates.capsule[slot];
        const LimbSegment segment = OtherSegment(arm, slot);
        const Vec3 p = DenormalizeCapsule(relation, state.posed.capsule[Index(segment)],
                                          state.capsule_reach[Index(j)][slot]);
        const Vec3 desired = Perpendicular(p - root, axis);
        const double lambda = relation.importance * coordinates.importance_sum;
        sine += lambda * glm::dot(axis, glm::cross(achieved, desired));
        cosine += lambda * glm::dot(achieved, desired);
        leg_importance += lambda;
      }
    }
  }
  const double theta = sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
  if (!state.settings.folding_by_share) return theta;
  // Behind the root it is undecided which way round is meant: beyond a quarter turn less is done.
  const double decided = Smoothstep(2.0 - 2.0 * std::abs(theta) / kPi);
  return theta * decided * leg_importance / all_importance;
}

}  // namespace

bool FoldBody(AdaptState& state) {
  if (state.avatar.skeleton.locked[0]) return false;
  const double bound = StandingBound(state);
  if (!(bound > 0.0)) return false;
  const double wanted = WantedPitch(state);
  const double theta = bound * std::tanh(wanted / bound);
  if (std::abs(theta) < 1e-14) return false;

  const ModelPose before = state.posed.pose;
  const Vec3 axis = before.rotation_ws[0] * Vec3{1.0, 0.0, 0.0};
  const std::array<LimbPosture, kLimbCount> limb = state.limb;
  state.pose.rotation_ls[0] =
      glm::normalize(glm::angleAxis(theta, axis) * state.pose.rotation_ls[0]);
  for (const Limb l : kLimbs) {
    state.pose.rotation_ls[Index(JointsOf(l).base)] = limb[Index(l)].base;
    state.pose.rotation_ls[Index(JointsOf(l).mid)] = limb[Index(l)].mid;
  }
  if (!state.avatar.skeleton.locked[Index(HumanoidJoint::kHead)]) {
    const ModelPose folded = ForwardKinematics(state.avatar.skeleton, state.pose);
    state.pose.rotation_ls[Index(HumanoidJoint::kHead)] =
        glm::normalize(glm::conjugate(folded.Rotation(HumanoidJoint::kNeck)) *
                       before.Rotation(HumanoidJoint::kHead));
  }
  state.posed.pose = ForwardKinematics(state.avatar.skeleton, state.pose);
  PlaceTriangles(state.avatar, state.constants, state.posed);
  for (const Limb l : kLimbs) {
    const LimbJoints joints = JointsOf(l);
    LimbChain& chain = state.chain[Index(l)];
    chain.base_ws = state.posed.pose.Position(joints.base);
    chain.frame_ws = state.posed.pose.Rotation(Parent(joints.base));
    state.Apply(l, IsArm(l) ? limb[Index(l)]
                            : StandardIk(chain, limb[Index(l)], before.Position(joints.mid),
                                         before.Position(joints.end)));
  }
  SumBody(state);
  return true;
}

}  // namespace ego
