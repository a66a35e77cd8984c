// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/markers/marker_set.h"
#include "core/markers/marker_take.h"
#include "core/pipeline/captured_motion.h"
#include "core/solve/pose_solver.h"
#include "core/solve/skeleton_fit.h"

namespace ego {

struct SolveOptions {
  SkeletonFitOptions fit;
  PoseSolverOptions pose;
};

/// How well one marker agrees with the solved posture.
struct MarkerResidual {
  std::string label;           // as in the take
  double mean_mm = 0.0;        // over the frames it is visible in
  double visible_share = 0.0;  // of all frames, 0 to 1
};

/// The figures of a solve.
struct SolveReport {
  std::string marker_set;
  double mean_residual_mm = 0.0;  // over all visible markers of the set, ghosts included
  double p50_residual_mm = 0.0;
  double p95_residual_mm = 0.0;
  double p99_residual_mm = 0.0;
  double max_residual_mm = 0.0;
  std::vector<MarkerResidual> markers;
  std::array<double, kSegmentCount> segment_length_mm{};  // indexed by LimbSegment
  double height_m = 0.0;                                  // estimated stature
  std::size_t frames = 0;
  double rate_hz = 0.0;
  std::vector<std::size_t> frames_without_markers;  // too few to solve: filled from neighbours
  std::vector<std::string> warnings;                // sentences
};

/// A take solved: the motion, what it was solved with and how well it went.
struct SolvedTake {
  CapturedMotion motion;
  MarkerModel model;  // for live solving with the same performer and markers
  SolveReport report;
};

/// Solves an archive take that comes with no calibration: fits skeleton and marker places
/// (FitSkeleton), solves every frame (PoseSolver), fills frames without markers from their
/// neighbours, puts the soles of standing feet on y = 0 and builds the performer's surface, which
/// is pulled in where the motion proves it free. `motion.markers` are the take's own, turned
/// upright where the file was not; their heights do not contain `floor_offset` yet, the poses do.
/// Error: too few known markers, impossible sizes, or cancelled; one sentence naming the take.
Result<SolvedTake> SolveTake(const MarkerTake& take, const MarkerSet& set,
                             const SolveOptions& options = {}, const Progress& progress = {});

}  // namespace ego
