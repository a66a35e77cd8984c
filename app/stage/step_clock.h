// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "core/pipeline/stage_frame.h"

namespace ego {

/// Remembers how long a step took the last times, and sums that up. Allocates nothing.
class StepClock {
 public:
  using Clock = std::chrono::steady_clock;

  void Add(Clock::duration took);
  /// Median and 99th percentile of what is remembered; zero before the first `Add`.
  StepTime Summary() const;
  void Clear() { count_ = 0; }

 private:
  static constexpr std::size_t kRemembered = 256;
  std::array<float, kRemembered> micros_{};
  std::size_t count_ = 0;  // ever added since Clear
};

}  // namespace ego
