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

namespace ego {
namespace {

using J = HumanoidJoint;

/// The skinned performer in one pose.
struct Skinned {
  std::vector<Vec3> position;
  std::vector<std::size_t> hand;  // of each vertex: 1 left hand, 2 right hand, 0 elsewhere
};

Skinned SkinOf(const Pose& pose) {
  const Character& character = ScriptedPerformer().character;
  const ModelPose model = ForwardKinematics(character.rig.skeleton, pose);
  std::vector<Mat4> nodes(character.nodes.joints.size());
  PoseNodes(character.rig, model, nodes);
  Skinned skinned;
  for (const MeshPart& part : character.parts) {
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      Vec3 p{0.0};
      double left = 0.0;
      double right = 0.0;
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        const double w = static_cast<double>(part.influences[v].weight[k]);
        if (w == 0.0) continue;
        const PaletteEntry& entry = character.palette[part.influences[v].entry[k]];
        p += w * Vec3(nodes[static_cast<std::size_t>(entry.node)] * entry.inverse_bind *
                      Vec4(Vec3(part.positions[v]), 1.0));
        if (entry.node == static_cast<int>(Index(J::kLeftHand)) ||
            entry.node == static_cast<int>(Index(J::kLeftLowerArm))) {
          left += w;
        }
        if (entry.node == static_cast<int>(Index(J::kRightHand)) ||
            entry.node == static_cast<int>(Index(J::kRightLowerArm))) {
          right += w;
        }
      }
      skinned.position.push_back(p);
      skinned.hand.push_back(left > 0.02 ? 1 : right > 0.02 ? 2 : 0);
    }
  }
  return skinned;
}

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_segment = [&](const Vec3& s, const Vec3& e) {
    const double t = std::clamp(glm::dot(p - s, e - s) / glm::dot(e - s, e - s), 0.0, 1.0);
    return glm::distance(p, s + t * (e - s));
  };
  const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
  const bool inside = glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                      glm::dot(glm::cross(c - b, p - b), n) >= 0.0 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= 0.0;
  if (inside) return std::abs(glm::dot(p - a, n));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// Distance from a point to the skin apart from one arm's own.
double DistanceToSkin(const Vec3& p, const Skinned& skin, std::size_t without) {
  double best = 1e9;
  std::size_t base = 0;
  for (const MeshPart& part : ScriptedPerformer().character.parts) {
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      const std::size_t a = base + part.triangles[t];
      const std::size_t b = base + part.triangles[t + 1];
      const std::size_t c = base + part.triangles[t + 2];
      if (skin.hand[a] == without || skin.hand[b] == without || skin.hand[c] == without) continue;
      if (glm::distance(p, skin.position[a]) > best + 0.1) continue;
      best = std::min(best,
                      DistanceToTriangle(p, skin.position[a], skin.position[b], skin.position[c]));
    }
    base += part.positions.size();
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
      const Skinned skin = SkinOf(pose);
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
  const Skinned skin = SkinOf(motion.poses[frame]);
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
