// SPDX-License-Identifier: MIT
#include "assets/people/posture.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

using J = HumanoidJoint;

double Mix(double a, double b, double t) { return a + t * (b - a); }

Bend Mix(const Bend& a, const Bend& b, double t) {
  return {Mix(a.pitch, b.pitch, t), Mix(a.yaw, b.yaw, t), Mix(a.roll, b.roll, t)};
}

Quat Rotation(const Bend& bend, double share) {
  return glm::angleAxis(Radians(share * bend.yaw), Vec3{0.0, 1.0, 0.0}) *
         glm::angleAxis(Radians(share * bend.pitch), Vec3{1.0, 0.0, 0.0}) *
         glm::angleAxis(Radians(-share * bend.roll), Vec3{0.0, 0.0, 1.0});
}

Quat FromColumns(const Vec3& x, const Vec3& y) {
  return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
}

Vec3 Sided(const Vec3& v, std::size_t side) { return side == 0 ? v : Vec3{-v.x, v.y, v.z}; }

/// The part of v across the unit direction n, unit; `fallback` if there is none.
Vec3 Across(const Vec3& v, const Vec3& n, const Vec3& fallback) {
  Vec3 across = v - n * glm::dot(v, n);
  if (glm::length(across) < 1e-6) across = fallback - n * glm::dot(fallback, n);
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
  const Vec3 d = glm::normalize(to);
  const Vec3 b = Across(pole, d, Vec3{0.0, 0.0, 1.0});
  const double along = (distance * distance + upper * upper - lower * lower) / (2.0 * distance);
  const Vec3 middle = along * d + std::sqrt(std::max(0.0, upper * upper - along * along)) * b;
  return {glm::normalize(middle), glm::normalize(distance * d - middle),
          glm::normalize(glm::cross(b, d))};
}

}  // namespace

PostureSolver::PostureSolver(const Body& body)
    : body_(body), canonical_(CanonicalPositions(body.skeleton)) {}

SkinPoint PostureSolver::Posed(const SkinPoint& skin, const ModelPose& pose) const {
  SkinPoint posed = skin;
  posed.position_ms = Vec3(0.0);
  posed.normal_ms = Vec3(0.0);
  const Attachment& a = skin.attachment;
  for (std::size_t k = 0; k < a.joint.size(); ++k) {
    posed.position_ms += a.weight[k] * PosePoint(canonical_, pose, a.joint[k], skin.position_ms);
    posed.normal_ms += a.weight[k] * (pose.Rotation(a.joint[k]) * skin.normal_ms);
  }
  posed.normal_ms = glm::normalize(posed.normal_ms);
  return posed;
}

PostureSolver::ArmGoal PostureSolver::GoalOf(const HandGoal& goal, std::size_t side,
                                             const ModelPose& pose) const {
  const Quat& chest = pose.Rotation(J::kUpperChest);
  const J hand = side == 0 ? J::kLeftHand : J::kRightHand;
  Vec3 target;
  Vec3 palm;
  Vec3 fingers;
  if (goal.touches) {
    const SkinPoint skin = Posed(goal.skin, pose);
    target = skin.position_ms + goal.lift * skin.normal_ms;
    palm = -skin.normal_ms;
    Vec3 carried{0.0};
    const Attachment& a = goal.skin.attachment;
    for (std::size_t k = 0; k < a.joint.size(); ++k) {
      carried += a.weight[k] * (pose.Rotation(a.joint[k]) * Sided(goal.fingers, side));
    }
    fingers = Across(carried, palm, chest * kUp);
    const double tilt = Radians(goal.tilt);
    const Vec3 raised = std::cos(tilt) * fingers - std::sin(tilt) * palm;
    palm = std::cos(tilt) * palm + std::sin(tilt) * fingers;
    fingers = raised;
  } else {
    const J shoulder = side == 0 ? J::kLeftUpperArm : J::kRightUpperArm;
    target = pose.Position(shoulder) + chest * Sided(goal.position, side);
    palm = glm::normalize(chest * Sided(goal.palm, side));
    fingers = Across(chest * Sided(goal.fingers, side), palm, chest * kUp);
  }
  const Quat rotation = FromColumns(side == 0 ? fingers : -fingers, -palm);
  const HandSurface& surface = body_.surface.hand[side];
  const Vec3& placed = goal.fingertip ? surface.fingertip_ms : surface.palm_ms;
  ArmGoal arm;
  if (goal.touches) arm.away = Posed(goal.skin, pose).normal_ms;
  arm.wrist = target - rotation * (placed - canonical_[Index(hand)]);
  arm.elbow = glm::normalize(chest * Sided(goal.elbow, side));
  // The hand seen from its own forearm, as a turn about it and a bend of the wrist: what moves
  // smoothly from one goal to the next.
  const Quat relative = glm::conjugate(FramesOf(side, arm.wrist, arm.elbow, pose).lower) * rotation;
  arm.twist = 2.0 * std::atan2(relative.x, relative.w);
  arm.twist -= 2.0 * kPi * std::round(arm.twist / (2.0 * kPi));
  arm.swing = relative * glm::angleAxis(-arm.twist, Vec3{1.0, 0.0, 0.0});
  if (arm.swing.w < 0.0) arm.swing = -arm.swing;
  return arm;
}

