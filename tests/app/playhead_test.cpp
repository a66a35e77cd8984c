// SPDX-License-Identifier: MIT
#include "app/stage/playhead.h"

#include <chrono>

#include <gtest/gtest.h>

namespace ego {
namespace {

using namespace std::chrono_literals;

Playhead::Time At(double seconds) {
  return Playhead::Time{} + 1h +
         std::chrono::duration_cast<Playhead::Time::duration>(
             std::chrono::duration<double>(seconds));
}

Playhead Playing(std::size_t frames, double rate) {
  Playhead playhead;
  playhead.SetMotion(frames, rate, At(0.0));
  playhead.Play(true, At(0.0));
  return playhead;
}

TEST(Playhead, StandsStillUntilPlayed) {
  Playhead playhead;
  playhead.SetMotion(10, 100.0, At(0.0));
  EXPECT_FALSE(playhead.NextDue().has_value());
  EXPECT_FALSE(playhead.Advance(At(5.0)));
  EXPECT_EQ(playhead.frame(), 0u);
}

TEST(Playhead, ShowsEveryFrameWhenWokenWhenDue) {
  Playhead playhead = Playing(1000, 119.88);
  for (std::size_t i = 1; i < 5000; ++i) {
    ASSERT_TRUE(playhead.NextDue().has_value());
    ASSERT_FALSE(playhead.Advance(*playhead.NextDue() - 10us));
    ASSERT_TRUE(playhead.Advance(*playhead.NextDue())) << i;
    ASSERT_EQ(playhead.frame(), i % 1000);
  }
  EXPECT_EQ(playhead.missed(), 0u);
}

TEST(Playhead, FollowsTheClockNotTheNumberOfCalls) {
  Playhead playhead = Playing(100000, 120.0);
  for (int i = 0; i <= 40; ++i) playhead.Advance(At(0.25 * i));
  EXPECT_EQ(playhead.frame(), 1200u);
  EXPECT_EQ(playhead.missed(), 1200u - 40u);
}

TEST(Playhead, SpeedChangesFromTheFrameShown) {
  Playhead playhead = Playing(1000, 100.0);
  playhead.Advance(At(1.0));
  EXPECT_EQ(playhead.frame(), 100u);
  playhead.SetSpeed(0.5, At(1.0));
  playhead.Advance(At(2.0));
  EXPECT_EQ(playhead.frame(), 150u);
  playhead.SetSpeed(100.0, At(2.0));
  EXPECT_EQ(playhead.speed(), Playhead::kFastest);
  playhead.Advance(At(3.0));
  EXPECT_EQ(playhead.frame(), 550u);
}

TEST(Playhead, StopsAtTheEndWithoutALoopAndBeginsAgain) {
  Playhead playhead = Playing(50, 100.0);
  playhead.SetLoop(false, At(0.0));
  EXPECT_TRUE(playhead.Advance(At(7.0)));
  EXPECT_EQ(playhead.frame(), 49u);
  EXPECT_FALSE(playhead.playing());
  playhead.Play(true, At(8.0));
  EXPECT_EQ(playhead.frame(), 0u);
  EXPECT_TRUE(playhead.playing());
}

TEST(Playhead, StepPausesAndStaysWithinTheMotion) {
  Playhead playhead = Playing(20, 100.0);
  playhead.Advance(At(0.05));
  playhead.Step(1, At(0.05));
  EXPECT_FALSE(playhead.playing());
  EXPECT_EQ(playhead.frame(), 6u);
  playhead.Step(-100, At(0.1));
  EXPECT_EQ(playhead.frame(), 0u);
  playhead.Step(100, At(0.1));
  EXPECT_EQ(playhead.frame(), 19u);
}

TEST(Playhead, SeekIsClampedAndPlaysOnFromThere) {
  Playhead playhead = Playing(20, 100.0);
  playhead.SetLoop(false, At(0.0));
  playhead.Seek(12, At(1.0));
  playhead.Advance(At(1.03));
  EXPECT_EQ(playhead.frame(), 15u);
  playhead.Seek(1000, At(1.03));
  EXPECT_EQ(playhead.frame(), 19u);
}

TEST(Playhead, AnEmptyMotionIsNeverDue) {
  Playhead playhead = Playing(0, 100.0);
  playhead.Seek(3, At(0.0));
  playhead.Step(2, At(0.0));
  EXPECT_FALSE(playhead.Advance(At(1.0)));
  EXPECT_FALSE(playhead.NextDue().has_value());
  EXPECT_EQ(playhead.frame(), 0u);
}

}  // namespace
}  // namespace ego
