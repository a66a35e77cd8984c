// SPDX-License-Identifier: MIT
#pragma once

#include "core/markers/marker_set.h"
#include "core/skeleton/humanoid.h"
#include "core/solve/bound_marker.h"

namespace ego {

/// How far a marker's skin may follow the bones beside its own.
struct SkinPrior {
  HumanoidJoint child = HumanoidJoint::kHips;  // the bone beyond that may draw it; hips: none
  SkinShares sigma{};                          // scale of the shares about zero; 0: rigid
};

/// What the place on the body tells: skin near a joint follows both of its bones, skin near the
/// root of a limb hardly follows its twist. Head, hands and feet carry their markers rigidly.
SkinPrior SkinPriorOf(const SetMarker& place);

}  // namespace ego
