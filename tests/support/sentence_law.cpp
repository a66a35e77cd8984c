// SPDX-License-Identifier: MIT
#include "tests/support/sentence_law.h"

#include "core/base/check.h"

namespace ego::test {

void CheckSentence(std::string_view sentence, std::string_view file) {
  EGO_CHECK(sentence.starts_with(file));
  EGO_CHECK(sentence.size() > file.size() + 2 && sentence.size() < 1000);
  EGO_CHECK(sentence.find('\n') == std::string_view::npos);
}

}  // namespace ego::test
