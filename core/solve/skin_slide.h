// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/markers/marker_take.h"
#include "core/solve/bundle.h"
#include "core/solve/posture.h"

namespace ego {

/// Estimates how the bundle's markers slide over their bones from postures already solved, one
/// marker at a time: a robust ridge regression of its error on the turns of the joints beside it,
/// along with its place. Markers whose skin shares are held at zero stay rigid. `frames` and
/// `postures` correspond and need not be the bundle's own. The prior is a Cauchy one, so that what
/// hardly slides stays rigid and what slides far is not held back.
void FitSlides(std::span<const MarkerFrame> frames, std::span<const Posture> postures,
               Bundle& bundle);

}  // namespace ego
