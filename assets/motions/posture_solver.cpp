// SPDX-License-Identifier: MIT
#include "assets/motions/posture_solver.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using J = HumanoidJoint;

Quat FromColumns(const Vec3& x, const Vec3& y) {
  return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
}

/// The rotation that takes the orthonormal pair (a, b) to (c, d).
Quat PairRotation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Mat3 from(a, b, glm::cross(a, b));
  const Mat3 to(c, d, glm::cross(c, d));
  return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

Vec3 Sided(const Vec3& v, std::size_t side) { return side == 0 ? v : Vec3{-v.x, v.y, v.z}; }
J Sided(J left, std::size_t side) { return side == 0 ? left : Mirror(left); }

/// The part of v across the unit direction n, unit; `fallback` if there is none.
Vec3 Across(const Vec3& v, const Vec3& n, const Vec3& fallback) {
  Vec3 across = v - n * glm::dot(v, n);
  if (glm::length(across) < 1e-6) across = fallback - n * glm::dot(fallback, n);
  if (glm::length(across) < 1e-6)
    across = Vec3{n.y, n.z, n.x} - n * (n.x * n.y + n.y * n.z + n.z * n.x);
  return glm::normalize(across);
}

struct TwoBones {
  Vec3 upper;  // unit directions
  Vec3 lower;
  Vec3 axis;  // of flexion, unit
};

/// Bones from `start` to `end` (or as far as they reach), the middle joint on the side of `pole`.
TwoBones Reach(const Vec3& start, const Vec3& end, const Vec3& pole, double upper, double lower) {
  const Vec3 to = end - start;
  const double shortest = std::abs(upper - lower) + 0.02 * (upper + lower);
  const double distance = std::clamp(glm::length(to), shortest, 0.9995 * (upper + lower));
  const Vec3 d = glm::length(to) > 1e-9 ? glm::normalize(to) : -kUp;
  const Vec3 b = Across(pole, d, Vec3{0.0, 0.0, 1.0});
  const double along = (distance * distance + upper * upper - lower * lower) / (2.0 * distance);
  const Vec3 middle = along * d + std::sqrt(std::max(0.0, upper * upper - along * along)) * b;
  return {glm::normalize(middle), glm::normalize(distance * d - middle),
          glm::normalize(glm::cross(b, d))};
}

}  // namespace

Quat RotationOf(const Bend& bend, double share) {
  return glm::angleAxis(Radians(share * bend.yaw), Vec3{0.0, 1.0, 0.0}) *
         glm::angleAxis(Radians(share * bend.pitch), Vec3{1.0, 0.0, 0.0}) *
         glm::angleAxis(Radians(-share * bend.roll), Vec3{0.0, 0.0, 1.0});
}

Quat PostureSolver::LaidOn(const EndGoal& goal, const SkinPoint& posed, const SkinPoint& skin,
                           std::size_t side, const Vec3& canonical_pointing,
                           const ModelPose& model) const {
  Vec3 carried{0.0};
  const Attachment& a = skin.attachment;
  for (std::size_t k = 0; k < a.joint.size(); ++k) {
    carried += a.weight[k] * (model.Rotation(a.joint[k]) * Sided(goal.pointing, side));
  }
  Vec3 face = -posed.normal_ms;
  Vec3 pointing = Across(carried, face, kUp);
  const double tilt = Radians(goal.tilt);
  const Vec3 raised = std::cos(tilt) * pointing - std::sin(tilt) * face;
  face = std::cos(tilt) * face + std::sin(tilt) * pointing;
  pointing = raised;
  const Quat laid =
      PairRotation(figure_.FaceOf(goal.face, side).normal_ms, canonical_pointing, face, pointing);
  if (goal.lean == 0.0) return laid;
  const Vec3 thumb = laid * Vec3{0.0, 0.0, 1.0};
  const double sign = glm::dot(glm::cross(pointing, thumb), face) < 0.0 ? 1.0 : -1.0;
  return glm::angleAxis(sign * Radians(goal.lean), pointing) * laid;
}

