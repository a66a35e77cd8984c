// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/takes/c3d.h"
#include "tests/support/take_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ego::test::CheckTake(ego::ParseC3d({data, size}, "fuzz.c3d"), "fuzz.c3d");
  return 0;
}
