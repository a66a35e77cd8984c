// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/body/body.h"
#include "core/markers/marker_set.h"
#include "core/solve/skeleton_fit.h"

namespace ego {

/// The performer's body: the template's skin on the fitted skeleton, pulled to the markers, which
/// lie on the skin (paper, section 4.1): trunk and head samples follow nearby markers outward or
/// inward, limb radii the average marker distance from the bone compared with that of the same
/// places on the template, foot length the heel and toe markers. Left and right are made equal,
/// changes are bounded: a wrong surface does more harm than an average one.
Body PerformerBody(std::string name, const SkeletonFit& fit, const MarkerSet& set);

}  // namespace ego
