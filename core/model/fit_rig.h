// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/model/character.h"

namespace ego {

/// Aligns the rest pose of a character whose nodes, mesh and map are known and fits its rig: soles
/// level and on the ground. How the file's unit is read follows from the body's height (with a
/// note on the character when it is not one metre) unless it is given. Error: the rest pose has no
/// shape.
Result<void> FitRig(Character& character, std::optional<double> metres_per_unit = {});

}  // namespace ego
