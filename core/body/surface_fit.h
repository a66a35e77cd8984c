// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// What FitSurfaceToMotion did. 1 means left as it was; left and right partners are equal.
struct SurfaceFit {
  /// Factor on each sample's horizontal distance from the middle of the trunk (head).
  std::array<double, kSampleCount> sample{};
  /// Factor on each capsule's radius.
  std::array<double, kSegmentCount> limb_radius{};
  /// Share of the frames in which an arm or hand lay more than 1 cm inside trunk, head or another
  /// limb, before and after.
  double deep_before = 0.0;
  double deep_after = 0.0;
};

/// Pulls a body's surface in to what a motion proves free: skin cannot lie inside skin, so where
/// arms and hands lie inside the trunk, the head or other limbs again and again, the surface there
/// is too wide. Never widens anything.
///
/// At most 300 frames, evenly spaced, are looked at. Of the arms, the lower half of the upper arm,
/// the forearm and the middle of the hand are probes with the capsule's (hand's) thickness. Where
/// probes sink in by more than 3 mm in at least 5 % of the frames, the samples around the deepest
/// places are moved towards the body's middle by the upper quartile of the depth, in a few rounds;
/// then capsules that still overlap get thinner. Both stop at 0.80 of what they were: more would
/// cost contacts that are real. Both sides are treated alike.
///
/// Nothing changes for an empty motion or one that proves nothing. Deterministic.
SurfaceFit FitSurfaceToMotion(Body& body, std::span<const Pose> poses);

}  // namespace ego
