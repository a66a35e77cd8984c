// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/character.h"

namespace ego {

/// The bytes of a PNG file with this picture; empty for an empty picture. Writing them to a file
/// is the caller's.
std::vector<std::uint8_t> EncodePng(const Image& image);

}  // namespace ego