ArmTarget PostureSolver::TargetOf(const EndGoal& goal, const SkinPoint& skin, std::size_t side,
                                  const ModelPose& model) const {
  const Quat& chest = model.Rotation(J::kUpperChest);
  const J hand = Sided(J::kLeftHand, side);
  const Vec3 out = Sided(Vec3{1.0, 0.0, 0.0}, side);
  ArmTarget target;
  Vec3 place;
  Quat rotation;
  if (goal.touches) {
    const SkinPoint posed = figure_.Posed(skin, model);
    place = posed.position_ms + goal.lift * posed.normal_ms;
    rotation = LaidOn(goal, posed, skin, side, out, model);
    target.away = posed.normal_ms;
  } else {
    const Quat frame = goal.on_stage ? kIdentity : chest;
    place = goal.on_stage ? Sided(figure_.leg_scale() * goal.at, side)
                          : model.Position(Sided(J::kLeftUpperArm, side)) +
                                chest * Sided(figure_.arm_scale() * goal.at, side);
    const Vec3 palm = glm::normalize(frame * Sided(goal.palm, side));
    const Vec3 fingers = Across(frame * Sided(goal.pointing, side), palm, chest * kUp);
    rotation = PairRotation(-kUp, out, palm, fingers);
  }
  const Vec3& placed =
      figure_.FaceOf(goal.touches ? goal.face : TouchFace::kPalm, side).position_ms;
  target.wrist = place - rotation * (placed - figure_.canonical()[Index(hand)]);
  if (!goal.touches) {
    const Vec3 shoulder = model.Position(Sided(J::kLeftUpperArm, side));
    target.wrist = shoulder + WithinReach(target.wrist - shoulder);
  }
  target.elbow = glm::normalize(chest * Sided(goal.pole, side));
  // The hand seen from its own forearm, as a turn about it and a bend of the wrist.
  const Quat relative =
      glm::conjugate(FramesOf(side, target.wrist, target.elbow, model).lower) * rotation;
  target.twist = 2.0 * std::atan2(relative.x, relative.w);
  target.twist -= 2.0 * kPi * std::round(target.twist / (2.0 * kPi));
  target.swing = relative * glm::angleAxis(-target.twist, Vec3{1.0, 0.0, 0.0});
  if (target.swing.w < 0.0) target.swing = -target.swing;
  return target;
}

Vec3 PostureSolver::WithinReach(const Vec3& from_shoulder) const {
  const Skeleton& skeleton = figure_.body().skeleton;
  const double arm = BoneLength(skeleton, J::kLeftLowerArm) + BoneLength(skeleton, J::kLeftHand);
  const double easy = 0.955 * arm;
  const double room = 0.993 * arm - easy;
  const double distance = glm::length(from_shoulder);
  if (distance <= easy) return from_shoulder;
  return from_shoulder / distance * (easy + room * (1.0 - std::exp(-(distance - easy) / room)));
}

LegTarget PostureSolver::FootOnSkin(const EndGoal& goal, const SkinPoint& skin, std::size_t side,
                                    const ModelPose& model) const {
  const SkinPoint posed = figure_.Posed(skin, model);
  LegTarget target;
  target.foot = LaidOn(goal, posed, skin, side, Vec3{0.0, 0.0, 1.0}, model);
  const Vec3& placed = figure_.FaceOf(goal.face, side).position_ms;
  const Vec3& ankle = figure_.canonical()[Index(Sided(J::kLeftFoot, side))];
  target.ankle = posed.position_ms + goal.lift * posed.normal_ms - target.foot * (placed - ankle);
  const Vec3 pole = Sided(goal.pole, side);
  target.knee = glm::length(pole) > 1e-6 ? glm::normalize(pole) : Vec3{0.0, 0.0, 1.0};
  return target;
}