PostureSolver::ArmFrames PostureSolver::FramesOf(std::size_t side, const Vec3& wrist,
                                                 const Vec3& elbow, const ModelPose& pose) const {
  const LimbJoints arm = JointsOf(side == 0 ? Limb::kLeftArm : Limb::kRightArm);
  const TwoBones bones =
      Reach(pose.Position(arm.base), wrist, elbow, BoneLength(body_.skeleton, arm.mid),
            BoneLength(body_.skeleton, arm.end));
  const double out = side == 0 ? 1.0 : -1.0;
  return {FromColumns(out * bones.upper, -out * bones.axis),
          FromColumns(out * bones.lower, -out * bones.axis)};
}

void PostureSolver::PlaceArm(std::size_t side, const ArmGoal& goal, const ModelPose& model,
                             Pose& pose) const {
  const LimbJoints arm = JointsOf(side == 0 ? Limb::kLeftArm : Limb::kRightArm);
  const ArmFrames frames = FramesOf(side, goal.wrist, goal.elbow, model);
  // Half of the turn happens along the forearm, as it does with radius and ulna.
  const Quat half = glm::angleAxis(0.5 * goal.twist, Vec3{1.0, 0.0, 0.0});
  const Quat lower = frames.lower * half;
  const Quat hand = frames.lower * goal.swing * half * half;
  pose.rotation_ls[Index(arm.base)] =
      glm::conjugate(model.Rotation(Parent(arm.base))) * frames.upper;
  pose.rotation_ls[Index(arm.mid)] = glm::conjugate(frames.upper) * lower;
  pose.rotation_ls[Index(arm.end)] = glm::conjugate(lower) * hand;
}

void PostureSolver::PlaceLeg(std::size_t side, const FootGoal& goal, Pose& pose) const {
  const LimbJoints leg = JointsOf(side == 0 ? Limb::kLeftLeg : Limb::kRightLeg);
  const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
  const Quat turn = glm::angleAxis(Radians(side == 0 ? 6.0 : -6.0), kUp);
  const Quat heel = glm::angleAxis(Radians(goal.heel_up), Vec3{1.0, 0.0, 0.0});
  // The foot turns about its toes, which stay on the ground when only the heel rises.
  const Vec3 ankle = canonical_[Index(leg.end)];
  const Vec3 pivot = canonical_[Index(toes)] * Vec3{1.0, 0.0, 1.0};
  const Vec3 planted = Vec3{ankle.x, 0.0, ankle.z} + turn * (pivot - Vec3{ankle.x, 0.0, ankle.z});
  const Quat foot = turn * heel;
  const Vec3 target = planted + goal.offset + foot * (ankle - pivot);
  const ModelPose model = ForwardKinematics(body_.skeleton, pose);
  const TwoBones bones =
      Reach(model.Position(leg.base), target, turn * Vec3{0.0, 0.0, 1.0},
            BoneLength(body_.skeleton, leg.mid), BoneLength(body_.skeleton, leg.end));
  const Quat upper = FromColumns(bones.axis, -bones.upper);
  const Quat lower = FromColumns(bones.axis, -bones.lower);
  const Quat parent = model.Rotation(Parent(leg.base));
  pose.rotation_ls[Index(leg.base)] = glm::conjugate(parent) * upper;
  pose.rotation_ls[Index(leg.mid)] = glm::conjugate(upper) * lower;
  pose.rotation_ls[Index(leg.end)] = glm::conjugate(lower) * foot;
  pose.rotation_ls[Index(toes)] = goal.offset.y > 1e-9 ? kIdentity : glm::conjugate(heel);
}

