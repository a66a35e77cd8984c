// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/takes/trc.h"
#include "tests/support/take_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ego::test::CheckTake(ego::ParseTrc({reinterpret_cast<const char*>(data), size}, "fuzz.trc"),
                       "fuzz.trc");
  return 0;
}
