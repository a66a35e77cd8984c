// SPDX-License-Identifier: MIT
#pragma once

#include "core/adapt/adapt_state.h"

namespace ego {

/// Body folding (section 6.4, Algorithm 2): pitches the root so that elbows and wrists come nearer
/// to where the legs' segments want them, turns the head back and puts the feet back by leg IK.
///
/// The weighted mean of the rotations is taken as one Procrustes fit,
///   theta = atan2(sum lambda axis . (a x b), sum lambda a . b),
/// with a and b the achieved and desired positions about the root, which has no singularity where
/// a single pair lies near the lateral axis. It is bounded by the smaller forward flexion of the
/// hips, faded in between the settings' angles: none while standing. Returns whether the root
/// turned.
bool FoldBody(AdaptState& state);

}  // namespace ego
