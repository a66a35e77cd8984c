// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/model/character.h"

namespace ego::test {

/// What holds for whatever a reader makes of any bytes: either one sentence that names the file,
/// or a character whose indices are in range, whose numbers are finite, and whose nodes can be
/// posed. Ends the program when not: for fuzzers and for the replay of their corpora.
void CheckCharacter(const Result<Character>& character, std::string_view file);

}  // namespace ego::test
