// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/baselines/retarget_method.h"
#include "core/egocentric/normalize.h"
#include "tests/core/allocation_counter.h"
#include "tests/support/bodies.h"
#include "tests/support/studio_motions.h"

namespace ego::test {

namespace {

/// Largest distance of any joint between two poses, metres.
double JointError(const Body& body, const Pose& a, const Pose& b) {
  const ModelPose ma = ForwardKinematics(body.skeleton, a);
  const ModelPose mb = ForwardKinematics(body.skeleton, b);
  double worst = 0.0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    worst = std::max(worst, glm::distance(ma.position_ws[j], mb.position_ws[j]));
  }
  return worst;
}

double RotationError(const Pose& a, const Pose& b) {
  double worst = 0.0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Quat q = glm::conjugate(a.rotation_ls[j]) * b.rotation_ls[j];
    worst = std::max(worst, 2.0 * std::atan2(std::hypot(q.x, q.y, q.z), std::abs(q.w)));
  }
  return worst;
}

class Laws : public testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<RetargetMethod> method_ = MakeRetargetMethod(GetParam());
  Pose Map(const Body& performer, const Pose& pose, const Body& avatar) {
    method_->SetPerformerPose(performer, pose);
    Pose out;
    method_->Adapt(avatar, out);
    return out;
  }
};

TEST_P(Laws, IdentityOnEveryBody) {
  std::vector<Body> bodies = StudyBodies();
  bodies.push_back(StudioPerformer());
  bodies.push_back(TemplateBody());
  bodies.push_back(PoorRig());
  for (const Body& body : bodies) {
    for (const auto& [name, pose] : StudioPostures()) {
      const Pose own = PoseOn(body, pose);
      const Pose out = Map(body, own, body);
      EXPECT_LT(JointError(body, own, out) / body.height, 1e-6) << body.name << ": " << name;
    }
  }
}

TEST_P(Laws, UniformScaleKeepsJointAngles) {
  const Body& body = StudioPerformer();
  for (const double factor : {0.3, 0.67, 1.5}) {
    const Body scaled = Scaled(body, factor);
    for (const auto& [name, pose] : StudioPostures()) {
      const Pose out = Map(body, pose, scaled);
      EXPECT_LT(RotationError(pose, out), 1e-5) << name;
      EXPECT_LT(glm::distance(out.root_ws, factor * pose.root_ws), 1e-9 * scaled.height) << name;
    }
  }
}

TEST_P(Laws, NothingBeforeMatters) {
  const Body& performer = StudioPerformer();
  const std::vector<Body>& avatars = StudyBodies();
  const std::vector<StudioPosture>& postures = StudioPostures();
  std::vector<std::vector<Pose>> first(postures.size());
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (const Body& avatar : avatars) first[i].push_back(Map(performer, postures[i].pose, avatar));
  }
  method_ = MakeRetargetMethod(GetParam());  // a fresh one, other order
  for (std::size_t i = postures.size(); i-- > 0;) {
    for (std::size_t a = avatars.size(); a-- > 0;) {
      const Pose again = Map(performer, postures[i].pose, avatars[a]);
      EXPECT_EQ(again.root_ws, first[i][a].root_ws);
      EXPECT_EQ(again.rotation_ls, first[i][a].rotation_ls);
    }
  }
}

TEST_P(Laws, MirroredInputGivesMirroredOutput) {
  // One limb after the other, as the text has it, cannot be symmetric.
  if (GetParam() == "paper") GTEST_SKIP() << "sequential limbs are not symmetric";
  // Bodies, too: as they are measured they are not symmetric to the last digit.
  const Body& performer = StudioPerformer();
  const Body mirrored_performer = Mirrored(performer);
  for (const Body& avatar : StudyBodies()) {
    const Body mirrored_avatar = Mirrored(avatar);
    for (const auto& [name, pose] : StudioPostures()) {
      const Pose there = Mirrored(Map(performer, pose, avatar));
      const Pose here = Map(mirrored_performer, Mirrored(pose), mirrored_avatar);
      EXPECT_LT(JointError(mirrored_avatar, here, there) / avatar.height, 1e-6)
          << avatar.name << ": " << name;
    }
  }
}

TEST_P(Laws, TurningAndShiftingTheInputTurnsAndShiftsTheOutput) {
  const Body& performer = StudioPerformer();
  const Quat yaw = glm::angleAxis(2.1, kUp);
  const Vec3 shift{3.0, 0.0, -7.0};
  for (const Body& avatar : StudyBodies()) {
    const double scale = avatar.standing_root_height / performer.standing_root_height;
    for (const auto& [name, pose] : StudioPostures()) {
      Pose moved = pose;
      moved.root_ws = yaw * pose.root_ws + shift;
      moved.rotation_ls[0] = yaw * pose.rotation_ls[0];
      Pose expected = Map(performer, pose, avatar);
      expected.root_ws = yaw * expected.root_ws + scale * shift;
      expected.rotation_ls[0] = yaw * expected.rotation_ls[0];
      EXPECT_LT(JointError(avatar, Map(performer, moved, avatar), expected) / avatar.height, 1e-6)
          << avatar.name << ": " << name;
    }
  }
}

