// SPDX-License-Identifier: MIT
#include "core/geometry/lanes.h"

namespace ego {

LaneWidth FastestLanes() {
#if defined(__x86_64__)
  static const bool kHasFour = __builtin_cpu_supports("avx2") != 0;
  return kHasFour ? LaneWidth::kFour : LaneWidth::kTwo;
#else
  return LaneWidth::kTwo;
#endif
}

}  // namespace ego
