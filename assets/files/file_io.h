// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace ego {

/// Largest file any reader takes, bytes. Bigger ones are refused before a byte is read.
inline constexpr std::uintmax_t kMaxFileSize = std::uintmax_t{1} << 31;

/// The whole file. Errors name the file and the reason (absent, a folder, unreadable, too large).
Result<std::vector<std::uint8_t>> ReadFile(const std::filesystem::path& path);
Result<std::string> ReadTextFile(const std::filesystem::path& path);

/// Writes beside the target, flushes to the disk and renames over it: the old file stays whole
/// until the new one is. On an error (read-only folder, disk full) the old file is untouched.
Result<void> WriteFileAtomically(const std::filesystem::path& path,
                                 std::span<const std::uint8_t> bytes);
Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace ego
