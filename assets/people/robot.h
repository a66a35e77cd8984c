// SPDX-License-Identifier: MIT
#pragma once

#include "assets/people/person.h"

namespace ego {

/// A person of closed boxes, capsules and balls, each rigid on one joint.
Person MakeRobot(const PersonParameters& parameters);

}  // namespace ego
