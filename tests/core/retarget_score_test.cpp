// SPDX-License-Identifier: MIT
#include "core/metrics/retarget_score.h"

#include <gtest/gtest.h>

#include "core/baselines/retarget_method.h"
#include "core/geometry/closest_point.h"
#include "core/metrics/surface_gap.h"
#include "tests/support/bodies.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

/// `stride` leaves frames out where no speeds are asked for.
RetargetScore ScoreOf(std::string_view method_name, const Body& avatar,
                      const std::vector<Pose>& poses, std::size_t stride = 1) {
  const Body& performer = StudioPerformer();
  const auto method = MakeRetargetMethod(method_name);
  RetargetScore score;
  for (std::size_t k = 0; k < poses.size(); k += stride) {
    const Pose& pose = poses[k];
    Pose out;
    method->SetPerformerPose(performer, pose);
    method->Adapt(avatar, out);
    Accumulate(performer, pose, avatar, out, kStudioRate, {}, score);
  }
  return score;
}

TEST(SurfaceGap, KnowsInsideFromOutside) {
  const Body body = TemplateBody();
  const MeasuredBody measured(body, CanonicalPose(body.skeleton));
  EXPECT_LT(TrunkDistance(measured, {0.0, 1.2, -0.02}), -0.05);
  EXPECT_GT(TrunkDistance(measured, {0.0, 1.2, 0.5}), 0.3);
  EXPECT_LT(HeadDistance(measured, {0.0, 1.66, 0.0}), -0.03);
  EXPECT_NEAR(HeadDistance(measured, {0.0, 1.98, 0.0}), 0.20, 1e-9);  // straight over the crown
  EXPECT_NEAR(SurfaceGap(measured, Limb::kLeftArm, {-0.5, 1.7, 0.0}),
              1.7 - measured.pose.Position(HumanoidJoint::kRightLowerArm).y - 0.036, 0.03);
}

TEST(RetargetScore, TheMotionItselfScoresZero) {
  const Body& performer = StudioPerformer();
  RetargetScore score;
  for (const Pose& pose : Motion("hands_clasped").poses) {
    Accumulate(performer, pose, performer, pose, kStudioRate, {}, score);
  }
  EXPECT_EQ(score.frames, Motion("hands_clasped").poses.size());
  EXPECT_GT(score.palm.gap_error.count, 60u);
  EXPECT_EQ(score.palm.gap_error.max, 0.0);
  EXPECT_EQ(score.palm.Recall(), 1.0);
  EXPECT_EQ(score.arm_penetration.max, 0.0);
  EXPECT_EQ(score.foot_slide.max, 0.0);
  EXPECT_EQ(score.largest_added_step, 0.0);
  EXPECT_GT(score.largest_step, 0.0);
}

TEST(RetargetScore, KnowsWhatAnArmIsTooShortFor) {
  const Body& performer = StudioPerformer();
  const Body stump = MakeBody("stump", {.arm_length = 0.10});
  const Pose pose = Posture("arms_crossed");
  RetargetScore own;
  Accumulate(performer, pose, performer, pose, 60.0, {}, own);
  ASSERT_GT(own.palm.gap_error.count, 0u);
  EXPECT_EQ(own.palm.reachable_gap_error.count, own.palm.gap_error.count);
  RetargetScore short_armed;
  Accumulate(performer, pose, stump, pose, 60.0, {}, short_armed);
  EXPECT_EQ(short_armed.palm.gap_error.count, own.palm.gap_error.count);
  EXPECT_EQ(short_armed.palm.reachable_gap_error.count, 0u);
  EXPECT_EQ(short_armed.palm.ReachableRecall(), 1.0);
}

TEST(RetargetScore, SeesALiftedHandAndAJump) {
  const Body& performer = StudioPerformer();
  const Pose pose = Posture("hands_clasped");
  Pose lifted = pose;
  Quat& elbow = lifted.rotation_ls[Index(HumanoidJoint::kLeftLowerArm)];
  elbow = elbow * glm::angleAxis(-0.3, FlexionAxis(Limb::kLeftArm));
  RetargetScore score;
  Accumulate(performer, pose, performer, pose, 60.0, {}, score);
  Accumulate(performer, pose, performer, lifted, 60.0, {}, score);
  EXPECT_GT(score.palm.gap_error.max, 0.01);
  EXPECT_LT(score.palm.Recall(), 1.0);
  EXPECT_NEAR(score.largest_added_step, 0.3, 1e-6);
  EXPECT_EQ(score.largest_added_step_frame, 1u);
}

