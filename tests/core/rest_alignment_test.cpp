// SPDX-License-Identifier: MIT
#include "core/skeleton/rest_alignment.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace ego {
namespace {

using J = HumanoidJoint;

/// A skeleton whose bones lie along the canonical axes.
Skeleton Person() {
  Skeleton s;
  const auto set = [&](J j, Vec3 v) { s.offset[Index(j)] = v; };
  set(J::kHips, {0, .9, 0});
  set(J::kSpine, {0, .12, 0});
  set(J::kChest, {0, .12, -.02});
  set(J::kUpperChest, {0, .14, 0});
  set(J::kNeck, {0, .16, .02});
  set(J::kHead, {0, .1, .02});
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](J left) { return side > 0.0 ? left : Mirror(left); };
    set(of(J::kLeftShoulder), {.04 * side, .1, 0});
    set(of(J::kLeftUpperArm), {.14 * side, 0, 0});
    set(of(J::kLeftLowerArm), {.28 * side, 0, 0});
    set(of(J::kLeftHand), {.25 * side, 0, 0});
    set(of(J::kLeftUpperLeg), {.09 * side, -.03, 0});
    set(of(J::kLeftLowerLeg), {0, -.42, 0});
    set(of(J::kLeftFoot), {0, -.4, 0});
    set(of(J::kLeftToes), {0, -.05, .14});
  }
  return s;
}

struct RestRig {
  JointTree tree;
  std::vector<Mat4> global;
  std::vector<Quat> rotation;
  std::vector<Vec3> position;
};

/// A rig that rests in `pose`, its nodes turned by odd axes of their own, then moved as a whole.
RestRig Resting(const Skeleton& skeleton, const Pose& pose, const Quat& file = kIdentity,
                double unit = 1.0) {
  const ModelPose model = ForwardKinematics(skeleton, pose);
  RestRig rig;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto n = static_cast<double>(j);
    const Quat odd = glm::angleAxis(0.3 * n, glm::normalize(Vec3(1.0, n, 2.0)));
    rig.rotation.push_back(file * model.rotation_ws[j] * odd);
    rig.position.push_back(unit * (file * model.position_ws[j]));
    Mat4 m = glm::mat4_cast(rig.rotation.back());
    m[3] = Vec4(rig.position.back(), 1.0);
    rig.global.push_back(m);
    const int parent = j == 0 ? -1 : static_cast<int>(Index(kParent[j]));
    rig.tree.joints.push_back(
        {std::string(Name(static_cast<J>(j))), parent,
         parent < 0 ? m : glm::inverse(rig.global[static_cast<std::size_t>(parent)]) * m});
  }
  return rig;
}

HumanoidMap Direct() {
  HumanoidMap map;
  for (std::size_t j = 0; j < kJointCount; ++j) map.joint[j].node = static_cast<int>(j);
  return map;
}

/// A-pose: arms 45 degrees down, elbows 40 degrees bent forward, legs astride.
Pose APose(const Skeleton& skeleton) {
  Pose pose = CanonicalPose(skeleton);
  const auto turn = [&](J j, double degrees, const Vec3& axis) {
    pose.rotation_ls[Index(j)] = glm::angleAxis(Radians(degrees), axis);
  };
  turn(J::kLeftUpperArm, -45.0, {0, 0, 1});
  turn(J::kRightUpperArm, 45.0, {0, 0, 1});
  turn(J::kLeftLowerArm, 40.0, FlexionAxis(Limb::kLeftArm));
  turn(J::kRightLowerArm, 40.0, FlexionAxis(Limb::kRightArm));
  turn(J::kLeftUpperLeg, 12.0, {0, 0, 1});
  turn(J::kRightUpperLeg, -12.0, {0, 0, 1});
  turn(J::kLeftFoot, -12.0, {0, 0, 1});
  turn(J::kRightFoot, 12.0, {0, 0, 1});
  return pose;
}

TEST(AlignRestPose, APoseWithBentElbowsBecomesTheSameTPose) {
  const Skeleton person = Person();
  const Pose rest = APose(person);
  const Quat lying = glm::angleAxis(Radians(90.0), Vec3(1, 0, 0));
  const Quat back = glm::angleAxis(Radians(180.0), Vec3(0, 1, 0));
  for (const auto& [file, unit] : {std::pair{kIdentity, 1.0}, {lying, 100.0}, {back, 0.01}}) {
    const RestRig rig = Resting(person, rest, file, unit);
    const auto aligned = AlignRestPose(rig.tree, rig.global, Direct(), 1.0 / unit);
    ASSERT_TRUE(aligned) << aligned.error();
    for (std::size_t j = 1; j < kJointCount; ++j) {
      EXPECT_LT(glm::length(aligned->skeleton.offset[j] - person.offset[j]), 1e-9)
          << Name(static_cast<J>(j));
    }
    // The rest pose in canonical terms is the pose that made it, twist included.
    const Pose seen = PoseFromNodes(*aligned, Direct(), rig.rotation, rig.rotation, rig.position);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_GT(std::abs(glm::dot(seen.rotation_ls[j], rest.rotation_ls[j])), 1.0 - 1e-9)
          << Name(static_cast<J>(j));
    }
  }
}

