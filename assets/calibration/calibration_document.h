// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/avatar_calibration.h"
#include "core/model/character.h"

namespace ego {

/// An avatar opened for calibration or for the stage: the character with the joint map that its
/// calibration mends, and the calibration.
struct CalibrationDocument {
  std::filesystem::path avatar;  // empty for generated characters
  std::filesystem::path path;    // of the calibration; need not exist yet
  /// As read, joints mapped by the studio alone: what overrides are applied to.
  std::shared_ptr<const Character> as_read;
  /// With the overrides of the calibration; the same object where there are none.
  std::shared_ptr<const Character> character;
  AvatarCalibration calibration;
  /// What the studio would propose; what ResetToProposal goes back to.
  AvatarCalibration proposal;
  bool from_file = false;  // else proposed
  /// There is a calibration file that could not be used: a save puts it aside first.
  bool damaged = false;
  std::vector<std::string> warnings;
};

/// Reads an avatar and the calibration beside it, or proposes one. A calibration file that cannot
/// be used is left alone and reported in the warnings, and a proposal takes its place.
Result<CalibrationDocument> OpenCalibration(const std::filesystem::path& avatar,
                                            const Progress& progress = {});
/// The same for a character that is in memory already.
Result<CalibrationDocument> OpenCalibration(Character character, const Progress& progress = {});

/// The same for the stage, which never goes back to a proposal: `proposal` is the calibration.
Result<CalibrationDocument> LoadCalibrated(Character character, const Progress& progress = {});

}  // namespace ego
