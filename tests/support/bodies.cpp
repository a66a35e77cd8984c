// SPDX-License-Identifier: MIT
#include "tests/support/bodies.h"

#include <string>

namespace ego::test {
namespace {

using J = HumanoidJoint;

void ScaleLimb(Skeleton& skeleton, Limb limb, double length) {
  const LimbJoints joints = JointsOf(limb);
  const double now = BoneLength(skeleton, joints.mid) + BoneLength(skeleton, joints.end);
  for (const J j : {joints.mid, joints.end}) skeleton.offset[Index(j)] *= length / now;
}

}  // namespace

Body MakeBody(std::string_view name, const BodyShape& shape) {
  Skeleton skeleton = TemplateSkeleton(shape.height);
  const double leg_before =
      BoneLength(skeleton, J::kLeftLowerLeg) + BoneLength(skeleton, J::kLeftFoot);
  ScaleLimb(skeleton, Limb::kLeftArm, shape.arm_length);
  ScaleLimb(skeleton, Limb::kRightArm, shape.arm_length);
  ScaleLimb(skeleton, Limb::kLeftLeg, shape.leg_length);
  ScaleLimb(skeleton, Limb::kRightLeg, shape.leg_length);
  // Longer legs lift the hips; the trunk takes up the rest of the height.
  const double lift = shape.leg_length - leg_before;
  skeleton.offset[0].y += lift;
  const double trunk = shape.height - skeleton.offset[0].y + lift;
  const double factor = (trunk - lift) / trunk;
  for (const J j : {J::kSpine, J::kChest, J::kUpperChest, J::kNeck, J::kHead}) {
    skeleton.offset[Index(j)] *= factor;
  }
  Body body = BodyFromSkeleton(std::string(name), skeleton, shape.height);
  body.surface.limb_radius = {shape.upper_arm_radius, shape.lower_arm_radius,
                              shape.upper_arm_radius, shape.lower_arm_radius,
                              shape.upper_leg_radius, shape.lower_leg_radius,
                              shape.upper_leg_radius, shape.lower_leg_radius};
  const auto bulge = [&](SamplePoint p, double share) {
    body.surface.sample_ms[Index(p)].z += share * shape.belly;
  };
  bulge(SamplePoint::kNavel, 1.0);
  bulge(SamplePoint::kLeftBellySide, 0.85);
  bulge(SamplePoint::kRightBellySide, 0.85);
  bulge(SamplePoint::kSternumBase, 0.6);
  bulge(SamplePoint::kPubis, 0.25);
  for (const auto& [side, sign] :
       {std::pair{SamplePoint::kLeftWaistSide, 1.0}, std::pair{SamplePoint::kRightWaistSide, -1.0},
        std::pair{SamplePoint::kLeftBellySide, 1.0},
        std::pair{SamplePoint::kRightBellySide, -1.0}}) {
    body.surface.sample_ms[Index(side)].x += sign * 0.3 * shape.belly;
  }
  const auto joints = CanonicalPositions(skeleton);
  for (std::size_t s = 0; s < 2; ++s) {
    HandSurface& hand = body.surface.hand[s];
    const Vec3& wrist = joints[Index(s == 0 ? J::kLeftHand : J::kRightHand)];
    hand.palm_ms = wrist + shape.hand_scale * (hand.palm_ms - wrist);
    hand.fingertip_ms = wrist + shape.hand_scale * (hand.fingertip_ms - wrist);
    hand.half_thickness *= shape.hand_scale;
  }
  return body;
}

Body PoorRig() {
  Skeleton skeleton = TemplateSkeleton(1.5);
  const auto merge = [&](J joint, std::initializer_list<J> children) {
    for (const J child : children) skeleton.offset[Index(child)] += skeleton.offset[Index(joint)];
    skeleton.offset[Index(joint)] = Vec3{0.0};
    skeleton.locked[Index(joint)] = true;
  };
  merge(J::kLeftShoulder, {J::kLeftUpperArm});
  merge(J::kRightShoulder, {J::kRightUpperArm});
  merge(J::kNeck, {J::kHead});
  merge(J::kUpperChest, {J::kNeck, J::kLeftShoulder, J::kRightShoulder});
  skeleton.offset[Index(J::kHead)] += skeleton.offset[Index(J::kNeck)];
  skeleton.offset[Index(J::kNeck)] = Vec3{0.0};
  for (const auto& [shoulder, arm] : {std::pair{J::kLeftShoulder, J::kLeftUpperArm},
                                      std::pair{J::kRightShoulder, J::kRightUpperArm}}) {
    skeleton.offset[Index(arm)] += skeleton.offset[Index(shoulder)];
    skeleton.offset[Index(shoulder)] = Vec3{0.0};
  }
  for (const J j : {J::kLeftHand, J::kRightHand, J::kLeftToes, J::kRightToes}) {
    skeleton.locked[Index(j)] = true;
  }
  for (const J j : {J::kLeftToes, J::kRightToes}) skeleton.offset[Index(j)] = Vec3{0.0};
  return BodyFromSkeleton("poor rig", skeleton, 1.5);
}

Body Stubby() {
  Body body = MakeBody("stubby", {1.40, 0.32, 0.28, 0.07, 0.06, 0.10, 0.09, 0.12, 1.6});
  for (const auto& [joint, side] : {std::pair{J::kLeftUpperLeg, std::size_t{0}},
                                    std::pair{J::kRightUpperLeg, std::size_t{1}}}) {
    const double wider = body.skeleton.offset[Index(joint)].x;
    body.skeleton.offset[Index(joint)].x += wider;
    for (Vec3* p : {&body.surface.foot[side].heel_ms, &body.surface.foot[side].ball_ms,
                    &body.surface.foot[side].toe_tip_ms}) {
      p->x += wider;
    }
  }
  return body;
}

Body Mirrored(const Body& body) {
  const auto reflect = [](const Vec3& v) { return Vec3{-v.x, v.y, v.z}; };
  const BodySurface& from = body.surface;
  Body made = body;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const std::size_t other = Index(Mirror(static_cast<J>(j)));
    made.skeleton.offset[j] = reflect(body.skeleton.offset[other]);
    made.skeleton.locked[j] = body.skeleton.locked[other];
  }
  for (std::size_t s = 0; s < kSampleCount; ++s) {
    const std::size_t other = Index(Mirror(static_cast<SamplePoint>(s)));
    made.surface.sample_ms[s] = reflect(from.sample_ms[other]);
    made.surface.attachment[s] = from.attachment[other];
    for (J& joint : made.surface.attachment[s].joint) joint = Mirror(joint);
  }
  for (const Limb limb : kLimbs) {
    for (std::size_t part = 0; part < 2; ++part) {
      made.surface.limb_radius[2 * Index(limb) + part] =
          from.limb_radius[2 * Index(Mirror(limb)) + part];
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const HandSurface& hand = from.hand[1 - side];
    made.surface.hand[side] = {reflect(hand.palm_ms), reflect(hand.palm_normal_ms),
                               reflect(hand.fingertip_ms), hand.half_thickness};
    const FootSurface& foot = from.foot[1 - side];
    made.surface.foot[side] = {reflect(foot.heel_ms), reflect(foot.ball_ms),
                               reflect(foot.toe_tip_ms), reflect(foot.sole_normal_ms)};
  }
  return made;
}

}  // namespace ego::test
