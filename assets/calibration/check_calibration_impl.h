// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "assets/calibration/check_calibration.h"
#include "assets/calibration/crude_mesh.h"
#include "assets/calibration/proposal_draft.h"
#include "assets/calibration/skin_probe.h"

namespace ego {

inline bool Known(const Character& character, const CalibrationPoint& point) {
  return point.state != PickState::kMissing && IsOn(character, point.place);
}

/// A title in the middle of a sentence.
inline std::string Lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

/// What the source files of CalibrationChecker share.
struct CalibrationChecker::Impl {
  Impl(const Character& the_character, const SurfaceMesh& the_surface)
      : character(the_character),
        surface(the_surface),
        probe(the_character),
        draft(the_character, probe),
        skin(SkinMatrices(the_character, the_character.rig.canonical_global)) {
    for (std::size_t s = 0; s < kSegmentCount; ++s) {
      MeasureSegment(static_cast<LimbSegment>(s));
    }
  }

  const Character& character;
  const SurfaceMesh& surface;
  SkinProbe probe;
  ProposalDraft draft;  // for the measures of the body; its calibration is not used
  std::vector<Mat4> skin;
  /// The skin's mean distance from each bone by rings; 0 where it has no closed ones.
  std::array<double, kSegmentCount> thickness{};

  /// One check at work.
  struct Look {
    const AvatarCalibration& calibration;
    SamplePlaces places;
    std::vector<CalibrationFinding> findings;
  };

  double Height() const { return draft.template_body.height; }
  Vec3 PositionOf(const CalibrationPoint& point) const {
    return PosePoint(character, skin, point.place);
  }

  void MeasureSegment(LimbSegment segment);

  CalibrationFinding& Add(Look& look, Severity severity, FindingKind kind, std::string sentence,
                          std::vector<PointId> points) const;

  void CheckPoints(Look& look) const;
  void CheckPlace(Look& look, PointId id, const CalibrationPoint& point) const;
  void CheckTriangles(Look& look) const;
  void CheckCrossings(Look& look) const;
  void CheckSymmetry(Look& look) const;
  void CheckSegments(Look& look) const;
  void CheckJoints(Look& look) const;
  SamplePoint WorstCorner(const SamplePlaces& places, const std::vector<std::size_t>& triangles,
                          std::size_t of) const;
  Vec3 SegmentMiddle(LimbSegment segment) const {
    return 0.5 * (probe.Joint(StartJoint(segment)) + probe.Joint(EndJoint(segment)));
  }
};

}  // namespace ego
