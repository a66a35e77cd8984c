// SPDX-License-Identifier: MIT
#include "core/solve/solve_take.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/body/surface_fit.h"
#include "core/solve/marker_gaps.h"
#include "core/solve/performer_surface.h"
#include "core/solve/pose_gaps.h"
#include "core/solve/standing.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// The turn that makes the take upright where its vertical axis was read wrongly: the mean
/// direction from feet to head tells. Identity when that is up already or says nothing clear.
Quat Uprighting(const Skeleton& skeleton, const std::vector<Pose>& poses) {
  Vec3 sum{0.0};
  for (const Pose& pose : poses) {
    const ModelPose placed = ForwardKinematics(skeleton, pose);
    const Vec3 feet = 0.5 * (placed.Position(J::kLeftFoot) + placed.Position(J::kRightFoot));
    sum += glm::normalize(placed.Position(J::kHead) - feet);
  }
  const Vec3 mean = sum / static_cast<double>(std::max<std::size_t>(1, poses.size()));
  if (mean.y > 0.5) return kIdentity;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Vec3 up{0.0};
      up[axis] = sign;
      if (glm::dot(mean, up) < 0.8) continue;
      if (axis == 1) return sign > 0.0 ? kIdentity : glm::angleAxis(kPi, Vec3{1.0, 0.0, 0.0});
      return glm::angleAxis(0.5 * kPi, glm::normalize(glm::cross(up, kUp)));
    }
  }
  return kIdentity;
}

void Turn(const Quat& turn, MarkerTake& take, std::vector<Pose>& poses) {
  for (Vec3& p : take.position_ws) p = turn * p;
  for (Pose& pose : poses) {
    pose.root_ws = turn * pose.root_ws;
    pose.rotation_ls[0] = glm::normalize(turn * pose.rotation_ls[0]);
  }
}

double Quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void Measure(const MarkerTake& take, const MarkerModel& model, const std::vector<Pose>& poses,
             const std::vector<std::uint8_t>& solved, SolveReport& report) {
  std::vector<double> all;
  std::vector<double> sum(model.markers.size(), 0.0);
  std::vector<std::size_t> count(model.markers.size(), 0);
  std::vector<std::size_t> seen(model.markers.size(), 0);
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    const MarkerFrame frame = take.Frame(f);
    const ModelPose pose = ForwardKinematics(model.skeleton, poses[f]);
    for (std::size_t m = 0; m < model.markers.size(); ++m) {
      const BoundMarker& marker = model.markers[m];
      if (!frame.visible[marker.label]) continue;
      ++seen[m];
      if (!solved[f]) continue;
      const Vec3 point = MarkerPosition(marker, pose);
      const double error = 1000.0 * glm::distance(point, frame.position_ws[marker.label]);
      all.push_back(error);
      sum[m] += error;
      ++count[m];
    }
  }
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    report.markers.push_back(
        {take.labels[model.markers[m].label],
         count[m] == 0 ? 0.0 : sum[m] / static_cast<double>(count[m]),
         static_cast<double>(seen[m]) / static_cast<double>(take.frame_count)});
  }
  if (all.empty()) return;
  double total = 0.0;
  for (const double error : all) total += error;
  std::sort(all.begin(), all.end());
  report.mean_residual_mm = total / static_cast<double>(all.size());
  report.p50_residual_mm = Quantile(all, 0.50);
  report.p95_residual_mm = Quantile(all, 0.95);
  report.p99_residual_mm = Quantile(all, 0.99);
  report.max_residual_mm = all.back();
}

