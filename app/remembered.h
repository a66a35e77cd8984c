// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/calibrate/workspace.h"
#include "app/panels/frame_layout.h"
#include "app/view/navigation.h"
#include "app/view/stage_picture.h"
#include "core/base/result.h"

namespace ego {

/// What the studio keeps from one session to the next: how its window is divided and what it shows.
struct Remembered {
  int window_width = 1600;
  int window_height = 900;
  FrameLayout layout;
  Overlays overlays;
  Navigation navigation = Navigation::kStudio;
  CalibrateHabits calibrate;
  std::vector<std::filesystem::path> recent;  // avatar files, newest first
};

/// Where it is kept: egostudio/window.json in $XDG_CONFIG_HOME, or in ~/.config where that is not
/// set. Empty when there is no such place.
std::filesystem::path RememberedPath();

/// Reads it; the defaults when there is no such file. Error: a damaged file, one sentence.
Result<Remembered> ReadRemembered(const std::filesystem::path& path);
/// Writes it, creating the folder.
Result<void> WriteRemembered(const std::filesystem::path& path, const Remembered& remembered);

}  // namespace ego
