// SPDX-License-Identifier: MIT
#include "core/pipeline/skeleton_capture.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ego {
namespace {

using J = HumanoidJoint;

/// A person who stands in a T-pose for a while and then walks on the spot, waves and bends.
std::vector<Pose> SomeMotion(const Skeleton& skeleton) {
  std::vector<Pose> poses;
  for (int f = 0; f < 120; ++f) {
    const double t = std::max(0, f - 20) / 30.0;
    Pose pose = CanonicalPose(skeleton);
    const auto turn = [&](J joint, double degrees, const Vec3& axis) {
      pose.rotation_ls[Index(joint)] =
          pose.rotation_ls[Index(joint)] * glm::angleAxis(Radians(degrees), axis);
    };
    const double swing = std::sin(3.0 * t);
    turn(J::kHips, 40.0 * t, kUp);
    turn(J::kChest, 8.0 * swing, {1, 0, 0});
    turn(J::kLeftUpperArm, -70.0 * std::min(1.0, t), {0, 0, 1});
    turn(J::kRightUpperArm, 60.0 * std::min(1.0, t), {0, 0, 1});
    turn(J::kLeftLowerArm, -30.0 - 30.0 * swing * std::min(1.0, t) + 30.0 * (t <= 0.0), {0, 1, 0});
    turn(J::kLeftHand, 12.0 * swing, {1, 0, 0});
    turn(J::kLeftUpperLeg, -40.0 * std::max(0.0, swing), {1, 0, 0});
    turn(J::kLeftLowerLeg, 60.0 * std::max(0.0, swing), {1, 0, 0});
    turn(J::kLeftFoot, -20.0 * std::max(0.0, swing), {1, 0, 0});
    turn(J::kRightFoot, -4.0 * std::abs(swing), {1, 0, 0});
    turn(J::kHead, 15.0 * swing, kUp);
    pose.root_ws += Vec3{0.3 * t, 0.0, 0.1 * t};
    poses.push_back(pose);
  }
  return poses;
}

/// The motion as a file of some program would hold it: the canonical skeleton's joints with any
/// local axes, any unit and any axes of the world.
struct FileStyle {
  double units_per_metre = 100.0;
  Quat world = kIdentity;  // stage axes to file axes
  double lift = 0.0;       // metres: the file's floor above the stage's
  bool scrambled = false;  // the zero rotation is no pose at all
};

JointMotion AsFile(const Skeleton& skeleton, const std::vector<Pose>& poses,
                   const FileStyle& style) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::array<Quat, kJointCount> axes;
  for (Quat& q : axes) {
    q = glm::conjugate(style.world);
    if (style.scrambled) {
      q = glm::normalize(Quat(normal(random), normal(random), normal(random), normal(random)));
    }
  }
  JointMotion motion;
  motion.name = "walk";
  motion.rate_hz = 60.0;
  motion.frame_count = poses.size();
  const auto local = [&](const Pose& pose, std::size_t j, Quat& rotation, Vec3& translation) {
    const std::size_t parent = Index(kParent[j]);
    if (j == 0) {
      rotation = style.world * pose.rotation_ls[0] * axes[0];
      translation = style.world * (pose.root_ws + Vec3{0.0, style.lift, 0.0});
    } else {
      rotation = glm::conjugate(axes[parent]) * pose.rotation_ls[j] * axes[j];
      translation = glm::conjugate(axes[parent]) * skeleton.offset[j];
    }
    translation *= style.units_per_metre;
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    Quat rotation;
    Vec3 translation;
    local(CanonicalPose(skeleton), j, rotation, translation);
    JointTree::Joint joint;
    joint.name = Name(static_cast<J>(j));
    joint.parent = j == 0 ? -1 : static_cast<int>(Index(kParent[j]));
    joint.rest_local[3] = Vec4(translation, 1.0);
    motion.tree.joints.push_back(joint);
  }
  for (const Pose& pose : poses) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      Quat rotation;
      Vec3 translation;
      local(pose, j, rotation, translation);
      motion.rotation_ls.push_back(rotation);
      motion.translation_ls.push_back(translation);
    }
  }
  return motion;
}

double AngleBetween(const Quat& a, const Quat& b) {
  const Quat d = glm::conjugate(a) * b;
  return 2.0 * std::atan2(glm::length(Vec3(d.x, d.y, d.z)), std::abs(d.w));
}

