// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "capture/marker_source.h"

namespace ego {

/// Plays a recorded take as if a device sent it, as fast as it is read; the caller keeps time.
class PlaybackSource : public MarkerSource {
 public:
  explicit PlaybackSource(std::shared_ptr<const MarkerTake> take);

  const std::string& name() const override { return take_->name; }
  const std::vector<std::string>& labels() const override { return take_->labels; }
  double rate_hz() const override { return take_->rate_hz; }

  Result<void> Open() override;
  ReadState Read(std::chrono::microseconds patience, double& time_s, std::span<Vec3> position_ws,
                 std::span<std::uint8_t> visible) override;
  void Close() override;

  /// The frame that the next Read gives; clamped to the take.
  void Seek(std::size_t frame);

 private:
  std::shared_ptr<const MarkerTake> take_;
  std::size_t next_ = 0;
  bool open_ = false;
};

}  // namespace ego
