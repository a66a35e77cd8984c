// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/markers/marker_set.h"
#include "core/markers/marker_take.h"
#include "core/solve/pose_solver.h"

namespace ego {

struct SkeletonFitOptions {
  std::size_t frames = 40;          // postures of the global fit, spread over what the take holds
  double symmetry_sigma = 0.002;    // soft left/right equality of lengths, metres
  double offset_sigma_scale = 1.0;  // multiplies the marker set's sigmas
};

/// Segment lengths, joint centres and marker places estimated from a take itself.
struct SkeletonFit {
  MarkerModel model;
  std::vector<std::size_t> set_marker;  // per bound marker: its index in the marker set
  std::vector<double> offset_sigma;     // per bound marker: prior sigma used, metres
  double scale = 1.0;                   // body size relative to the template
  std::vector<std::size_t> frames;      // the frames fitted
  double mean_residual = 0.0;           // over their visible markers, metres
};

/// Robust global least squares over diverse frames (paper, section 4.1, [12]): posture of each
/// frame, and shared by all, segment lengths with a soft left/right symmetry and marker offsets
/// with the set's priors. What the take cannot show stays at the template scaled to the performer.
/// Error: too few known markers, or no frame with enough of them.
Result<SkeletonFit> FitSkeleton(const MarkerTake& take, const MarkerSet& set,
                                const SkeletonFitOptions& options = {},
                                const Progress& progress = {});

}  // namespace ego
