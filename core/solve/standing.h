// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/body/body.h"
#include "core/skeleton/pose.h"
#include "core/solve/pose_solver.h"

namespace ego {

/// Turns each foot's frame so that its sole is level on average while the foot stands (slow and
/// near the lowest place it ever is): heel and toe markers alone leave its pitch and roll open to
/// some degrees. Changes the foot's marker offsets and rotations together, so no marker moves. A
/// foot that never stands is left alone.
void LevelSoles(MarkerModel& model, std::span<Pose> poses, double rate_hz);

/// Height of the ground that standing feet stand on, world space, metres: where the soles' lowest
/// points stay most often while they are slow. Real takes are off by some centimetres either way.
/// Without a standing foot, the lowest twentieth of what the soles reach. 0 without poses.
double GroundHeight(const Body& performer, std::span<const Pose> poses, double rate_hz);

}  // namespace ego