LegTarget PostureSolver::FreeFoot(const EndGoal& goal, std::size_t side) const {
  const Quat turn = glm::angleAxis(Radians(side == 0 ? goal.turn : -goal.turn), kUp);
  const Quat pitch = glm::angleAxis(Radians(goal.heel), Vec3{1.0, 0.0, 0.0});
  const Quat roll =
      glm::angleAxis(Radians(side == 0 ? -goal.roll : goal.roll), Vec3{0.0, 0.0, 1.0});
  LegTarget target;
  target.foot = turn * pitch * roll;
  // Toes stay flat on the ground under a raised heel; in the air they follow the foot.
  const double grounded = std::clamp(1.0 - goal.at.y / 0.06, 0.0, 1.0);
  const double upright = std::clamp(1.0 - std::abs(goal.roll) / 20.0, 0.0, 1.0);
  const double bend = grounded * upright * std::clamp(goal.heel, 0.0, 60.0);
  target.toes = glm::angleAxis(Radians(-bend), Vec3{1.0, 0.0, 0.0});
  // The foot turns about its toes while the heel rises, about its heel while the toes do.
  const Vec3 ankle = figure_.canonical()[Index(Sided(J::kLeftFoot, side))];
  const Vec3 under{ankle.x, 0.0, ankle.z};
  const Vec3 toes = figure_.canonical()[Index(Sided(J::kLeftToes, side))] * Vec3{1.0, 0.0, 1.0};
  const Vec3 heel = figure_.body().surface.foot[side].heel_ms * Vec3{1.0, 0.0, 1.0};
  const Vec3& pivot = goal.heel > 0.0 ? toes : heel;
  const Vec3 at = figure_.leg_scale() * goal.at;
  target.ankle = under + turn * (pivot - under) + Sided(at, side) + target.foot * (ankle - pivot);
  target.ankle.y = at.y + figure_.AnkleHeight(side, target.foot, target.toes);
  const Vec3 pole = Sided(goal.pole, side);
  target.knee = glm::length(pole) > 1e-6 ? glm::normalize(pole) : turn * Vec3{0.0, 0.0, 1.0};
  return target;
}

PostureSolver::ArmFrames PostureSolver::FramesOf(std::size_t side, const Vec3& wrist,
                                                 const Vec3& elbow, const ModelPose& model) const {
  const LimbJoints arm = JointsOf(side == 0 ? Limb::kLeftArm : Limb::kRightArm);
  const Skeleton& skeleton = figure_.body().skeleton;
  const TwoBones bones = Reach(model.Position(arm.base), wrist, elbow,
                               BoneLength(skeleton, arm.mid), BoneLength(skeleton, arm.end));
  const double out = side == 0 ? 1.0 : -1.0;
  return {FromColumns(out * bones.upper, -out * bones.axis),
          FromColumns(out * bones.lower, -out * bones.axis)};
}

Vec3 PostureSolver::ElbowOf(std::size_t side, const Vec3& wrist, const Vec3& elbow,
                            const ModelPose& model) const {
  const LimbJoints arm = JointsOf(side == 0 ? Limb::kLeftArm : Limb::kRightArm);
  const double upper = BoneLength(figure_.body().skeleton, arm.mid);
  const TwoBones bones = Reach(model.Position(arm.base), wrist, elbow, upper,
                               BoneLength(figure_.body().skeleton, arm.end));
  return model.Position(arm.base) + upper * bones.upper;
}

void PostureSolver::PlaceArm(std::size_t side, const ArmTarget& target, const ModelPose& model,
                             Pose& pose) const {
  const LimbJoints arm = JointsOf(side == 0 ? Limb::kLeftArm : Limb::kRightArm);
  const ArmFrames frames = FramesOf(side, target.wrist, target.elbow, model);
  // Half of the turn happens along the forearm, as it does with radius and ulna.
  const Quat half = glm::angleAxis(0.5 * target.twist, Vec3{1.0, 0.0, 0.0});
  const Quat lower = frames.lower * half;
  const Quat hand = frames.lower * target.swing * half * half;
  pose.rotation_ls[Index(arm.base)] =
      glm::conjugate(model.Rotation(Parent(arm.base))) * frames.upper;
  pose.rotation_ls[Index(arm.mid)] = glm::conjugate(frames.upper) * lower;
  pose.rotation_ls[Index(arm.end)] = glm::conjugate(lower) * hand;
}

void PostureSolver::PlaceLeg(std::size_t side, const LegTarget& target, const ModelPose& model,
                             Pose& pose) const {
  const LimbJoints leg = JointsOf(side == 0 ? Limb::kLeftLeg : Limb::kRightLeg);
  const Skeleton& skeleton = figure_.body().skeleton;
  const TwoBones bones = Reach(model.Position(leg.base), target.ankle, target.knee,
                               BoneLength(skeleton, leg.mid), BoneLength(skeleton, leg.end));
  const Quat upper = FromColumns(bones.axis, -bones.upper);
  const Quat lower = FromColumns(bones.axis, -bones.lower);
  pose.rotation_ls[Index(leg.base)] = glm::conjugate(model.Rotation(Parent(leg.base))) * upper;
  pose.rotation_ls[Index(leg.mid)] = glm::conjugate(upper) * lower;
  pose.rotation_ls[Index(leg.end)] = glm::conjugate(lower) * target.foot;
  pose.rotation_ls[Index(side == 0 ? J::kLeftToes : J::kRightToes)] = target.toes;
}

}  // namespace ego