TEST_P(Laws, PoorRigsAreServed) {
  const Body& performer = StudioPerformer();
  const Body avatar = PoorRig();
  for (const auto& [name, pose] : StudioPostures()) {
    const Pose out = Map(performer, pose, avatar);
    const ModelPose posed = ForwardKinematics(avatar.skeleton, out);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Quat& q = out.rotation_ls[j];
      EXPECT_NEAR(glm::length(q), 1.0, 1e-9) << name << " joint " << j;
      if (avatar.skeleton.locked[j]) {
        EXPECT_EQ(q, kIdentity) << name << " joint " << j;
      }
      EXPECT_TRUE(std::isfinite(posed.position_ws[j].x + posed.position_ws[j].y)) << name;
    }
    // The chest faces where the performer's does, though it has one joint for three.
    const ModelPose source = ForwardKinematics(performer.skeleton, pose);
    const Vec3 facing = posed.Rotation(HumanoidJoint::kUpperChest) * Vec3{0.0, 0.0, 1.0};
    const Vec3 wanted = source.Rotation(HumanoidJoint::kUpperChest) * Vec3{0.0, 0.0, 1.0};
    EXPECT_GT(glm::dot(facing, wanted), std::cos(Radians(25.0))) << name;
  }
}

TEST_P(Laws, SmallNoiseHasBoundedGain) {
  const Body& performer = StudioPerformer();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double sigma = Radians(0.01);
  std::vector<double> gains;
  for (const auto& [name, pose] : StudioPostures()) {
    for (int trial = 0; trial < 4; ++trial) {
      Pose noisy = pose;
      for (Quat& q : noisy.rotation_ls) {
        const Vec3 r = sigma * Vec3{normal(random), normal(random), normal(random)};
        q = glm::normalize(Quat(1.0, 0.5 * r.x, 0.5 * r.y, 0.5 * r.z) * q);
      }
      const double in = JointError(performer, pose, noisy) / performer.height;
      for (const Body& avatar : StudyBodies()) {
        const double out =
            JointError(avatar, Map(performer, pose, avatar), Map(performer, noisy, avatar)) /
            avatar.height;
        gains.push_back(out / in);
      }
    }
  }
  std::sort(gains.begin(), gains.end());
  RecordProperty("gain_p50", std::to_string(gains[gains.size() / 2]));
  RecordProperty("gain_max", std::to_string(gains.back()));
  EXPECT_LT(gains[gains.size() / 2], 2.0);
  EXPECT_LT(gains[gains.size() * 95 / 100], 4.0);
  EXPECT_LT(gains.back(), 10.0);
}

TEST_P(Laws, TheFrameLoopDoesNotAllocate) {
  const Body& performer = StudioPerformer();
  const Body& avatar = StudioBody("Child");
  const Pose pose = Posture("arms_crossed");
  Pose out;
  method_->SetPerformerPose(performer, pose);  // static tables are made once
  method_->Adapt(avatar, out);
  const long before = AllocationCount();
  method_->SetPerformerPose(performer, pose);
  method_->Adapt(avatar, out);
  EXPECT_EQ(AllocationCount(), before);
  auto probe = std::make_unique<int>(1);  // the counter counts
  EXPECT_GT(AllocationCount(), before);
}

/// Standing is standing on any body: feet under its own hips, legs straight.
TEST(RetargetMethod, TheCanonicalPoseIsTheCanonicalPoseOfEveryBody) {
  const auto method = MakeRetargetMethod("mdb");
  const Body& performer = StudioPerformer();
  std::vector<Body> avatars = StudyBodies();
  avatars.push_back(Stubby());
  for (const Body& avatar : avatars) {
    method->SetPerformerPose(performer, CanonicalPose(performer.skeleton));
    Pose out;
    method->Adapt(avatar, out);
    const ModelPose posed = ForwardKinematics(avatar.skeleton, out);
    const ModelPose rest = ForwardKinematics(avatar.skeleton, CanonicalPose(avatar.skeleton));
    for (const HumanoidJoint joint : {HumanoidJoint::kHips, HumanoidJoint::kLeftFoot,
                                      HumanoidJoint::kRightFoot, HumanoidJoint::kLeftLowerLeg}) {
      EXPECT_LT(glm::distance(posed.Position(joint), rest.Position(joint)) / avatar.height, 0.005)
          << avatar.name << ": " << Name(joint);
    }
  }
}

