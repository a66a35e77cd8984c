// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"
#include "core/markers/marker_take.h"

namespace ego {

/// Reads a TRC table (Motion Analysis, OpenSim): empty cells and NaN are gaps, header values are
/// matched with their names in order whatever the tabs between them. Metres, Y up.
/// Errors: no "Frame#" line, no markers, a number that cannot be read, fewer rows than declared.
Result<MarkerTake> ReadTrc(const std::filesystem::path& path);

/// The same from memory. `name` stands for the file in messages; the take is called after it,
/// without folder and extension.
Result<MarkerTake> ParseTrc(std::string_view text, std::string_view name);

}  // namespace ego
