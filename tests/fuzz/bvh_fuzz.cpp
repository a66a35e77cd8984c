// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "assets/takes/bvh.h"
#include "core/pipeline/skeleton_capture.h"
#include "tests/support/take_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ego::Result<ego::JointMotion> motion =
      ego::ParseBvh({reinterpret_cast<const char*>(data), size}, "fuzz.bvh");
  ego::test::CheckMotion(motion, "fuzz.bvh");
  if (motion) ego::test::CheckCapture(ego::CaptureFromJointMotion(*motion), *motion);
  return 0;
}