/// From frame to frame an avatar turns its joints hardly faster than the performer.
TEST(RetargetMethod, MotionsOfOddBodiesDoNotJump) {
  const auto method = MakeRetargetMethod("mdb");
  const Body& performer = StudioPerformer();
  const Body avatar = Stubby();
  for (const auto& [name, motion, touches] : StudioMotions()) {
    ModelPose last_performer;
    ModelPose last_avatar;
    double added = 0.0;
    for (std::size_t f = 0; f < motion.size(); ++f) {
      method->SetPerformerPose(performer, motion[f]);
      Pose out;
      method->Adapt(avatar, out);
      const ModelPose source = ForwardKinematics(performer.skeleton, motion[f]);
      const ModelPose target = ForwardKinematics(avatar.skeleton, out);
      for (std::size_t j = 0; f > 0 && j < kJointCount; ++j) {
        const auto angle = [j](const ModelPose& a, const ModelPose& b) {
          const Quat q = glm::conjugate(a.rotation_ws[j]) * b.rotation_ws[j];
          return 2.0 * std::atan2(std::hypot(q.x, q.y, q.z), std::abs(q.w));
        };
        added = std::max(added, angle(last_avatar, target) - angle(last_performer, source));
      }
      last_performer = source;
      last_avatar = target;
    }
    RecordProperty(name, std::to_string(Degrees(added)));
    // Known: 13 where its arms are far too short for both touches that they go between.
    EXPECT_LT(Degrees(added), name == "thoughtful" ? 15.0 : 10.0) << name;
  }
}

TEST(Normalize, ImportancesSumToOne) {
  const Body& performer = StudioPerformer();
  for (const NormalizeSettings& settings : {NormalizeSettings{}, NormalizeSettings::Paper()}) {
    for (const auto& [name, pose] : StudioPostures()) {
      auto egocentric = std::make_unique<EgocentricPose>();
      Normalize(performer, pose, settings, *egocentric);
      const std::size_t points = settings.form.hand_points ? kLimbPointCount : kLimbJointCount;
      for (std::size_t j = 0; j < points; ++j) {
        const PointCoordinates& point = egocentric->point[j];
        const auto limb_point = static_cast<LimbPoint>(j);
        const MeshCoordinates& mesh = egocentric->mesh[GroupOf(limb_point)];
        const std::size_t lane = LaneOf(limb_point);
        const double of_meshes = mesh.trunk.importance[lane] + mesh.head.importance[lane];
        double sum = point.hand.importance + point.ground.importance + of_meshes;
        double samples = 0.0;
        for (const Quad& weight : mesh.sample) {
          EXPECT_GE(weight[lane], 0.0);
          samples += weight[lane];
        }
        EXPECT_NEAR(samples, of_meshes, 1e-12);
        for (const CapsuleRelation& r : point.capsule) sum += r.importance;
        EXPECT_NEAR(sum, 1.0, 1e-12) << name << " point " << j;
      }
    }
  }
}

TEST(Normalize, LeavesNoMetre) {
  const Body& performer = StudioPerformer();
  const double factor = 0.4;
  const Body scaled = Scaled(performer, factor);
  for (const auto& [name, pose] : StudioPostures()) {
    auto a = std::make_unique<EgocentricPose>();
    auto b = std::make_unique<EgocentricPose>();
    Normalize(performer, pose, {}, *a);
    Pose smaller = pose;
    smaller.root_ws *= factor;
    Normalize(scaled, smaller, {}, *b);
    EXPECT_LT(glm::distance(a->root, b->root), 1e-12);
    for (std::size_t j = 0; j < kLimbPointCount; ++j) {
      EXPECT_NEAR(a->point[j].importance_sum / b->point[j].importance_sum, 1.0, 1e-9);
      const auto point = static_cast<LimbPoint>(j);
      const std::size_t lane = LaneOf(point);
      const MeshCoordinates& mesh = a->mesh[GroupOf(point)];
      const MeshCoordinates& other = b->mesh[GroupOf(point)];
      for (std::size_t i = 0; i < PathsFromTrunk(GroupOf(point)).length; ++i) {
        EXPECT_LT(glm::distance(mesh.trunk.along[i].At(lane), other.trunk.along[i].At(lane)), 1e-9);
      }
      for (std::size_t i = 0; i < PathsFromHead(GroupOf(point)).length; ++i) {
        EXPECT_LT(glm::distance(mesh.head.along[i].At(lane), other.head.along[i].At(lane)), 1e-9);
      }
    }
  }
}

TEST(RetargetMethod, UnknownNamesGiveNothing) {
  EXPECT_EQ(MakeRetargetMethod("akc2"), nullptr);
  for (const std::string_view name : RetargetMethodNames()) {
    ASSERT_NE(MakeRetargetMethod(name), nullptr);
    EXPECT_EQ(MakeRetargetMethod(name)->name(), name);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Laws, testing::ValuesIn(RetargetMethodNames()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace ego::test
