// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/avatar_calibration.h"
#include "core/model/character.h"

namespace ego {

/// Where the calibration of an avatar is kept: "knight.glb" -> "knight.glb.calib.json", beside it.
std::filesystem::path CalibrationPathFor(const std::filesystem::path& avatar);

/// A calibration with what the reader had to say about it.
struct LoadedCalibration {
  AvatarCalibration calibration;
  std::vector<std::string> warnings;  // sentences: mesh changed, points that moved far
  bool from_file = false;             // else proposed
};

/// Reads a calibration file (format: assets/calibration/README.md) for this character. When the
/// mesh is not the one it was made on, every point is carried over to the nearest place of the new
/// mesh, marked doubtful where it had to move far, and a warning says so.
Result<LoadedCalibration> ReadCalibration(const std::filesystem::path& path,
                                          const Character& character);
/// The same from memory; `name` is used in messages.
Result<LoadedCalibration> ParseCalibration(std::string_view json, const std::string& name,
                                           const Character& character);

/// Writes atomically: on an error (read-only folder, full disk) the old file stays as it was.
Result<void> WriteCalibration(const std::filesystem::path& path, const Character& character,
                              const AvatarCalibration& calibration);
/// The same as text.
std::string FormatCalibration(const Character& character, const AvatarCalibration& calibration);

/// The calibration beside the avatar's file when there is one, else a proposal. A file that cannot
/// be used is reported in the warnings and left alone, and a proposal takes its place. Writes
/// nothing.
Result<LoadedCalibration> LoadOrProposeCalibration(const Character& character,
                                                   const Progress& progress = {});

}  // namespace ego
