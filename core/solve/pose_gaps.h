// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/skeleton/pose.h"
#include "core/solve/pose_solver.h"

namespace ego {

/// Per frame and joint, whether anything of the joint or of what hangs on it was seen:
/// frame after frame, kJointCount entries each.
std::vector<std::uint8_t> ObservedJoints(const MarkerModel& model, const MarkerTake& take);

/// Replaces what was not seen by what lies between the neighbours that were: the rotations of
/// joints without markers, and all of a frame that was not solved. Turns take the shorter way,
/// the root a straight line; before the first and after the last the neighbour is held. A joint
/// that is never observed is left alone. All spans have one entry per frame (`observed`
/// kJointCount).
void FillGaps(std::span<const std::uint8_t> observed, std::span<const std::uint8_t> solved,
              std::span<Pose> poses);

}  // namespace ego
