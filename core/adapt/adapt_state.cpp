// SPDX-License-Identifier: MIT
#include "core/adapt/adapt_state.h"

#include <algorithm>

#include "core/adapt/denormalize.h"
#include "core/baselines/copy_joint_angles.h"

namespace ego {
namespace {

/// Priority of a point in appendix C. `softness` (metres over height) keeps it from growing without
/// bound and so from turning faster than the surfaces approach.
double Priority(double importance, double softness) {
  return importance > 0.0 ? 1.0 / (softness + 1.0 / importance) : 0.0;
}

}  // namespace

AdaptState::AdaptState(const Body& body, const EgocentricPose& coordinates,
                       const AdaptSettings& choices)
    : avatar(body),
      egocentric(coordinates),
      settings(choices),
      constants(body),
      scale(body.height / 1.78) {
  // Section 6.1: root by equation 1, then the captured joint angles.
  CopyJointAngles(egocentric.rotation_ls, egocentric.rotation_ws,
                  avatar.standing_root_height * egocentric.root, avatar.skeleton, pose);
  PlaceBody(avatar, constants, pose, posed);
  ReadLimbs();
  MeasureCapsuleReach(*this);
  for (const Limb l : kLimbs) joint_target[Index(l)] = MakeJointTargets(*this, l);
  for (const Limb leg : {Limb::kLeftLeg, Limb::kRightLeg}) {
    standing_place[IsLeft(leg) ? 0 : 1] =
        StandingPlace(avatar, constants, leg, egocentric.rotation_ws[Index(JointsOf(leg).end)],
                      egocentric.rotation_ws[0]);
  }
  for (const Limb l : kLimbs) {
    extremity_ws[Index(l)] = posed.pose.Rotation(JointsOf(l).end);
    const PointCoordinates& mid = egocentric.point[Index(MidPoint(l))];
    double end = egocentric.point[Index(EndPoint(l))].priority;
    if (IsArm(l) && egocentric.form.hand_points) {
      end = std::max({end, egocentric.point[Index(PalmPoint(l))].priority,
                      egocentric.point[Index(FingertipPoint(l))].priority});
    }
    const double softness = IsArm(l) ? settings.gamma_softness / 1.78 : 0.0;
    const double a = Priority(mid.priority, softness);
    const double b = Priority(end, softness);
    gamma[Index(l)] = a + b > 0.0 ? a / (a + b) : 0.5;
  }
}

void AdaptState::ReadLimbs() {
  for (const Limb l : kLimbs) {
    const LimbJoints joints = JointsOf(l);
    const LimbPosture captured{pose.rotation_ls[Index(joints.base)],
                               pose.rotation_ls[Index(joints.mid)]};
    limb[Index(l)] = captured;
    chain[Index(l)] =
        MakeChain(avatar.skeleton, l, posed.pose.Position(joints.base),
                  posed.pose.Rotation(Parent(joints.base)), captured,
                  IsArm(l) ? settings.arm_reach_softness : settings.leg_reach_softness);
    const double gap = 1.0 / egocentric.point[Index(MidPoint(l))].priority;
    const double half = settings.swivel_gap / 1.78;
    chain[Index(l)].swivel_share = half / (half + gap);
  }
}

void AdaptState::MoveRoot(const Vec3& by) {
  pose.root_ws += by;
  MovePosedBody(by, posed);
  for (LimbChain& c : chain) c.base_ws += by;
}

void AdaptState::Apply(Limb l, const LimbPosture& posture) {
  const LimbJoints joints = JointsOf(l);
  limb[Index(l)] = posture;
  const LimbPlacement placed = Place(chain[Index(l)], posture);
  ModelPose& model = posed.pose;
  model.rotation_ws[Index(joints.base)] = placed.base_ws;
  model.rotation_ws[Index(joints.mid)] = placed.mid_ws;
  model.position_ws[Index(joints.mid)] = placed.mid;
  model.position_ws[Index(joints.end)] = placed.end;
  if (avatar.skeleton.locked[Index(joints.end)]) {
    extremity_ws[Index(l)] = placed.mid_ws;
  } else if (!settings.hands_keep_direction) {
    extremity_ws[Index(l)] = placed.mid_ws * pose.rotation_ls[Index(joints.end)];
  }
  model.rotation_ws[Index(joints.end)] = extremity_ws[Index(l)];
  PlaceLimb(avatar, constants, l, posed);
}

void AdaptState::TurnExtremity(Limb l, const Quat& rotation_ws) {
  const HumanoidJoint joint = JointsOf(l).end;
  if (avatar.skeleton.locked[Index(joint)]) return;
  extremity_ws[Index(l)] = rotation_ws;
  posed.pose.rotation_ws[Index(joint)] = rotation_ws;
  if (IsArm(l)) PlaceHand(avatar, constants, l, posed);
}

}  // namespace ego
