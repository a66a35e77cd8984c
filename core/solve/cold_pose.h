// SPDX-License-Identifier: MIT
#pragma once

#include "core/markers/marker_take.h"
#include "core/solve/pose_solver.h"

namespace ego {

/// Ways to guess a posture from nothing but one frame; they fail on different frames.
enum class ColdGuess {
  kTrunkAndLimbs,   // whole trunk rigid, limbs pointed at their markers
  kPelvisAndLimbs,  // pelvis rigid, for bent backs
  kArmsHanging,     // trunk rigid, limbs neutral
  kTPose,           // trunk rigid, limbs canonical
};
inline constexpr ColdGuess kColdGuesses[] = {ColdGuess::kTrunkAndLimbs, ColdGuess::kPelvisAndLimbs,
                                             ColdGuess::kArmsHanging, ColdGuess::kTPose};

/// A posture near enough for the solver to begin: the trunk by a rigid fit, each limb as a
/// two-bone chain pointed at its visible markers. Needs at least three visible markers.
Pose GuessPose(const MarkerModel& model, const MarkerFrame& frame, ColdGuess guess);

}  // namespace ego
