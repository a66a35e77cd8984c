// SPDX-License-Identifier: MIT
#include "capture/playback/playback_source.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"

namespace ego {

PlaybackSource::PlaybackSource(std::shared_ptr<const MarkerTake> take) : take_(std::move(take)) {
  EGO_CHECK(take_ != nullptr);
}

Result<void> PlaybackSource::Open() {
  if (take_->frame_count == 0) return Error{take_->name + ": the take has no frames to play"};
  open_ = true;
  next_ = 0;
  return {};
}

MarkerSource::ReadState PlaybackSource::Read(std::chrono::microseconds /*patience*/,
                                             double& time_s, std::span<Vec3> position_ws,
                                             std::span<std::uint8_t> visible) {
  if (!open_) return ReadState::kLost;
  if (next_ >= take_->frame_count) return ReadState::kEnd;
  const MarkerFrame frame = take_->Frame(next_++);
  EGO_CHECK(position_ws.size() == frame.position_ws.size());
  EGO_CHECK(visible.size() == frame.visible.size());
  time_s = frame.time_s;
  std::copy(frame.position_ws.begin(), frame.position_ws.end(), position_ws.begin());
  std::copy(frame.visible.begin(), frame.visible.end(), visible.begin());
  return ReadState::kFrame;
}

void PlaybackSource::Close() { open_ = false; }

void PlaybackSource::Seek(std::size_t frame) { next_ = std::min(frame, take_->frame_count); }

}  // namespace ego
