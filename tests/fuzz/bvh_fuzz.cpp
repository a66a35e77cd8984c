// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/takes/bvh.h"
#include "tests/support/take_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ego::test::CheckMotion(ego::ParseBvh({reinterpret_cast<const char*>(data), size}, "fuzz.bvh"),
                         "fuzz.bvh");
  return 0;
}
