// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ego {

/// One buffer view of EXT_meshopt_compression, as its JSON says.
struct MeshoptView {
  std::size_t count = 0;
  std::size_t stride = 0;
  std::string_view mode;    // ATTRIBUTES, TRIANGLES or INDICES
  std::string_view filter;  // NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The decoded bytes (count * stride); nothing when the data or the description is malformed.
std::optional<std::vector<std::uint8_t>> DecodeMeshopt(const MeshoptView& view,
                                                       std::span<const std::uint8_t> data);

}  // namespace ego