void Warn(const MarkerTake& take, const SkeletonFit& fit, SolveReport& report) {
  report.warnings.insert(report.warnings.begin(), take.warnings.begin(), take.warnings.end());
  std::string unknown;
  std::size_t unknown_count = 0;
  for (std::size_t i = 0; i < take.labels.size(); ++i) {
    const bool bound = std::any_of(fit.model.markers.begin(), fit.model.markers.end(),
                                   [&](const BoundMarker& m) { return m.label == i; });
    if (bound) continue;
    ++unknown_count;
    if (unknown_count <= 8) unknown += (unknown.empty() ? "" : ", ") + take.labels[i];
  }
  if (unknown_count > 0) {
    report.warnings.push_back(std::to_string(unknown_count) +
                              " markers are not used (unknown label, twice the same, or never "
                              "seen): " +
                              unknown + (unknown_count > 8 ? ", ..." : ""));
  }
  if (!report.frames_without_markers.empty()) {
    report.warnings.push_back(std::to_string(report.frames_without_markers.size()) + " of " +
                              std::to_string(take.frame_count) +
                              " frames show too few markers and were filled from neighbours");
  }
  for (const MarkerResidual& marker : report.markers) {
    if (marker.mean_mm > 5.0 * std::max(5.0, report.mean_residual_mm)) {
      report.warnings.push_back("marker " + marker.label + " is off by " +
                                std::to_string(static_cast<int>(marker.mean_mm)) +
                                " mm on average: a wrong label or a ghost");
    }
  }
}

}  // namespace

Result<SolvedTake> SolveTake(const MarkerTake& take, const MarkerSet& set,
                             const SolveOptions& options, const Progress& progress) {
  if (take.frame_count == 0 || !(take.rate_hz > 0.0)) {
    return Error{take.name + ": the take has no frames"};
  }
  const Progress fit_progress = [&](double fraction, std::string_view what) {
    return Report(progress, 0.5 * fraction, what);
  };
  Result<SkeletonFit> fitted = FitSkeleton(take, set, options.fit, fit_progress);
  if (!fitted) return Error{fitted.error()};
  SkeletonFit& fit = *fitted;

  PoseSolverOptions pose_options = options.pose;
  if (pose_options.step_per_frame > 0.0) {
    // The default is meant for some 100 frames a second; slower takes move farther per frame.
    pose_options.step_per_frame *= std::max(1.0, 100.0 / take.rate_hz);
  }
  const PoseSolver solver(fit.model, pose_options);
  const FilledTake filled(take, fit.model.predictors);
  PoseSolver::State state;
  std::vector<Pose> poses(take.frame_count);
  std::vector<std::uint8_t> solved(take.frame_count, 0);
  SolvedTake result;
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    if (f % 64 == 0 &&
        !Report(progress,
                0.5 + 0.45 * static_cast<double>(f) / static_cast<double>(take.frame_count),
                "solving postures")) {
      return Error{"cancelled"};
    }
    solved[f] = solver.Solve(filled.Frame(f), state).solved ? 1 : 0;
    poses[f] = state.pose;
    if (!solved[f]) result.report.frames_without_markers.push_back(f);
  }
  if (!Report(progress, 0.95, "measuring the body")) return Error{"cancelled"};
  FillGaps(ObservedJoints(fit.model, take), solved, poses);

  auto markers = std::make_shared<MarkerTake>(take);
  const Quat turn = Uprighting(fit.model.skeleton, poses);
  if (turn != kIdentity) {
    Turn(turn, *markers, poses);
    result.report.warnings.push_back(
        "the file's vertical axis was wrong; the take was turned upright");
  }
  LevelSoles(fit.model, poses, take.rate_hz);

  CapturedMotion& motion = result.motion;
  motion.name = take.name;
  motion.performer = PerformerBody(take.name, fit, set);
  motion.rate_hz = take.rate_hz;
  motion.floor_offset = -GroundHeight(motion.performer, poses, take.rate_hz);
  SolveReport& report = result.report;
  Measure(*markers, fit.model, poses, solved, report);
  for (Pose& pose : poses) pose.root_ws.y += motion.floor_offset;
  FitSurfaceToMotion(motion.performer, poses);
  motion.poses = std::move(poses);
  motion.markers = std::move(markers);

  report.marker_set = set.name;
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    report.segment_length_mm[s] =
        1000.0 * BoneLength(fit.model.skeleton, EndJoint(static_cast<LimbSegment>(s)));
  }
  report.height_m = motion.performer.height;
  report.frames = take.frame_count;
  report.rate_hz = take.rate_hz;
  Warn(take, fit, report);
  result.model = std::move(fit.model);
  Report(progress, 1.0, "solved");
  return result;
}

}  // namespace ego
