// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/base/result.h"
#include "core/markers/marker_take.h"

namespace ego {

/// Reads the points of a C3D file: Intel, DEC and SGI number formats, integer and float storage;
/// analog channels are skipped, model outputs listed in `ignored`. Metres, Y up. See README.md of
/// this folder for how units, axes, frame counts and gaps are read.
/// Errors: not a C3D file, no points, parameters or frames that reach beyond the end of the file.
Result<MarkerTake> ReadC3d(const std::filesystem::path& path);

/// The same from memory. `name` stands for the file in messages; the take is called after it,
/// without folder and extension.
Result<MarkerTake> ParseC3d(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace ego
