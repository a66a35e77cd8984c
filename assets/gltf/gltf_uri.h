// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace ego {

/// The bytes of a base64 text (RFC 4648, either alphabet); other characters are skipped.
std::vector<std::uint8_t> Base64(std::string_view text);

/// Path of a file that a document names by URI: below the document's folder. Error: an absolute
/// path, a scheme, "..", or no folder.
Result<std::filesystem::path> PathBeside(const std::string& uri,
                                         const std::optional<std::filesystem::path>& folder);

}  // namespace ego
