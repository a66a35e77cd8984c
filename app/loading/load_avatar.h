// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/body/body.h"
#include "core/model/avatar_calibration.h"
#include "core/model/character.h"

namespace ego {

/// An avatar as the studio stages it: what is drawn and what the method works with.
struct LoadedAvatar {
  std::string name;
  std::filesystem::path path;                  // empty for the demo's cast
  std::shared_ptr<const Character> character;  // never null
  std::shared_ptr<const Body> body;            // never null
  CalibrationSummary calibration;              // all zero for bodies that are known exactly
  bool calibrated_by_file = false;             // else proposed from the mesh, or exact
  std::vector<std::string> notes;              // sentences worth showing
};

/// Reads a character and makes an avatar of it, with the calibration beside the file or else a
/// proposed one. Error: one sentence that names the file; "cancelled" when `progress` said so.
Result<LoadedAvatar> LoadAvatar(const std::filesystem::path& path, const Progress& progress = {});

/// How many avatars the demo's cast has, the performer not counted.
std::size_t DemoAvatarCount();
/// One of them, generated without a file.
LoadedAvatar LoadDemoAvatar(std::size_t index);

}  // namespace ego
