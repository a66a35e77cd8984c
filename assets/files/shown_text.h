// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace ego {

/// Without blanks and zeros at both ends.
std::string_view Trimmed(std::string_view text);

/// Text of a file as the program shows and writes it: valid UTF-8 is kept, anything else is read
/// as Latin-1; control characters and blanks at both ends go.
std::string CleanText(std::string_view raw);

/// A name or a word from a file, in quotes and shortened to 40 bytes, for use in a message.
std::string Quoted(std::string_view text);

}  // namespace ego
