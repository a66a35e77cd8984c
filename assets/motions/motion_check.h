// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "assets/motions/motion_player.h"
#include "assets/motions/motion_script.h"
#include "assets/motions/skin_measure.h"

namespace ego {

/// How far a contact is from being one.
struct ContactGap {
  double mean_abs = 0.0;   // metres: the face's distance to the nearest skin, inside or outside
  double widest = 0.0;     // metres: largest distance outside
  double deepest = 0.0;    // metres: largest distance inside
  double off_place = 0.0;  // metres: mean distance from the place that is meant
  std::size_t samples = 0;
};

/// Adds one instant of a contact on a posed figure. `probe` holds the pose `model`.
void MeasureContact(const MotionFigure& figure, const TrueContact& contact, double time,
                    const ModelPose& model, const SkinMeasure& probe, ContactGap& gap);

/// What is wrong with a scripted motion on one figure.
struct MotionCheck {
  SkinMeasure::Sinking sinking;
  double sinking_at_s = 0.0;
  std::vector<ContactGap> contacts;  // one for each contact of the player
  double largest_speed = 0.0;        // degrees per second, any joint's own rotation
  double largest_speed_at_s = 0.0;
  double largest_acceleration = 0.0;  // degrees per second squared
  double largest_acceleration_at_s = 0.0;
  double largest_wrist = 0.0;  // degrees, hand bent from the forearm
  double largest_wrist_at_s = 0.0;
};

/// Looks at a motion every `step_s` seconds; contacts at both ends too; speeds at 60 Hz.
MotionCheck CheckMotion(const MotionFigure& figure, const MotionScript& script, double step_s);

}  // namespace ego
