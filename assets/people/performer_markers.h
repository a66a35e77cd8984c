// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "assets/people/person.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// The markers that a scripted performer wears, moving with the skin: always visible, without
/// noise. Labels and places are those of the studio's own set (assets/data/marker_sets/
/// studio_38.json). Same frames as the motion.
std::shared_ptr<const MarkerTake> MarkersOn(const Person& person, const CapturedMotion& motion);

}  // namespace ego
