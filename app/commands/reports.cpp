// SPDX-License-Identifier: MIT
#include "app/commands/reports.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"

namespace ego {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSegmentNames[kSegmentCount] = {
    "leftUpperArm", "leftForearm", "rightUpperArm", "rightForearm",
    "leftThigh",    "leftCalf",    "rightThigh",    "rightCalf",
};

// Figures are for people and plots: four digits after the point say all there is.
double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json Lengths(const Skeleton& skeleton) {
  Json lengths = Json::object();
  for (std::size_t i = 0; i < kSegmentCount; ++i) {
    const HumanoidJoint end = EndJoint(static_cast<LimbSegment>(i));
    lengths[kSegmentNames[i]] = Rounded(1000.0 * BoneLength(skeleton, end));
  }
  return lengths;
}

Json TakeFacts(const LoadedTake& take) {
  return {
      {"name", take.name},
      {"file", take.path.empty() ? "" : take.path.string()},
      {"frames", take.motion->poses.size()},
      {"rate_hz", take.motion->rate_hz},
  };
}

Json SolveFacts(const SolveReport& report) {
  Json markers = Json::array();
  for (const MarkerResidual& marker : report.markers) {
    markers.push_back({{"label", marker.label},
                       {"mean_residual_mm", Rounded(marker.mean_mm)},
                       {"visible_share", Rounded(marker.visible_share)}});
  }
  return {
      {"marker_set", report.marker_set},
      {"mean_residual_mm", Rounded(report.mean_residual_mm)},
      {"p50_residual_mm", Rounded(report.p50_residual_mm)},
      {"p95_residual_mm", Rounded(report.p95_residual_mm)},
      {"p99_residual_mm", Rounded(report.p99_residual_mm)},
      {"max_residual_mm", Rounded(report.max_residual_mm)},
      {"markers", markers},
      {"frames_without_markers", report.frames_without_markers},
  };
}

Json Contacts(const ContactScore& score) {
  if (score.gap_error.count == 0) return {{"contacts", 0}};
  return {
      {"contacts", score.gap_error.count},
      {"mean_gap_error_percent", Rounded(100.0 * score.gap_error.Mean())},
      {"max_gap_error_percent", Rounded(100.0 * score.gap_error.max)},
      {"recall", Rounded(score.Recall())},
      {"reachable", score.reachable_gap_error.count},
      {"mean_gap_error_of_reachable_percent", Rounded(100.0 * score.reachable_gap_error.Mean())},
      {"recall_of_reachable", Rounded(score.ReachableRecall())},
  };
}

Json ScoreFacts(const RetargetScore& score) {
  return {
      {"wrist", Contacts(score.wrist)},
      {"palm", Contacts(score.palm)},
      {"fingertip", Contacts(score.fingertip)},
      {"mean_arm_penetration_percent", Rounded(100.0 * score.arm_penetration.Mean())},
      {"max_arm_penetration_percent", Rounded(100.0 * score.arm_penetration.max)},
      {"mean_foot_height_error_percent", Rounded(100.0 * score.foot_height_error.Mean())},
      {"mean_foot_slide_percent_per_s", Rounded(100.0 * score.foot_slide.Mean())},
      {"largest_joint_step_deg", Rounded(Degrees(score.largest_step))},
      {"largest_joint_step_frame", score.largest_step_frame},
      {"largest_added_step_deg", Rounded(Degrees(score.largest_added_step))},
      {"largest_added_step_frame", score.largest_added_step_frame},
  };
}

Json Times(const StepTime& time) {
  return {{"p50", Rounded(time.p50_us)}, {"p99", Rounded(time.p99_us)}};
}

std::string Text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string FormatSolveReport(const LoadedTake& take) {
  Json report = TakeFacts(take);
  report["height_m"] = Rounded(take.motion->performer.height);
  if (take.solve) report.update(SolveFacts(*take.solve));
  report["segment_lengths_mm"] = Lengths(take.motion->performer.skeleton);
  report["floor_offset_m"] = Rounded(take.motion->floor_offset);
  report["notes"] = take.notes;
  return Text(report);
}

std::string FormatRetargetReport(const LoadedTake& take, std::string_view method,
                                 const StepTime& normalize,
                                 const std::vector<AvatarOutcome>& outcomes) {
  Json avatars = Json::array();
  for (const AvatarOutcome& outcome : outcomes) {
    const LoadedAvatar& avatar = *outcome.avatar;
    avatars.push_back({
        {"name", avatar.name},
        {"source", avatar.path.string()},
        {"file", outcome.file},
        {"height_m", Rounded(avatar.body->height)},
        {"segment_lengths_mm", Lengths(avatar.body->skeleton)},
        {"calibration", avatar.path.empty()         ? "exact"
                        : avatar.calibrated_by_file ? "file"
                                                    : "proposed"},
        {"doubtful_points", avatar.calibration.doubtful},
        {"score", ScoreFacts(outcome.score)},
        {"copy", ScoreFacts(outcome.copy)},
        {"adapt_us", Times(outcome.adapt)},
        {"notes", avatar.notes},
    });
  }
  Json report = {{"take", TakeFacts(take)}, {"method", method}};
  report["take"]["height_m"] = Rounded(take.motion->performer.height);
  report["take"]["notes"] = take.notes;
  if (take.solve) report["take"]["mean_residual_mm"] = Rounded(take.solve->mean_residual_mm);
  report["normalize_us"] = Times(normalize);
  report["avatars"] = avatars;
  return Text(report);
}

}  // namespace ego
