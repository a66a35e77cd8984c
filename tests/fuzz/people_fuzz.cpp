// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/people/person_file.h"
#include "tests/support/script_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ego::test::CheckPeople(ego::ParsePeople(text, "fuzz.json"), "fuzz.json");
  return 0;
}
