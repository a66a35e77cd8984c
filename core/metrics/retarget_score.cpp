// SPDX-License-Identifier: MIT
#include "core/metrics/retarget_score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/metrics/arm_reach.h"
#include "core/metrics/surface_gap.h"

namespace ego {
namespace {

struct Pair {
  const MeasuredBody& performer;
  const MeasuredBody& avatar;
  const ScoreSettings& settings;
};

void ScoreContact(const Pair& pair, Limb arm, const Vec3& source, double source_thickness,
                  const Vec3& target, double target_thickness, ContactScore& score) {
  const double height = pair.performer.body->height;
  const double scale = height / 1.78;
  const double gap = SurfaceGap(pair.performer, arm, source) - source_thickness;
  if (gap > scale * pair.settings.contact_gap || gap < -scale * pair.settings.contact_depth) {
    return;
  }
  const double kept = SurfaceGap(pair.avatar, arm, target) - target_thickness;
  const double error = std::abs(kept / pair.avatar.body->height - gap / height);
  score.gap_error.Add(error);
  const bool recalled = error <= pair.settings.reached_gap;
  if (recalled) ++score.recalled;
  const Vec3& wrist = pair.avatar.pose.Position(JointsOf(arm).end);
  const double depth = BoneDepth(pair.performer, arm, source) / height * pair.avatar.body->height;
  if (!CanTouch(pair.avatar, arm, NearestPlace(pair.performer, arm, source),
                glm::distance(wrist, target), depth)) {
    return;
  }
  score.reachable_gap_error.Add(error);
  if (recalled) ++score.reachable_recalled;
}

void ScoreFoot(const Pair& pair, std::size_t side, double rate_hz, RetargetScore& score) {
  const double source_height = pair.performer.body->height;
  const double target_height = pair.avatar.body->height;
  const auto low = [side](const MeasuredBody& body) {
    return std::min(body.Heel(side).y, body.Ball(side).y);
  };
  const double height = low(pair.performer);
  if (height > source_height / 1.78 * pair.settings.stance_height || score.frames == 0) return;

  const HumanoidJoint joint = side == 0 ? HumanoidJoint::kLeftFoot : HumanoidJoint::kRightFoot;
  // The end of the foot that the performer stands on, followed over one frame.
  const bool on_heel = pair.performer.Heel(side).y < pair.performer.Ball(side).y;
  const auto speed = [&](const MeasuredBody& body, const ModelPose& last) {
    const FootSurface& foot = body.body->surface.foot[side];
    const Vec3& point = on_heel ? foot.heel_ms : foot.ball_ms;
    const Vec3 step = PosePoint(body.canonical, body.pose, joint, point) -
                      PosePoint(body.canonical, last, joint, point);
    return rate_hz * std::hypot(step.x, step.z);
  };
  const double source_speed = speed(pair.performer, score.last_performer);
  if (source_speed > source_height / 1.78 * pair.settings.stance_speed) return;
  score.foot_height_error.Add(std::abs(low(pair.avatar) / target_height - height / source_height));
  score.foot_slide.Add(std::max(
      0.0, speed(pair.avatar, score.last_avatar) / target_height - source_speed / source_height));
}

double AngleBetween(const Quat& a, const Quat& b) {
  const Quat q = glm::conjugate(a) * b;
  return 2.0 * std::atan2(std::hypot(q.x, q.y, q.z), std::abs(q.w));
}

void ScoreSteps(const ModelPose& performer, const ModelPose& avatar, RetargetScore& score) {
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const double step = AngleBetween(score.last_avatar.rotation_ws[j], avatar.rotation_ws[j]);
    const double own = AngleBetween(score.last_performer.rotation_ws[j], performer.rotation_ws[j]);
    if (step > score.largest_step) {
      score.largest_step = step;
      score.largest_step_frame = score.frames;
    }
    if (step - own > score.largest_added_step) {
      score.largest_added_step = step - own;
      score.largest_added_step_frame = score.frames;
    }
  }
}

}  // namespace

void Accumulate(const Body& performer, const Pose& performer_pose, const Body& avatar,
                const Pose& avatar_pose, double rate_hz, const ScoreSettings& settings,
                RetargetScore& score) {
  const MeasuredBody source(performer, performer_pose);
  const MeasuredBody target(avatar, avatar_pose);
  const Pair pair{source, target, settings};
  for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
    const std::size_t side = Index(arm);
    const HumanoidJoint hand = JointsOf(arm).end;
    ScoreContact(pair, arm, source.pose.Position(hand), performer.surface.hand[side].half_thickness,
                 target.pose.Position(hand), avatar.surface.hand[side].half_thickness, score.wrist);
    ScoreContact(pair, arm, source.Palm(side), 0.0, target.Palm(side), 0.0, score.palm);
    ScoreContact(pair, arm, source.Fingertip(side), 0.0, target.Fingertip(side), 0.0,
                 score.fingertip);
    score.arm_penetration.Add(std::max(
        0.0, ArmDepth(target, arm) / avatar.height - ArmDepth(source, arm) / performer.height));
    ScoreFoot(pair, side, rate_hz, score);
  }
  if (score.frames > 0) ScoreSteps(source.pose, target.pose, score);
  score.last_performer = source.pose;
  score.last_avatar = target.pose;
  ++score.frames;
}

}  // namespace ego
