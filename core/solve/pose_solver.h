// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/math.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/pose.h"
#include "core/skeleton/skeleton.h"
#include "core/solve/bound_marker.h"
#include "core/solve/marker_predictor.h"

namespace ego {

/// A performer as the solver sees one: bones and where the markers sit on them.
struct MarkerModel {
  Skeleton skeleton;
  std::vector<BoundMarker> markers;
  std::vector<MarkerPredictor> predictors;  // of markers that others can tell; may be empty
};

struct PoseSolverOptions {
  double sigma = 0.008;                  // expected marker error, one axis, metres
  double outlier_factor = 5.0;           // errors beyond this many sigmas lose their pull
  double step_per_frame = Radians(8.0);  // soft temporal prior, per joint and axis; 0: none
  int max_iterations = 12;               // per frame once started
  double restart_residual = 0.03;        // mean residual that triggers a fresh start, metres
};

/// What one solve came to.
struct PoseSolverReport {
  std::size_t visible = 0;     // bound markers that were seen
  double mean_residual = 0.0;  // over those, metres
  int iterations = 0;
  bool solved = false;     // false: fewer than kMinMarkers seen, the pose was held
  bool restarted = false;  // the warm start was given up for a fresh one
};

/// Finds, frame by frame, the posture whose markers lie closest to those seen: Levenberg-Marquardt
/// on joint angles with a robust loss, priors on what markers see badly (spine, clavicles, wrists,
/// ankles, forearm pronation), soft limits against over-stretched elbows and knees, and a soft
/// temporal prior. Markers that are missing or far off are survived. The paper's step 3, [33].
class PoseSolver {
 public:
  static constexpr std::size_t kMinMarkers = 6;

  /// What persists between frames. One per stream of frames.
  struct State {
    Pose pose;
    bool started = false;
    // What is solved for: the frame with lost markers told from others. Kept for its memory alone.
    std::vector<Vec3> position_ws{};
    std::vector<std::uint8_t> visible{};
    std::vector<double> told_sigma{};
  };

  PoseSolver(MarkerModel model, PoseSolverOptions options);

  const MarkerModel& model() const { return model_; }

  /// Solves one frame from `state.pose` (from a guess when not started) and leaves the result
  /// there, world space. Fewer than kMinMarkers seen: the pose is held. Never NaN. Markers that are
  /// lost, or far from where they can be, are told from others as far as the model's predictors
  /// can. Allocates only where it has to start afresh and where a stream's first marker is lost.
  PoseSolverReport Solve(const MarkerFrame& frame, State& state) const;

  /// Solves with no regard to any earlier frame: from several guesses, the best is kept.
  PoseSolverReport SolveCold(const MarkerFrame& frame, State& state) const;

 private:
  MarkerModel model_;
  PoseSolverOptions options_;
};

}  // namespace ego
