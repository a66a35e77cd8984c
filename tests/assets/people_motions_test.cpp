// SPDX-License-Identifier: MIT
#include "assets/people/motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/skeleton/pose.h"
#include "tests/support/skin_oracle.h"

namespace ego {
namespace {

using J = HumanoidJoint;

using test::Skin;

/// The skinned performer in one pose.
Skin SkinOf(const Pose& pose) { return test::SkinOf(ScriptedPerformer().character, pose); }

/// 1: of the left forearm or hand, 2: of the right, 0: elsewhere.
std::size_t ArmOf(const Skin& skin, std::size_t vertex) {
  const auto share = [&](J joint) { return skin.share[vertex][Index(joint)]; };
  if (share(J::kLeftHand) + share(J::kLeftLowerArm) > 0.02) return 1;
  return share(J::kRightHand) + share(J::kRightLowerArm) > 0.02 ? 2 : 0;
}

/// Distance from a point to the skin apart from one arm's own.
double DistanceToSkin(const Vec3& p, const Skin& skin, std::size_t without) {
  double best = 1e9;
  for (const auto& t : skin.triangles) {
    const Vec3& a = skin.position[t[0]];
    if (glm::distance(p, a) > best + 0.1) continue;
    if (ArmOf(skin, t[0]) == without || ArmOf(skin, t[1]) == without ||
        ArmOf(skin, t[2]) == without) {
      continue;
    }
    best = std::min(best, test::DistanceToTriangle(p, a, skin.position[t[1]], skin.position[t[2]]));
  }
  return best;
}

CapturedMotion Motion(std::string_view name) {
  Result<CapturedMotion> motion = ScriptedMotion(name);
  EXPECT_TRUE(motion) << motion.error();
  return *std::move(motion);
}

struct Contact {
  const char* motion;
  double from_s;
  double to_s;
  bool left;
  bool right;
  bool fingertip;
};
/// When hands are known to touch.
constexpr std::array<Contact, 7> kContacts = {{{"hands-on-belly", 1.5, 2.8, true, true, false},
                                               {"arms-crossed", 1.55, 2.95, true, true, false},
                                               {"hand-on-shoulder", 1.05, 2.15, false, true, false},
                                               {"hands-on-hips", 1.05, 2.35, true, true, false},
                                               {"salute", 0.75, 1.85, false, true, true},
                                               {"hands-on-knees", 1.55, 2.75, true, true, false},
                                               {"hand-to-ankle", 1.8, 2.8, true, true, false}}};

TEST(ScriptedMotions, HandsThatShouldTouchDo) {
  const Body& body = ScriptedPerformer().body;
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  for (const Contact& contact : kContacts) {
    const CapturedMotion motion = Motion(contact.motion);
    double worst = 0.0;
    for (double time = contact.from_s; time <= contact.to_s; time += 0.3) {
      const Pose& pose = motion.poses[static_cast<std::size_t>(time * motion.rate_hz)];
      const ModelPose model = ForwardKinematics(body.skeleton, pose);
      const Skin skin = SkinOf(pose);
      for (std::size_t side = 0; side < 2; ++side) {
        if (!(side == 0 ? contact.left : contact.right)) continue;
        const HandSurface& hand = body.surface.hand[side];
        const Vec3 point = PosePoint(canonical, model, side == 0 ? J::kLeftHand : J::kRightHand,
                                     contact.fingertip ? hand.fingertip_ms : hand.palm_ms);
        const double gap = DistanceToSkin(point, skin, side + 1);
        worst = std::max(worst, gap);
        EXPECT_LT(gap, 0.005) << contact.motion << " side " << side << " at " << time;
      }
    }
    std::printf("%-18s widest gap %.2f mm\n", contact.motion, 1000.0 * worst);
  }
}

TEST(ScriptedMotions, PalmsMeetInTheClap) {
  const CapturedMotion motion = Motion("clap");
  const Body& body = motion.performer;
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  int met = 0;
  for (const Pose& pose : motion.poses) {
    const ModelPose model = ForwardKinematics(body.skeleton, pose);
    const Vec3 left = PosePoint(canonical, model, J::kLeftHand, body.surface.hand[0].palm_ms);
    const Vec3 right = PosePoint(canonical, model, J::kRightHand, body.surface.hand[1].palm_ms);
    if (glm::distance(left, right) < 0.002) ++met;
  }
  EXPECT_GE(met, 12);  // four claps of at least three frames
}

TEST(ScriptedMotions, FeetStayWhereTheyStand) {
  for (const std::string_view name : ScriptedMotionNames()) {
    const CapturedMotion motion = Motion(name);
    const Body& body = motion.performer;
    const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
    std::array<std::vector<Vec3>, 2> planted;
    for (const Pose& pose : motion.poses) {
      const ModelPose model = ForwardKinematics(body.skeleton, pose);
      for (std::size_t side = 0; side < 2; ++side) {
        const J joint = side == 0 ? J::kLeftFoot : J::kRightFoot;
        const Vec3 heel = PosePoint(canonical, model, joint, body.surface.foot[side].heel_ms);
        const Vec3 ball = PosePoint(canonical, model, joint, body.surface.foot[side].ball_ms);
        EXPECT_GT(std::min(heel.y, ball.y), -0.002) << name;
        if (ball.y - body.surface.foot[side].ball_ms.y < 1e-4) planted[side].push_back(ball);
      }
    }
    for (const std::vector<Vec3>& where : planted) {
      ASSERT_GT(where.size(), 30u) << name;
      for (const Vec3& p : where) EXPECT_LT(glm::distance(p, where[0]), 0.001) << name;
    }
  }
}

TEST(ScriptedMotions, MoveWithoutJumpsAndLoop) {
  const auto largest_step = [](const Pose& a, const Pose& b) {
    double largest = 0.0;
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const double dot = std::abs(glm::dot(a.rotation_ls[j], b.rotation_ls[j]));
      largest = std::max(largest, Degrees(2.0 * std::acos(std::min(1.0, dot))));
    }
    return largest;
  };
  for (const std::string_view name : ScriptedMotionNames()) {
    const CapturedMotion motion = Motion(name);
    double largest = 0.0;
    for (std::size_t f = 1; f < motion.poses.size(); ++f) {
      const double step = largest_step(motion.poses[f - 1], motion.poses[f]);
      largest = std::max(largest, step);
      EXPECT_LT(step, 12.0) << name << " frame " << f;  // 720 degrees a second
      EXPECT_LT(glm::distance(motion.poses[f - 1].root_ws, motion.poses[f].root_ws), 0.015);
    }
    EXPECT_LT(largest_step(motion.poses.back(), motion.poses.front()), 0.5) << name;
    std::printf("%-18s largest step %.2f degrees a frame\n", std::string(name).c_str(), largest);
  }
}

TEST(ScriptedMotions, TheDemoLoopsAndLastsAboutHalfAMinute) {
  const CapturedMotion demo = DemoMotion();
  const double seconds = static_cast<double>(demo.poses.size()) / demo.rate_hz;
  EXPECT_GE(seconds, 30.0);
  EXPECT_LE(seconds, 40.0);
  const Pose& first = demo.poses.front();
  const Pose& last = demo.poses.back();
  EXPECT_LT(glm::distance(first.root_ws, last.root_ws), 0.001);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    EXPECT_GT(std::abs(glm::dot(first.rotation_ls[j], last.rotation_ls[j])), 0.99999);
  }
  ASSERT_NE(demo.markers, nullptr);
  EXPECT_EQ(demo.markers->labels.size(), 38u);
  EXPECT_EQ(demo.markers->frame_count, demo.poses.size());
  EXPECT_EQ(demo.markers->position_ws.size(), 38u * demo.poses.size());
}

TEST(ScriptedMotions, MarkersSitJustAboveTheSkin) {
  const CapturedMotion motion = Motion("hands-on-hips");
  const std::size_t frame = 100;
  const Skin skin = SkinOf(motion.poses[frame]);
  const MarkerFrame markers = motion.markers->Frame(frame);
  for (std::size_t m = 0; m < markers.position_ws.size(); ++m) {
    const double gap = DistanceToSkin(markers.position_ws[m], skin, 3);
    EXPECT_NEAR(gap, 0.007, 0.004) << motion.markers->labels[m];
  }
}

TEST(ScriptedMotions, AnUnknownNameIsRefusedInASentence) {
  const Result<CapturedMotion> motion = ScriptedMotion("somersault");
  EXPECT_FALSE(motion);
  EXPECT_NE(motion.error().find("somersault"), std::string::npos);
}

}  // namespace
}  // namespace ego
