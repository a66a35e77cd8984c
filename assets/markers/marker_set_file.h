// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/markers/marker_set.h"

namespace ego {

/// Reads a marker set from JSON; the format is described in assets/data/README.md. Errors name
/// the file, the marker and what was expected of it.
Result<MarkerSet> ReadMarkerSet(const std::filesystem::path& path);
/// The same from memory; `name` stands for the file in errors.
Result<MarkerSet> ParseMarkerSet(std::string_view text, std::string_view name);
/// The JSON that reads back as this set.
std::string FormatMarkerSet(const MarkerSet& set);

/// The sets that ship, built into the program.
std::span<const MarkerSet> ShippedMarkerSets();
/// The shipped set that fits these labels best, see core/markers/marker_set.h.
Result<MarkerSet> ChooseMarkerSet(std::span<const std::string> labels);

}  // namespace ego
