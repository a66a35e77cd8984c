// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/gltf/character_file.h"
#include "tests/support/character_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ego::test::CheckCharacter(ego::ParseCharacter({data, size}, "fuzz.glb"), "fuzz.glb");
  return 0;
}
