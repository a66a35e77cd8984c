// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace ego {

/// Hands the newest of a stream of values from one thread to one other without locks: neither
/// side ever waits, and values that nobody fetched in time are overwritten.
///
/// Three buffers: one belongs to the writer, one to the reader, one is in between. Buffers are
/// reused, never reallocated here: a value with vectors in it keeps their capacity, so a writer
/// that fills `Back()` in place allocates nothing once all three buffers have been through. What
/// `Back()` holds before it is filled is some older value.
template <class T>
class LatestValue {
 public:
  LatestValue() = default;
  /// All three buffers start as copies of `initial`; nothing counts as published.
  explicit LatestValue(const T& initial) : buffers_{initial, initial, initial} {}
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer only: the buffer to fill. The reader does not see it until `Publish`.
  T& Back() { return buffers_[back_]; }

  /// Writer only: makes the filled buffer the newest value; `Back()` is another buffer afterwards.
  void Publish() {
    const std::uint8_t fresh = static_cast<std::uint8_t>(back_ | kFresh);
    back_ = between_.exchange(fresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader only: takes the newest value, if there is one since the last call. True when
  /// `Front()` changed.
  bool Fetch() {
    if (!(between_.load(std::memory_order_relaxed) & kFresh)) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader only: the value of the last successful `Fetch`; stays the same until the next.
  const T& Front() const { return buffers_[front_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<T, 3> buffers_{};
  alignas(64) std::atomic<std::uint8_t> between_{1};
  alignas(64) std::uint8_t back_ = 0;
  alignas(64) std::uint8_t front_ = 2;
};

}  // namespace ego