Pose PostureSolver::Solve(const Posture& from, const Posture& to, double share) const {
  Pose pose = CanonicalPose(body_.skeleton);
  pose.root_ws += glm::mix(from.root, to.root, share);
  pose.rotation_ls[Index(J::kHips)] = Rotation(Mix(from.pelvis, to.pelvis, share), 1.0);
  const Bend spine = Mix(from.spine, to.spine, share);
  for (const J joint : {J::kSpine, J::kChest, J::kUpperChest}) {
    pose.rotation_ls[Index(joint)] = Rotation(spine, 1.0 / 3.0);
  }
  const Bend head = Mix(from.head, to.head, share);
  pose.rotation_ls[Index(J::kNeck)] = Rotation(head, 0.4);
  pose.rotation_ls[Index(J::kHead)] = Rotation(head, 0.6);
  for (std::size_t side = 0; side < 2; ++side) {
    const double shrug = Mix(from.shrug[side], to.shrug[side], share) * (side == 0 ? 1.0 : -1.0);
    pose.rotation_ls[Index(side == 0 ? J::kLeftShoulder : J::kRightShoulder)] =
        glm::angleAxis(Radians(shrug), Vec3{0.0, 0.0, 1.0});
    const FootGoal& a = from.foot[side];
    const FootGoal& b = to.foot[side];
    PlaceLeg(side, {glm::mix(a.offset, b.offset, share), Mix(a.heel_up, b.heel_up, share)}, pose);
  }

  const bool left_last = from.hand[0].after_other || to.hand[0].after_other;
  for (const std::size_t side :
       {left_last ? std::size_t{1} : std::size_t{0}, left_last ? std::size_t{0} : std::size_t{1}}) {
    const ModelPose model = ForwardKinematics(body_.skeleton, pose);
    const ArmGoal a = GoalOf(from.hand[side], side, model);
    const ArmGoal b = GoalOf(to.hand[side], side, model);
    ArmGoal goal;
    goal.wrist = glm::mix(a.wrist, b.wrist, share);
    // Around the body, and off the skin before moving along it.
    const double middle = 4.0 * share * (1.0 - share);
    const double distance = glm::distance(a.wrist, b.wrist);
    const Vec3 out = Across(goal.wrist - model.Position(J::kChest), model.Rotation(J::kChest) * kUp,
                            Vec3{0.0, 0.0, 1.0});
    goal.wrist += middle * distance * (0.2 * out + 0.3 * glm::mix(a.away, b.away, share));
    goal.elbow = glm::mix(a.elbow, b.elbow, share);
    goal.twist = Mix(a.twist, b.twist, share);
    goal.swing = glm::slerp(a.swing, b.swing, share);
    PlaceArm(side, goal, model, pose);
  }
  for (Quat& q : pose.rotation_ls) {
    q = glm::normalize(q);
    if (q.w < 0.0) q = -q;
  }
  return pose;
}

FigureSurface SurfaceOf(const Character& character) {
  FigureSurface surface;
  for (const MeshPart& part : character.parts) {
    const auto base = static_cast<std::uint32_t>(surface.position_ms.size());
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      surface.position_ms.emplace_back(part.positions[v]);
      JointWeights weights{};
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        const int node = character.palette[part.influences[v].entry[k]].node;
        weights[Index(character.rig.driver[static_cast<std::size_t>(node)])] +=
            static_cast<double>(part.influences[v].weight[k]);
      }
      surface.attachment.push_back(StrongestFour(weights));
    }
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      surface.triangles.push_back(
          {base + part.triangles[t], base + part.triangles[t + 1], base + part.triangles[t + 2]});
    }
  }
  return surface;
}

}  // namespace ego
