// SPDX-License-Identifier: MIT
#include "app/stage/step_clock.h"

#include <algorithm>

namespace ego {

void StepClock::Add(Clock::duration took) {
  micros_[count_++ % kRemembered] = std::chrono::duration<float, std::micro>(took).count();
}

StepTime StepClock::Summary() const {
  const std::size_t n = std::min(count_, kRemembered);
  if (n == 0) return {};
  std::array<float, kRemembered> sorted = micros_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(n);
  std::sort(sorted.begin(), end);
  return {sorted[n / 2], sorted[std::min(n - 1, n * 99 / 100)]};
}

}  // namespace ego
