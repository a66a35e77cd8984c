// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/avatar_calibration.h"
#include "core/model/character.h"

namespace ego {

/// Finds every point of a calibration on the mesh itself: rays from the skeleton in the canonical
/// pose, features of the silhouette, symmetry, and the template's proportions where the mesh says
/// nothing. Each point carries a confidence; the doubtful ones a reason. Deterministic; scaling
/// the character scales the result; mirroring it mirrors the result.
///
/// Fails only when the character has no skin to put points on, or when cancelled.
Result<AvatarCalibration> ProposeCalibration(const Character& character,
                                             const Progress& progress = {});

}  // namespace ego
