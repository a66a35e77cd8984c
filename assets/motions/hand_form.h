// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/skeleton/hand_shape.h"

namespace ego {

/// How a script says that a hand is held.
enum class HandForm : std::uint8_t {
  kRelaxed,
  kFlat,
  kLaid,  // flat, then each finger bends until it lies on the skin
  kFist,
  kPoint,
  kGrip,     // around a handle
  kTrigger,  // the same, the index finger along the trigger
};

inline constexpr std::array<std::string_view, 7> kHandForms = {"relaxed", "flat", "laid",   "fist",
                                                               "point",   "grip", "trigger"};

HandShape ShapeOf(HandForm form);

}  // namespace ego
