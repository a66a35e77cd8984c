// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/mesh/surface_mesh.h"
#include "core/model/avatar_calibration.h"
#include "core/model/calibration_point.h"
#include "core/model/character.h"

namespace ego {

enum class Severity : std::uint8_t {
  kNote,     // worth knowing
  kWarning,  // a person should look
  kError,    // the avatar will move wrongly
};

enum class FindingKind : std::uint8_t {
  kMissingPoint,
  kDoubtfulPoint,
  kFlippedTriangle,
  kDegenerateTriangle,
  kSelfCrossing,  // two triangles of a crude mesh cut through each other
  kOffBody,       // a trunk or head point on an arm, a leg, a prop
  kOnLooseCloth,  // far outside the body's skin: a cape, a skirt
  kAsymmetric,
  kCapsuleTooFat,
  kCapsuleTooThin,
  kMissingRadius,
  kDoubtfulJoint,
};
/// Stable name for reports ("flippedTriangle").
std::string_view Name(FindingKind kind);
std::string_view Name(Severity severity);

/// One thing wrong, as a sentence, with where to look.
struct CalibrationFinding {
  Severity severity = Severity::kWarning;
  FindingKind kind = FindingKind::kDoubtfulPoint;
  std::string sentence;                // for a person; no trailing newline
  std::vector<PointId> points;         // to select; the first is the worst
  std::vector<std::size_t> triangles;  // of SampleTriangles()
  std::optional<LimbSegment> segment;
  std::optional<HumanoidJoint> joint;
  MeshPoint place;        // on the skin, part -1 where there is none
  Vec3 position_ms{0.0};  // canonical pose: what to frame
};

/// Looks a calibration over. Holds what depends on the character alone, so that a check is quick
/// enough for every step of a drag.
class CalibrationChecker {
 public:
  /// Both must outlive the checker.
  CalibrationChecker(const Character& character, const SurfaceMesh& surface);
  ~CalibrationChecker();
  CalibrationChecker(CalibrationChecker&&) noexcept;

  /// Worst first; the same order for the same input.
  std::vector<CalibrationFinding> Check(const AvatarCalibration& calibration) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a person should look: any finding that is more than a note.
bool NeedsAPerson(const std::vector<CalibrationFinding>& findings);

}  // namespace ego
