// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/body/body.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A take after solving: the performer's body and one pose per frame. What every input ends as
/// (marker files through the solver, BVH directly, scripted motions), and what retargeting reads.
struct CapturedMotion {
  std::string name;
  Body performer;
  double rate_hz = 0.0;
  std::vector<Pose> poses;
  /// The markers it was solved from, for display; empty for skeleton motions. Same frames.
  std::shared_ptr<const MarkerTake> markers;
  /// Offset added to the markers' heights so that the floor lies at y = 0, metres.
  double floor_offset = 0.0;
};

}  // namespace ego
