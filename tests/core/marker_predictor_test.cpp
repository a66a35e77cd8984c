// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/solve/marker_gaps.h"
#include "core/solve/marker_predictor.h"

namespace ego {
namespace {

constexpr double kRate = 100.0;

/// Two rigid bodies on a hinge that bends to and fro, turning and drifting through space: three
/// markers on the first, three on the second, of which the last is the one to lose. It may slip
/// along its body by `slip` from frame `slips_at` on.
MarkerTake Hinge(std::size_t frames, double slip = 0.0, std::size_t slips_at = 0) {
  MarkerTake take;
  take.name = "hinge";
  take.labels = {"A1", "A2", "A3", "B1", "B2", "B3"};
  take.rate_hz = kRate;
  take.frame_count = frames;
  const Vec3 places[] = {{0.0, 0.05, 0.0},  {-0.2, 0.0, 0.04}, {-0.1, -0.04, -0.03},
                         {0.05, 0.0, 0.05}, {0.2, 0.03, 0.0},  {0.22, -0.03, 0.02}};
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.0003);
  for (std::size_t f = 0; f < frames; ++f) {
    const double time = static_cast<double>(f) / kRate;
    const Quat body = glm::angleAxis(0.7 * time, glm::normalize(Vec3{0.3, 1.0, 0.2}));
    const Quat bent = body * glm::angleAxis(0.8 + 0.7 * std::sin(2.1 * time), Vec3{0.0, 0.0, 1.0});
    const Vec3 root{0.4 * time, 1.0, -0.2 * time};
    for (std::size_t m = 0; m < 6; ++m) {
      Vec3 place = places[m];
      if (m == 5 && f >= slips_at) place.x += slip;
      take.position_ws.push_back(root + (m < 3 ? body : bent) * place +
                                 Vec3{noise(random), noise(random), noise(random)});
      take.visible.push_back(1);
    }
  }
  return take;
}

std::vector<MarkerFrame> Frames(const MarkerTake& take, std::size_t stride) {
  std::vector<MarkerFrame> frames;
  for (std::size_t f = 0; f < take.frame_count; f += stride) frames.push_back(take.Frame(f));
  return frames;
}

MarkerPredictor Learnt(const MarkerTake& take) {
  const std::size_t neighbours[] = {0, 1, 2, 3, 4};
  return MarkerPredictor::Learn(5, 5, neighbours, Frames(take, 9)).value();
}

TEST(MarkerPredictor, TellsAMarkerBehindABendingJointFromItsNeighbours) {
  const MarkerTake take = Hinge(900);
  const MarkerPredictor predictor = Learnt(take);
  double squares = 0.0;
  double sigma = 0.0;
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    const auto told = predictor.Predict(take.Frame(f));
    ASSERT_TRUE(told) << f;
    const double error = glm::distance(told->position_ws, take.Frame(f).position_ws[5]);
    EXPECT_LT(error, 0.004) << f;
    squares += error * error / 3.0;
    sigma += told->sigma;
  }
  // It knows how sure it is.
  const double count = static_cast<double>(take.frame_count);
  EXPECT_LT(std::sqrt(squares / count), 1.5 * sigma / count);
  EXPECT_GT(std::sqrt(squares / count), 0.3 * sigma / count);
}

TEST(MarkerPredictor, FollowsTurnsAndShifts) {
  const MarkerTake take = Hinge(300);
  const MarkerPredictor predictor = Learnt(take);
  const Quat turn = glm::angleAxis(2.0, glm::normalize(Vec3{1.0, -0.5, 0.3}));
  const Vec3 shift{3.0, -1.0, 2.0};
  MarkerTake moved = take;
  for (Vec3& p : moved.position_ws) p = turn * p + shift;
  for (std::size_t f = 0; f < take.frame_count; f += 17) {
    const auto here = predictor.Predict(take.Frame(f));
    const auto there = predictor.Predict(moved.Frame(f));
    ASSERT_TRUE(here && there);
    EXPECT_LT(glm::distance(there->position_ws, turn * here->position_ws + shift), 1e-9);
    EXPECT_NEAR(there->sigma, here->sigma, 1e-9);
  }
}

TEST(MarkerPredictor, SaysNothingFromLostOrStrayNeighbours) {
  MarkerTake take = Hinge(300);
  const MarkerPredictor predictor = Learnt(take);
  take.visible[6 * 40 + 2] = 0;
  EXPECT_FALSE(predictor.Predict(take.Frame(40)));
  take.position_ws[6 * 80 + 1] += Vec3{0.6, -0.3, 0.5};
  EXPECT_FALSE(predictor.Predict(take.Frame(80)));
}

TEST(FilledTake, LeavesWhatWasSeenAndTellsTheRest) {
  MarkerTake take = Hinge(600);
  const MarkerTake truth = take;
  for (std::size_t f = 200; f < 250; ++f) take.visible[6 * f + 5] = 0;
  const MarkerPredictor predictors[] = {Learnt(take)};
  const FilledTake filled(take, predictors);
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    const MarkerFrame frame = filled.Frame(f);
    const bool lost = f >= 200 && f < 250;
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_TRUE(frame.visible[m]);
      EXPECT_EQ(frame.told_sigma[m] > 0.0, lost && m == 5);
      if (lost && m == 5) {
        EXPECT_LT(glm::distance(frame.position_ws[m], truth.Frame(f).position_ws[m]), 0.004);
      } else {
        EXPECT_EQ(frame.position_ws[m], take.Frame(f).position_ws[m]);
      }
    }
  }
}

TEST(FilledTake, JoinsBothEndsOfAGapWhereTheMarkerHasSlipped) {
  // Learnt mostly before the slip of 15 mm, lost only after it.
  MarkerTake take = Hinge(600, 0.015, 500);
  const MarkerTake truth = take;
  for (std::size_t f = 540; f < 560; ++f) take.visible[6 * f + 5] = 0;
  const std::size_t neighbours[] = {0, 1, 2, 3, 4};
  const std::vector<MarkerFrame> all = Frames(take, 9);
  const MarkerPredictor predictors[] = {
      MarkerPredictor::Learn(5, 5, neighbours, std::span(all).first(55)).value()};
  const FilledTake filled(take, predictors);
  double alone = 0.0;
  double joined = 0.0;
  for (std::size_t f = 540; f < 560; ++f) {
    const Vec3& at = truth.Frame(f).position_ws[5];
    alone = std::max(alone, glm::distance(predictors[0].Predict(take.Frame(f))->position_ws, at));
    joined = std::max(joined, glm::distance(filled.Frame(f).position_ws[5], at));
  }
  EXPECT_GT(alone, 0.010);
  EXPECT_LT(joined, 0.005);
}

}  // namespace
}  // namespace ego