void ExpectCaptured(const JointMotion& file, const Skeleton& skeleton,
                    const std::vector<Pose>& poses) {
  const Result<CapturedMotion> captured = CaptureFromJointMotion(file);
  ASSERT_TRUE(captured) << captured.error();
  EXPECT_EQ(captured->name, "walk");
  EXPECT_DOUBLE_EQ(captured->rate_hz, 60.0);
  ASSERT_EQ(captured->poses.size(), poses.size());
  for (std::size_t j = 1; j < kJointCount; ++j) {
    EXPECT_LT(glm::length(captured->performer.skeleton.offset[j] - skeleton.offset[j]), 1e-6)
        << Name(static_cast<J>(j));
  }
  EXPECT_NEAR(captured->performer.standing_root_height, skeleton.offset[0].y, 2e-3);
  for (std::size_t f = 0; f < poses.size(); ++f) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_LT(AngleBetween(captured->poses[f].rotation_ls[j], poses[f].rotation_ls[j]), 1e-6)
          << "frame " << f << " " << Name(static_cast<J>(j));
    }
    // The floor is found again wherever the file had it.
    EXPECT_LT(glm::length(captured->poses[f].root_ws - poses[f].root_ws), 0.01) << "frame " << f;
  }
}

TEST(SkeletonCapture, GivesBackTheMotionInAnyUnit) {
  const Skeleton skeleton = TemplateSkeleton(1.66);
  const std::vector<Pose> poses = SomeMotion(skeleton);
  for (const double units : {1.0, 10.0, 100.0, 1000.0, 1.0 / 0.0254}) {
    ExpectCaptured(AsFile(skeleton, poses, {.units_per_metre = units}), skeleton, poses);
  }
}

TEST(SkeletonCapture, FindsTheFloor) {
  const Skeleton skeleton = TemplateSkeleton(1.66);
  const std::vector<Pose> poses = SomeMotion(skeleton);
  for (const double lift : {-0.8, 0.0, 0.045}) {
    const JointMotion file = AsFile(skeleton, poses, {.lift = lift});
    ExpectCaptured(file, skeleton, poses);
    const Result<CapturedMotion> captured = CaptureFromJointMotion(file);
    ASSERT_TRUE(captured);
    EXPECT_NEAR(captured->floor_offset, -lift, 0.01);
  }
}

TEST(SkeletonCapture, ChildrenAndGiantsKeepTheirSize) {
  for (const double height : {1.05, 1.3, 2.4}) {
    const Skeleton skeleton = TemplateSkeleton(height);
    const std::vector<Pose> poses = SomeMotion(skeleton);
    const Result<CapturedMotion> captured = CaptureFromJointMotion(AsFile(skeleton, poses, {}));
    ASSERT_TRUE(captured) << captured.error();
    EXPECT_NEAR(captured->performer.height, height, 0.02);
  }
}

TEST(SkeletonCapture, ReadsFilesWithZUp) {
  const Skeleton skeleton = TemplateSkeleton(1.8);
  const std::vector<Pose> poses = SomeMotion(skeleton);
  const Quat z_up = glm::angleAxis(0.5 * kPi, Vec3(1, 0, 0));
  ExpectCaptured(AsFile(skeleton, poses, {.world = z_up}), skeleton, poses);
}

TEST(SkeletonCapture, TakesAFrameWhereTheZeroRotationIsNoPose) {
  const Skeleton skeleton = TemplateSkeleton(1.8);
  const std::vector<Pose> poses = SomeMotion(skeleton);
  const JointMotion file = AsFile(skeleton, poses, {.scrambled = true});
  ExpectCaptured(file, skeleton, poses);
  std::vector<std::string> notes;
  ASSERT_TRUE(CaptureFromJointMotion(file, &notes));
  EXPECT_FALSE(notes.empty());
}

TEST(SkeletonCapture, BelievesPositionChannelsMoreThanOffsets) {
  const Skeleton skeleton = TemplateSkeleton(1.7);
  const std::vector<Pose> poses = SomeMotion(skeleton);
  JointMotion file = AsFile(skeleton, poses, {});
  for (JointTree::Joint& joint : file.tree.joints) joint.rest_local = Mat4{1.0};
  ExpectCaptured(file, skeleton, poses);
}

TEST(SkeletonCapture, RefusesTreesWithoutAPerson) {
  JointMotion motion;
  EXPECT_FALSE(CaptureFromJointMotion(motion));
  motion.frame_count = 1;
  motion.tree.joints = {{"wheel", -1, Mat4{1.0}}, {"spoke", 0, Mat4{1.0}}};
  motion.rotation_ls.assign(2, kIdentity);
  motion.translation_ls.assign(2, Vec3{0.0});
  const Result<CapturedMotion> captured = CaptureFromJointMotion(motion);
  ASSERT_FALSE(captured);
  EXPECT_GT(captured.error().size(), 10u);
}

}  // namespace
}  // namespace ego
