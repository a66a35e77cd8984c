// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/model/character.h"

namespace ego {

/// The picture in a PNG, JPEG or (still) WebP file as RGBA. Nothing when it is another format,
/// damaged, or has more than `max_pixels`: the size is read from the header first, because a few
/// bytes must not make a decoder ask for gigabytes.
std::optional<Image> DecodeImage(std::span<const std::uint8_t> bytes, std::size_t max_pixels);

}  // namespace ego
