// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/math.h"

namespace ego {

/// The optical points of one instant, in the order of the take's labels. World space, metres, Y
/// up. A point that is not visible has an unspecified, finite position.
struct MarkerFrame {
  double time_s = 0.0;
  std::span<const Vec3> position_ws;
  std::span<const std::uint8_t> visible;  // 0 or 1
  /// How far a point that was told from others may be off, one axis, metres; 0: it was seen. Empty
  /// where all were.
  std::span<const double> told_sigma = {};
};

/// A recording of labelled markers, as a reader hands it over: converted to metres and Y up,
/// impossible values (NaN, infinite, beyond 1 km) made not visible.
struct MarkerTake {
  std::string name;                  // file name without folder and extension
  std::vector<std::string> labels;   // as in the file; markers only, no model outputs
  std::vector<std::string> ignored;  // labels of points that are no markers (model outputs)
  double rate_hz = 0.0;
  std::size_t frame_count = 0;
  std::vector<Vec3> position_ws;      // frame_count * labels.size(), frame after frame
  std::vector<std::uint8_t> visible;  // same shape
  std::vector<std::string> warnings;  // sentences worth showing ("units \"238\" read as mm")

  MarkerFrame Frame(std::size_t index) const {
    const std::size_t n = labels.size();
    return {static_cast<double>(index) / rate_hz, std::span(position_ws).subspan(index * n, n),
            std::span(visible).subspan(index * n, n)};
  }
};

}  // namespace ego
