// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// How far a surface was pulled in; 1 means left as it was.
struct SurfaceFit {
  double trunk_width = 1.0;  // factor on the trunk samples' |x|
  double head_width = 1.0;   // factor on the head samples' |x|
  std::array<double, kSegmentCount> limb_radius = AllOnes();

 private:
  static constexpr std::array<double, kSegmentCount> AllOnes() {
    std::array<double, kSegmentCount> all{};
    for (double& one : all) one = 1.0;
    return all;
  }
};

/// Shrinks a body's surface to what a motion proves free: skin cannot lie inside skin.
SurfaceFit FitSurfaceToMotion(Body& body, std::span<const Pose> poses);

}  // namespace ego
