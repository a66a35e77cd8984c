// SPDX-License-Identifier: MIT
#include "app/view/stage_layout.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace ego {
namespace {

// Walks along x at 1.2 m/s, or stands and sways a little.
CapturedMotion Motion(bool walks) {
  CapturedMotion motion;
  motion.performer = TemplateBody();
  motion.rate_hz = 100.0;
  for (int i = 0; i < 1000; ++i) {
    Pose pose = CanonicalPose(motion.performer.skeleton);
    pose.root_ws.x += walks ? 0.012 * i : 0.1 * std::sin(0.05 * i);
    motion.poses.push_back(pose);
  }
  return motion;
}

constexpr std::array<StageLayout::Member, 3> kMembers = {{{1.78, 1.0}, {1.1, 0.6}, {2.2, 1.3}}};

TEST(StageLayout, TheAnchorFollowsAWalkAndIgnoresSway) {
  const CapturedMotion walk = Motion(true);
  const StageLayout walking(walk);
  for (const std::size_t frame : {std::size_t{0}, std::size_t{500}, std::size_t{999}}) {
    EXPECT_NEAR(walking.Anchor(frame).x, walk.poses[frame].root_ws.x, 0.02);
    EXPECT_EQ(walking.Anchor(frame).y, 0.0);
  }
  const StageLayout standing(Motion(false));
  EXPECT_EQ(standing.Anchor(0), standing.Anchor(777));
}

TEST(StageLayout, NobodyWalksIntoAnybody) {
  const CapturedMotion walk = Motion(true);
  const StageLayout layout(walk);
  for (const auto line : {StageLayout::Line::kSideways, StageLayout::Line::kDepthwise}) {
    for (std::size_t frame = 0; frame < walk.poses.size(); frame += 37) {
      std::array<Vec3, 3> offset;
      layout.Place(frame, line, kMembers, offset);
      std::array<Vec3, 3> at;
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = kMembers[i].scale * walk.poses[frame].root_ws + offset[i];
      }
      const bool sideways = line == StageLayout::Line::kSideways;
      for (std::size_t i = 0; i + 1 < 3; ++i) {
        const double gap = sideways ? at[i + 1].x - at[i].x : at[i].z - at[i + 1].z;
        EXPECT_GT(gap, 0.25 * (kMembers[i].height + kMembers[i + 1].height)) << frame;
      }
    }
  }
}

TEST(StageLayout, ThePerformerStandsStillInTheWorldButForThePlaceInTheLine) {
  const StageLayout layout(Motion(true));
  std::array<Vec3, 3> early;
  std::array<Vec3, 3> late;
  layout.Place(10, StageLayout::Line::kSideways, kMembers, early);
  layout.Place(900, StageLayout::Line::kSideways, kMembers, late);
  EXPECT_EQ(early[0], late[0]);  // feet stay planted on the grid
}

}  // namespace
}  // namespace ego
