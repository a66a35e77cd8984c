// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/markers/marker_take.h"

namespace ego {

/// Where marker frames come from: a device, a recording, a network stream. Owns no thread: the
/// caller pumps it, so tests and batch runs need none.
class MarkerSource {
 public:
  virtual ~MarkerSource() = default;
  virtual const std::string& name() const = 0;
  virtual const std::vector<std::string>& labels() const = 0;
  virtual double rate_hz() const = 0;

  virtual Result<void> Open() = 0;
  enum class ReadState { kFrame, kNothingYet, kEnd, kLost };
  /// Waits at most `patience` for the next frame and writes it to the caller's buffers, which
  /// have one entry per label. Allocates nothing.
  virtual ReadState Read(std::chrono::microseconds patience, double& time_s,
                         std::span<Vec3> position_ws, std::span<std::uint8_t> visible) = 0;
  virtual void Close() = 0;
};

}  // namespace ego
