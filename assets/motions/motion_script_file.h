// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "assets/motions/motion_script.h"
#include "core/base/result.h"

namespace ego {

/// Reads a motion script (format: README of this folder). `file` names it in errors: one sentence
/// that names the file, the key and what was expected. Work and result are bounded whatever the
/// text says.
Result<MotionScript> ParseMotionScript(std::string_view json, std::string_view file);
Result<MotionScript> ReadMotionScript(const std::filesystem::path& path);

}  // namespace ego
