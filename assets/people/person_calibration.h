// SPDX-License-Identifier: MIT
#pragma once

#include "assets/people/person.h"
#include "core/model/avatar_calibration.h"

namespace ego {

/// What is known exactly of a generated person, as the calibration that is kept beside a
/// character's file: every point is picked, on the triangle where the person was measured; the
/// radii are given as they are. MakeAvatarBody makes `person.body` of it again.
AvatarCalibration CalibrationOf(const Person& person);

}  // namespace ego
