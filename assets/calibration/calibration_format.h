// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace ego {

/// What reader and writer of calibration files agree on.
inline constexpr std::string_view kCalibrationFormat = "egostudio avatar calibration";
inline constexpr int kCalibrationVersion = 2;
inline constexpr std::array<std::string_view, 4> kHandAndFootKeys = {"leftHand", "rightHand",
                                                                     "leftFoot", "rightFoot"};
/// 16 hexadecimal digits.
std::string HashText(std::uint64_t value);

}  // namespace ego
