// SPDX-License-Identifier: MIT
#include "app/stage/playhead.h"

#include <algorithm>
#include <cmath>

namespace ego {

void Playhead::Anchor(Time now) {
  anchor_ = now;
  anchor_frame_ = frame_;
  shown_ = 0;
}

void Playhead::SetLoop(bool loop, Time now) {
  Anchor(now);
  loop_ = loop;
}

void Playhead::SetMotion(std::size_t frame_count, double rate_hz, Time now) {
  frame_count_ = frame_count;
  rate_hz_ = rate_hz;
  frame_ = 0;
  Anchor(now);
}

void Playhead::Play(bool playing, Time now) {
  if (playing && !playing_ && !loop_ && frame_ + 1 >= frame_count_) frame_ = 0;
  playing_ = playing;
  Anchor(now);
}

void Playhead::Seek(std::size_t frame, Time now) {
  frame_ = frame_count_ == 0 ? 0 : std::min(frame, frame_count_ - 1);
  Anchor(now);
}

void Playhead::Step(std::ptrdiff_t frames, Time now) {
  playing_ = false;
  const auto last = static_cast<std::ptrdiff_t>(frame_count_) - 1;
  const auto target = static_cast<std::ptrdiff_t>(frame_) + frames;
  Seek(static_cast<std::size_t>(
           std::clamp(target, std::ptrdiff_t{0}, std::max(last, std::ptrdiff_t{0}))),
       now);
}

void Playhead::SetSpeed(double speed, Time now) {
  Anchor(now);
  speed_ = std::isfinite(speed) ? std::clamp(speed, kSlowest, kFastest) : 1.0;
}

bool Playhead::Advance(Time now) {
  if (!playing_ || frame_count_ == 0 || !(rate_hz_ > 0.0) || now < anchor_) return false;
  const double seconds = std::chrono::duration<double>(now - anchor_).count();
  // Half a microsecond of grace: a wake-up computed from NextDue must not fall short by rounding.
  const auto due = static_cast<std::uint64_t>((seconds + 0.5e-6) * rate_hz_ * speed_);
  if (due == shown_) return false;
  missed_ += due - shown_ - 1;
  shown_ = due;
  const std::uint64_t target = anchor_frame_ + due;
  if (loop_) {
    frame_ = static_cast<std::size_t>(target % frame_count_);
  } else {
    frame_ = static_cast<std::size_t>(std::min<std::uint64_t>(target, frame_count_ - 1));
    if (frame_ + 1 == frame_count_) playing_ = false;
  }
  return true;
}

std::optional<Playhead::Time> Playhead::NextDue() const {
  if (!playing_ || frame_count_ == 0 || !(rate_hz_ > 0.0)) return std::nullopt;
  const double seconds = static_cast<double>(shown_ + 1) / (rate_hz_ * speed_);
  return anchor_ + std::chrono::ceil<Time::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace ego