// The goal of the method, against joint angles alone, on bodies of other proportions.
TEST(Contacts, AreKeptOnOtherBodies) {
  for (const Body& avatar : StudyBodies()) {
    RetargetScore kept;
    RetargetScore copied;
    for (const StudioMotion& motion : StudioMotions()) {
      const auto add = [](const RetargetScore& one, RetargetScore& all) {
        for (const auto& [from, to] :
             {std::pair{&one.palm, &all.palm}, std::pair{&one.fingertip, &all.palm}}) {
          to->gap_error.sum += from->gap_error.sum;
          to->gap_error.count += from->gap_error.count;
          to->recalled += from->recalled;
        }
      };
      add(ScoreOf("mdb", avatar, motion.poses, 12), kept);
      add(ScoreOf("copy", avatar, motion.poses, 12), copied);
    }
    RecordProperty(avatar.name + " contacts", std::to_string(kept.palm.gap_error.count));
    RecordProperty(avatar.name + " gap", std::to_string(kept.palm.gap_error.Mean()));
    RecordProperty(avatar.name + " recall", std::to_string(kept.palm.Recall()));
    RecordProperty(avatar.name + " copied gap", std::to_string(copied.palm.gap_error.Mean()));
    ASSERT_GT(kept.palm.gap_error.count, 200u);
    EXPECT_LT(kept.palm.gap_error.Mean(), 0.003) << avatar.name;
    EXPECT_GT(kept.palm.Recall(), 0.98) << avatar.name;
    EXPECT_LT(kept.palm.gap_error.Mean(), 0.25 * copied.palm.gap_error.Mean()) << avatar.name;
  }
}

TEST(Walk, GainsNoJumpsAndKeepsItsFeet) {
  for (const Body& avatar : StudyBodies()) {
    const RetargetScore score = ScoreOf("mdb", avatar, Motion("walk").poses);
    EXPECT_LT(Degrees(score.largest_added_step), 5.0) << avatar.name;
    EXPECT_LT(score.foot_height_error.Mean(), 0.003) << avatar.name;
    EXPECT_LT(score.foot_height_error.max, 0.01) << avatar.name;
    EXPECT_LT(score.foot_slide.Mean(), 0.003) << avatar.name;
  }
}

// Arms crossed: where they meet, the right forearm lies on the same side of the left one on every
// body as on the performer.
TEST(SpatialOrder, OfCrossedArmsIsKept) {
  const auto apart = [](const Body& body, const Pose& pose) {
    const ModelPose m = ForwardKinematics(body.skeleton, pose);
    const Vec3& left = m.Position(HumanoidJoint::kLeftLowerArm);
    const Vec3& left_hand = m.Position(HumanoidJoint::kLeftHand);
    const Vec3& right = m.Position(HumanoidJoint::kRightLowerArm);
    const Vec3& right_hand = m.Position(HumanoidJoint::kRightHand);
    const SegmentPair near = ClosestOnSegments(left, left_hand, right, right_hand);
    const Vec3 way = glm::mix(right, right_hand, near.t) - glm::mix(left, left_hand, near.s);
    return glm::conjugate(m.Rotation(HumanoidJoint::kUpperChest)) * way / body.height;
  };
  const Body& performer = StudioPerformer();
  const Pose& pose = Posture("arms_crossed");
  const Vec3 side = glm::normalize(apart(performer, pose));
  for (const std::string_view name : {"mdb", "paper"}) {
    const auto method = MakeRetargetMethod(name);
    method->SetPerformerPose(performer, pose);
    for (const Body& avatar : StudyBodies()) {
      Pose out;
      method->Adapt(avatar, out);
      EXPECT_GT(glm::dot(side, apart(avatar, out)), 0.02) << avatar.name << " " << name;
    }
  }
}

}  // namespace
}  // namespace ego::test
