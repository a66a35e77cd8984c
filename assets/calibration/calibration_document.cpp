// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_document.h"

#include <algorithm>
#include <utility>

#include "assets/calibration/calibration_file.h"
#include "assets/calibration/propose_calibration.h"
#include "assets/gltf/character_file.h"

namespace ego {
namespace {

/// The part [from, to] of a longer piece of work.
Progress Part(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double fraction, std::string_view what) {
    return whole(from + (to - from) * fraction, what);
  };
}

Result<CalibrationDocument> Open(Character read, const Progress& progress, bool with_proposal) {
  CalibrationDocument document;
  document.avatar = read.source_path;
  if (!read.source_path.empty()) document.path = CalibrationPathFor(read.source_path);
  document.as_read = std::make_shared<const Character>(std::move(read));
  document.character = document.as_read;

  Result<LoadedCalibration> loaded =
      LoadOrProposeCalibration(*document.as_read, Part(progress, 0.0, 0.6));
  if (!loaded) return Error{loaded.error()};
  document.calibration = std::move(loaded->calibration);
  document.from_file = loaded->from_file;
  document.damaged = !loaded->from_file && !loaded->warnings.empty();
  document.warnings = std::move(loaded->warnings);
  const JointOverrides& overrides = document.calibration.joint_override;
  if (std::any_of(overrides.begin(), overrides.end(),
                  [](const auto& o) { return o.has_value(); })) {
    Result<Character> mended = WithJointOverrides(*document.as_read, overrides);
    if (!mended) return Error{mended.error()};
    document.character = std::make_shared<const Character>(*std::move(mended));
  }
  if (!with_proposal || !document.from_file) {
    document.proposal = document.calibration;
    return document;
  }
  Result<AvatarCalibration> proposal =
      ProposeCalibration(*document.character, Part(progress, 0.6, 1.0));
  if (!proposal) return Error{proposal.error()};
  document.proposal = *std::move(proposal);
  document.proposal.joint_override = overrides;
  return document;
}

}  // namespace

Result<CalibrationDocument> OpenCalibration(const std::filesystem::path& avatar,
                                            const Progress& progress) {
  Result<Character> character = ReadCharacter(avatar, Part(progress, 0.0, 0.4));
  if (!character) return Error{character.error()};
  return Open(*std::move(character), Part(progress, 0.4, 1.0), true);
}

Result<CalibrationDocument> OpenCalibration(Character character, const Progress& progress) {
  return Open(std::move(character), progress, true);
}

Result<CalibrationDocument> LoadCalibrated(Character character, const Progress& progress) {
  return Open(std::move(character), progress, false);
}

}  // namespace ego
