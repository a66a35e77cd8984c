// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ego {

/// The name of a take: the file's name without folder and extension.
std::string TakeName(std::string_view file);

/// The whole text as a number ("+1.5e3", " 7 "), also "nan" and "inf"; nothing when anything else
/// stands there. Independent of the locale.
std::optional<double> ReadNumber(std::string_view text);

/// True for equal texts whatever the case of ASCII letters.
bool SameWord(std::string_view a, std::string_view b);

}  // namespace ego
