// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "assets/people/person.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// The 38 markers that a scripted performer wears, moving with the skin: always visible, without
/// noise. Same frames as the motion.
std::shared_ptr<const MarkerTake> MarkersOn(const Person& person, const CapturedMotion& motion);

}  // namespace ego
