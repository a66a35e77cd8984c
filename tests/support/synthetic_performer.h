// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/markers/marker_set.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/pose.h"
#include "core/solve/body_parameters.h"
#include "core/solve/pose_solver.h"

namespace ego::test {

/// A performer whose every length, marker place and posture is known, doing gymnastics: what a
/// solver's estimates are compared with.
struct SyntheticTake {
  MarkerModel truth;
  std::vector<Pose> poses;
  MarkerTake take;
};

struct SyntheticOptions {
  double scale = 0.96;
  double length_spread = 0.02;    // lengths differ from the scaled template, metres
  double placement_spread = 0.5;  // markers differ from the set's places, in its sigmas
  double noise = 0.001;           // metres, one axis
  double skin = 0.0;              // share by which limb markers follow the bones beside theirs
  double frames = 400;
  double rate_hz = 100.0;
  unsigned seed = 1;
};

SyntheticTake MakeSyntheticTake(const MarkerSet& set, const SyntheticOptions& options);

/// Mean distance between the joints (not the toes) of two poses on their skeletons, metres.
double MeanJointDistance(const Skeleton& a, const Pose& pose_a, const Skeleton& b,
                         const Pose& pose_b);

}  // namespace ego::test
