// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/body/body_surface.h"
#include "core/model/character.h"
#include "core/model/joint_override.h"
#include "core/model/mesh_point.h"

namespace ego {

enum class PickState : std::uint8_t {
  kMissing,    // no place known: the template's stands in
  kProposed,   // found by the studio
  kDoubtful,   // found by the studio, or carried over; a person should look
  kPicked,     // clicked by a person
  kConfirmed,  // found by the studio, looked at by a person
};
std::string_view Name(PickState state);
/// A person stands for it: picked or confirmed.
constexpr bool Settled(PickState state) {
  return state == PickState::kPicked || state == PickState::kConfirmed;
}

/// One picked or proposed place on the skin.
struct CalibrationPoint {
  MeshPoint place;
  PickState state = PickState::kMissing;
  double confidence = 0.0;  // 0 to 1; 1 for what a person picked or confirmed
  std::string reason;       // why it is doubtful or missing, one clause; else empty

  friend bool operator==(const CalibrationPoint&, const CalibrationPoint&) = default;
};

/// Thickness of one limb segment (paper, section 4.2: the gray dots of figure 5).
struct SegmentCalibration {
  /// Dots on the segment's skin; those with state kMissing do not count.
  std::vector<CalibrationPoint> dots;
  /// Metres, canonical pose. The dots' average distance to the bone where there are dots (see
  /// UpdateThickness); given as it is where there are none.
  double radius = 0.0;
  PickState state = PickState::kMissing;  // of the radius as a whole
  double confidence = 0.0;
  std::string reason;

  friend bool operator==(const SegmentCalibration&, const SegmentCalibration&) = default;
};

struct HandCalibration {
  CalibrationPoint palm;          // middle of the palm
  CalibrationPoint back_of_hand;  // the other side, across the hand from the palm
  CalibrationPoint fingertip;     // tip of the middle finger, palm side
  /// Metres. Half the distance from palm to back of hand where both are known.
  double half_thickness = 0.0;

  friend bool operator==(const HandCalibration&, const HandCalibration&) = default;
};

struct FootCalibration {
  CalibrationPoint heel;  // lowest point of the heel
  CalibrationPoint ball;  // lowest point under the ball
  CalibrationPoint toe_tip;

  friend bool operator==(const FootCalibration&, const FootCalibration&) = default;
};

/// Everything that a person clicks, or the studio proposes, to make an avatar of a character
/// (paper, section 4.2). Plain data: places on the skin and lengths; see MakeAvatarBody.
struct AvatarCalibration {
  std::uint64_t mesh_hash = 0;  // MeshHash of the character it was made on
  std::array<CalibrationPoint, kSampleCount> sample;
  std::array<SegmentCalibration, kSegmentCount> segment;
  std::array<HandCalibration, 2> hand;  // left, right
  std::array<FootCalibration, 2> foot;  // left, right
  /// Which node plays which joint where a person mended the map; places and lengths above are
  /// those of the mended character.
  JointOverrides joint_override;

  CalibrationPoint& At(SamplePoint p) { return sample[Index(p)]; }
  const CalibrationPoint& At(SamplePoint p) const { return sample[Index(p)]; }
  SegmentCalibration& At(LimbSegment s) { return segment[Index(s)]; }
  const SegmentCalibration& At(LimbSegment s) const { return segment[Index(s)]; }

  friend bool operator==(const AvatarCalibration&, const AvatarCalibration&) = default;
};

/// Every single point of a calibration under a stable name, for lists, files and undo: samples
/// ("navel"), hands ("leftPalm", "leftBackOfHand", "leftFingertip"), feet ("leftHeel", "leftBall",
/// "leftToeTip") and dots ("leftThigh[3]").
struct NamedPoint {
  std::string name;
  CalibrationPoint* point = nullptr;
};
std::vector<NamedPoint> AllPoints(AvatarCalibration& calibration);

/// Stable name of a segment in files ("leftUpperArm", "leftForearm", "leftThigh", "leftCalf").
std::string_view Name(LimbSegment segment);

/// Recomputes the radii of segments that have dots, and the hands' half thickness where palm and
/// back are known, from the character in its canonical pose. Call after an edit.
void UpdateThickness(const Character& character, AvatarCalibration& calibration);

/// How sure the calibration is as a whole, and how many points a person should look at.
struct CalibrationSummary {
  std::size_t picked = 0;  // or confirmed
  std::size_t proposed = 0;
  std::size_t doubtful = 0;
  std::size_t missing = 0;
  double lowest_confidence = 1.0;
};
/// Samples, hands and feet, and each segment once.
CalibrationSummary Summarize(const AvatarCalibration& calibration);

}  // namespace ego
