// SPDX-License-Identifier: MIT
#include "core/model/avatar_calibration.h"

#include <algorithm>

namespace ego {
namespace {

constexpr std::array<std::string_view, kSegmentCount> kSegmentNames = {
    "leftUpperArm", "leftForearm", "rightUpperArm", "rightForearm",
    "leftThigh",    "leftCalf",    "rightThigh",    "rightCalf"};

/// Distance of a point to a bone, and where along it (0 at the start, 1 at the end).
double DistanceToBone(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 axis = b - a;
  const double length2 = glm::dot(axis, axis);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, axis) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * axis);
}

bool Counts(const Character& character, const CalibrationPoint& point) {
  return point.state != PickState::kMissing && IsOn(character, point.place);
}

}  // namespace

std::string_view Name(PickState state) {
  switch (state) {
    case PickState::kMissing:
      return "missing";
    case PickState::kProposed:
      return "proposed";
    case PickState::kDoubtful:
      return "doubtful";
    case PickState::kPicked:
      return "picked";
    case PickState::kConfirmed:
      break;
  }
  return "confirmed";
}

std::string_view Name(LimbSegment segment) { return kSegmentNames[Index(segment)]; }

std::vector<NamedPoint> AllPoints(AvatarCalibration& calibration) {
  std::vector<NamedPoint> all;
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    all.push_back({std::string(Name(static_cast<SamplePoint>(i))), &calibration.sample[i]});
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string prefix = side == 0 ? "left" : "right";
    all.push_back({prefix + "Palm", &calibration.hand[side].palm});
    all.push_back({prefix + "BackOfHand", &calibration.hand[side].back_of_hand});
    all.push_back({prefix + "Fingertip", &calibration.hand[side].fingertip});
    all.push_back({prefix + "Heel", &calibration.foot[side].heel});
    all.push_back({prefix + "Ball", &calibration.foot[side].ball});
    all.push_back({prefix + "ToeTip", &calibration.foot[side].toe_tip});
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    std::vector<CalibrationPoint>& dots = calibration.segment[s].dots;
    for (std::size_t d = 0; d < dots.size(); ++d) {
      all.push_back({std::string(kSegmentNames[s]) + "[" + std::to_string(d) + "]", &dots[d]});
    }
  }
  return all;
}

void UpdateThickness(const Character& character, AvatarCalibration& calibration) {
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  const std::array<Vec3, kJointCount> joint = CanonicalPositions(character.rig.skeleton);
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    double sum = 0.0;
    std::size_t count = 0;
    for (const CalibrationPoint& dot : calibration.segment[s].dots) {
      if (!Counts(character, dot)) continue;
      sum += DistanceToBone(PosePoint(character, skin, dot.place),
                            joint[Index(StartJoint(segment))], joint[Index(EndJoint(segment))]);
      ++count;
    }
    if (count > 0) calibration.segment[s].radius = sum / static_cast<double>(count);
  }
  for (HandCalibration& hand : calibration.hand) {
    if (!Counts(character, hand.palm) || !Counts(character, hand.back_of_hand)) continue;
    hand.half_thickness = 0.5 * glm::distance(PosePoint(character, skin, hand.palm.place),
                                              PosePoint(character, skin, hand.back_of_hand.place));
  }
}

CalibrationSummary Summarize(const AvatarCalibration& calibration) {
  CalibrationSummary summary;
  const auto count = [&](PickState state, double confidence) {
    switch (state) {
      case PickState::kMissing:
        ++summary.missing;
        break;
      case PickState::kProposed:
        ++summary.proposed;
        break;
      case PickState::kDoubtful:
        ++summary.doubtful;
        break;
      case PickState::kPicked:
      case PickState::kConfirmed:
        ++summary.picked;
        break;
    }
    summary.lowest_confidence = std::min(summary.lowest_confidence, confidence);
  };
  const auto count_point = [&](const CalibrationPoint& p) { count(p.state, p.confidence); };
  for (const CalibrationPoint& p : calibration.sample) count_point(p);
  for (const SegmentCalibration& s : calibration.segment) count(s.state, s.confidence);
  for (const HandCalibration& hand : calibration.hand) {
    count_point(hand.palm);
    count_point(hand.back_of_hand);
    count_point(hand.fingertip);
  }
  for (const FootCalibration& foot : calibration.foot) {
    count_point(foot.heel);
    count_point(foot.ball);
    count_point(foot.toe_tip);
  }
  return summary;
}

}  // namespace ego