TEST(AlignRestPose, MotionInFileTermsPlaysOnTheAlignedSkeleton) {
  const Skeleton person = Person();
  const RestRig rig = Resting(person, APose(person));
  const auto aligned = AlignRestPose(rig.tree, rig.global, Direct());
  ASSERT_TRUE(aligned) << aligned.error();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    Pose pose = CanonicalPose(person);
    for (Quat& q : pose.rotation_ls) {
      q = glm::normalize(Quat(1.5, unit(random), unit(random), unit(random)));
    }
    const ModelPose wanted = ForwardKinematics(person, pose);
    const RestRig moved = Resting(person, pose);
    const Pose seen =
        PoseFromNodes(*aligned, Direct(), rig.rotation, moved.rotation, moved.position);
    const ModelPose got = ForwardKinematics(aligned->skeleton, seen);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_LT(glm::length(got.position_ws[j] - wanted.position_ws[j]), 1e-9);
    }
  }
}

TEST(AlignRestPose, ChangesLittleWhenTheRestPoseChangesLittle) {
  const Skeleton person = Person();
  Alignment last;
  for (int step = 0; step <= 900; ++step) {
    // The arm from straight down to overhead, the elbow bending through straight and back.
    Pose rest = CanonicalPose(person);
    const double t = step / 900.0;
    rest.rotation_ls[Index(J::kLeftUpperArm)] =
        glm::angleAxis(Radians(-85.0 + 160.0 * t), Vec3(0, 0, 1));
    rest.rotation_ls[Index(J::kLeftLowerArm)] =
        glm::angleAxis(Radians(-30.0 + 90.0 * t), FlexionAxis(Limb::kLeftArm));
    rest.rotation_ls[Index(J::kLeftUpperLeg)] = glm::angleAxis(Radians(-30.0 * t), Vec3(1, 0, 0));
    const RestRig rig = Resting(person, rest);
    const auto aligned = AlignRestPose(rig.tree, rig.global, Direct());
    ASSERT_TRUE(aligned) << aligned.error();
    for (std::size_t j = 0; j < kJointCount && step > 0; ++j) {
      const Quat expected = aligned->to_canonical[j] * glm::conjugate(last.to_canonical[j]);
      EXPECT_GT(std::abs(expected.w), std::cos(Radians(2.0))) << Name(static_cast<J>(j)) << step;
    }
    last = *aligned;
  }
}

TEST(AlignRestPose, MissingJointsAreZeroLengthOrLocked) {
  const Skeleton person = Person();
  const RestRig rig = Resting(person, CanonicalPose(person));
  HumanoidMap map = Direct();
  for (const J j : {J::kNeck, J::kLeftShoulder, J::kChest, J::kLeftToes, J::kRightHand}) {
    map.joint[Index(j)].node = -1;
  }
  const auto aligned = AlignRestPose(rig.tree, rig.global, map);
  ASSERT_TRUE(aligned) << aligned.error();
  const Skeleton& s = aligned->skeleton;
  EXPECT_EQ(BoneLength(s, J::kHead), 0.0);          // the neck sits at the head
  EXPECT_EQ(BoneLength(s, J::kLeftUpperArm), 0.0);  // the clavicle at the upper arm
  EXPECT_EQ(BoneLength(s, J::kChest), 0.0);         // at the spine below it
  EXPECT_EQ(BoneLength(s, J::kLeftToes), 0.0);
  EXPECT_FALSE(s.locked[Index(J::kNeck)] || s.locked[Index(J::kLeftShoulder)]);
  EXPECT_TRUE(s.locked[Index(J::kChest)] && s.locked[Index(J::kLeftToes)]);
  EXPECT_TRUE(s.locked[Index(J::kRightHand)]);
  EXPECT_NEAR(BoneLength(s, J::kRightHand), 0.25, 1e-9);  // where the joint below the elbow is
}

TEST(AlignRestPose, RefusesAPoseWithoutShape) {
  RestRig rig = Resting(Person(), CanonicalPose(Person()));
  for (Mat4& m : rig.global) m = Mat4(1.0);
  EXPECT_FALSE(AlignRestPose(rig.tree, rig.global, Direct()));
  rig = Resting(Person(), CanonicalPose(Person()));
  rig.global[5][3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(AlignRestPose(rig.tree, rig.global, Direct()));
}

}  // namespace
}  // namespace ego
