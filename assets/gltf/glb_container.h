// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace ego {

/// The parts of a glTF file; they refer to its bytes.
struct GltfChunks {
  std::string_view json;
  std::span<const std::uint8_t> bin;
  bool has_bin = false;
};

/// Takes a GLB apart (glTF 2.0, section 4.4); a text that begins like JSON is all JSON. Error, as a
/// sentence without the file's name: neither, another version, truncated.
Result<GltfChunks> SplitGlb(std::span<const std::uint8_t> bytes);

/// One GLB from JSON text and binary buffer.
std::vector<std::uint8_t> PackGlb(std::string_view json, std::span<const std::uint8_t> bin);

}  // namespace ego
