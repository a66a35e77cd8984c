// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "app/view/stage_layout.h"
#include "app/view/stage_picture.h"
#include "core/body/body.h"

namespace ego {
namespace {

CapturedMotion Turned(double angle) {
  CapturedMotion motion;
  motion.performer = TemplateBody();
  motion.rate_hz = 60.0;
  const Quat turn = glm::angleAxis(angle, kUp);
  for (int i = 0; i < 120; ++i) {
    Pose pose = CanonicalPose(motion.performer.skeleton);
    pose.root_ws += Vec3(0.02 * i, 0.0, 0.005 * i);
    pose.rotation_ls[0] = glm::angleAxis(0.3 * std::sin(0.1 * i), kUp);
    pose.root_ws = turn * pose.root_ws;
    pose.rotation_ls[0] = turn * pose.rotation_ls[0];
    motion.poses.push_back(pose);
  }
  return motion;
}

TEST(StageLayout, TurnsWithTheRoomOfTheTake) {
  const StageLayout plain(Turned(0.0));
  const std::vector<StageLayout::Member> members = {{1.78, 0.0, 1.0}, {1.2, 0.05, 0.7}};
  for (const double angle : {0.4, 1.9, -2.8}) {
    const StageLayout turned(Turned(angle));
    EXPECT_NEAR(std::remainder(turned.heading() - plain.heading() - angle, 2.0 * kPi), 0.0, 1e-9);
    for (const auto line : {StageLayout::Line::kSideways, StageLayout::Line::kDepthwise}) {
      std::vector<Vec3> before(2);
      std::vector<Vec3> after(2);
      plain.Place(60, line, members, before);
      turned.Place(60, line, members, after);
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LT(glm::distance(glm::angleAxis(angle, kUp) * before[i], after[i]), 1e-9);
      }
    }
  }
}

TEST(StageLayout, ATakeThatTurnsAllAroundFacesAsItBegins) {
  CapturedMotion motion = Turned(0.0);
  for (std::size_t i = 0; i < motion.poses.size(); ++i) {
    const double angle = 0.7 + 2.0 * kPi * static_cast<double>(i) / 120.0;
    motion.poses[i].rotation_ls[0] = glm::angleAxis(angle, kUp);
  }
  EXPECT_NEAR(StageLayout(motion).heading(), 0.7, 1e-9);
}

TEST(DisplayScale, LeavesOrdinaryPeopleAloneAndBoundsTheRest) {
  for (const double height : {0.8, 1.2, 1.78, 2.4}) EXPECT_EQ(DisplayScale(height, 1.78), 1.0);
  EXPECT_NEAR(4.2 * DisplayScale(4.2, 1.78), 1.4 * 1.78, 1e-12);
  EXPECT_NEAR(0.3 * DisplayScale(0.3, 1.78), 0.4 * 1.78, 1e-12);
  EXPECT_EQ(DisplayScale(0.0, 1.78), 1.0);
}

}  // namespace
}  // namespace ego
