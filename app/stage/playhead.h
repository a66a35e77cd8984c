// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ego {

/// Which frame of a motion is due at which time. The time is given, never asked for, so that
/// playing can be tested without waiting.
class Playhead {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr double kSlowest = 0.1;
  static constexpr double kFastest = 4.0;

  /// Another motion; goes to the first frame and keeps playing as before.
  void SetMotion(std::size_t frame_count, double rate_hz, Time now);
  void Play(bool playing, Time now);
  void Seek(std::size_t frame, Time now);
  void Step(std::ptrdiff_t frames, Time now);
  void SetSpeed(double speed, Time now);
  void SetLoop(bool loop, Time now);

  /// Moves to the frame that is due. Stops at the end of a motion that does not loop. True when
  /// the frame or the state changed.
  bool Advance(Time now);

  std::size_t frame() const { return frame_; }
  bool playing() const { return playing_; }
  double speed() const { return speed_; }
  bool loop() const { return loop_; }
  /// Frames that were due between two calls of Advance and never shown.
  std::uint64_t missed() const { return missed_; }
  /// When the next frame is due; nothing when it never is.
  std::optional<Time> NextDue() const;

 private:
  void Anchor(Time now);

  std::size_t frame_count_ = 0;
  double rate_hz_ = 0.0;
  double speed_ = 1.0;
  bool playing_ = false;
  bool loop_ = true;
  std::size_t frame_ = 0;
  std::uint64_t missed_ = 0;
  // Playing counts from the last command, so that rounding never adds up.
  Time anchor_{};
  std::size_t anchor_frame_ = 0;
  std::uint64_t shown_ = 0;  // frames that were due between the anchor and `frame_`
};

}  // namespace ego
