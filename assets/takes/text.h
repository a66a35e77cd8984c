// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ego {

/// Text of a file as the program shows and writes it: valid UTF-8 is kept, anything else is read
/// as Latin-1; control characters and blanks at both ends go.
std::string CleanText(std::string_view raw);

/// The name of a take: the file's name without folder and extension.
std::string TakeName(std::string_view file);

/// The whole text as a number ("+1.5e3", " 7 "), also "nan" and "inf"; nothing when anything else
/// stands there. Independent of the locale.
std::optional<double> ReadNumber(std::string_view text);

/// True for equal texts whatever the case of ASCII letters.
bool SameWord(std::string_view a, std::string_view b);

/// A name or a word from a file, in quotes and shortened, for use in a message.
std::string Quoted(std::string_view text);

}  // namespace ego
