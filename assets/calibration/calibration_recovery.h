// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "assets/calibration/calibration_file.h"

namespace ego {

/// What an interrupted session left behind for one avatar.
struct Recovery {
  std::filesystem::path path;    // of the recovery file
  std::filesystem::path avatar;  // that it belongs to
  std::filesystem::file_time_type written;
  std::size_t picked = 0;  // points that a person picked or confirmed, to offer them by number
};

/// Where recovery files are kept: egostudio/recovery in $XDG_STATE_HOME, or in ~/.local/state
/// where that is not set; empty when there is no such place.
std::filesystem::path RecoveryFolder();

/// Keeps the state of an edit; atomically, so that a kill in the middle leaves the one before.
/// `folder` is created. One file for each avatar, named after its absolute path.
Result<void> WriteRecovery(const std::filesystem::path& folder, const std::filesystem::path& avatar,
                           const Character& character, const AvatarCalibration& calibration);
/// The file that was left for this avatar, if any; damaged ones are passed over.
std::optional<Recovery> FindRecovery(const std::filesystem::path& folder,
                                     const std::filesystem::path& avatar);
/// All that are left, newest first, for a start page.
std::vector<Recovery> FindRecoveries(const std::filesystem::path& folder);
/// The picks. A changed mesh is met as in ReadCalibration.
Result<LoadedCalibration> ReadRecovery(const Recovery& recovery, const Character& character);
/// Removes it: after a save, or when the person declines it.
void DiscardRecovery(const std::filesystem::path& folder, const std::filesystem::path& avatar);

}  // namespace ego
