// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/markers/marker_take.h"
#include "core/solve/marker_predictor.h"

namespace ego {

/// A take whose lost markers were told from others, as far as these tell.
class FilledTake {
 public:
  /// What a predictor is off by changes slowly: in a gap it lies between what it is at both ends,
  /// as an Ornstein-Uhlenbeck process does between two known values (Rasmussen and Williams, 2006,
  /// appendix B). So the filled way joins those seen, and is the less sure the farther from them.
  FilledTake(const MarkerTake& take, std::span<const MarkerPredictor> predictors);

  MarkerFrame Frame(std::size_t index) const;

 private:
  const MarkerTake& take_;
  std::vector<Vec3> position_ws_;
  std::vector<std::uint8_t> visible_;
  std::vector<double> told_sigma_;
};

}  // namespace ego
