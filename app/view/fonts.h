// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace ego {

/// The studio's faces, as Debian's packages fonts-inter and fonts-jetbrains-mono install them.
enum class Face { kText, kTextStrong, kMono };

/// The bytes of a face's file; empty where it is not installed, so that a plain face stands in.
std::vector<std::uint8_t> ReadFace(Face face);

}  // namespace ego
