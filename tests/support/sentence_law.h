// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace ego::test {

/// What holds for every sentence about a bad file: one line that begins with the file's name and
/// can be read at a glance. Ends the program where it does not hold.
void CheckSentence(std::string_view sentence, std::string_view file);

}  // namespace ego::test
