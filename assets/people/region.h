// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace ego {

/// The materials a person's surface is divided into.
enum class Region : std::uint8_t {
  kSkin,
  kShirt,
  kTrim,  // collar and cuffs
  kTrousers,
  kShoes,
  kSoles,
  kHair,
  kLips,
  kEyeWhite,
  kIris,
  kPupil,
  kLashes,  // the edge of the upper lid
};
inline constexpr std::size_t kRegionCount = 12;

constexpr bool IsEye(Region region) {
  return region == Region::kEyeWhite || region == Region::kIris || region == Region::kPupil;
}

}  // namespace ego
