// SPDX-License-Identifier: MIT
#pragma once

#include "core/body/body.h"
#include "core/model/avatar_calibration.h"
#include "core/model/character.h"

namespace ego {

/// The avatar as the method sees it: the character's skeleton with the surface that its
/// calibration marks. Samples are attached by the mesh's own skin weights, so that the crude
/// surface moves exactly as the drawn skin does. Places that are missing come from the template
/// fitted to the skeleton (BodyFromSkeleton). The points must be on the character (IsOn); those
/// that are not count as missing.
///
/// `height` is the height of the crown sample, or of the whole mesh where that is unknown.
Body MakeAvatarBody(const Character& character, const AvatarCalibration& calibration);
/// The same, with TemplateBodyOf(character) made before: for every step of an edit.
Body MakeAvatarBody(const Character& character, const AvatarCalibration& calibration,
                    const Body& template_body);

/// The template on the character's skeleton, for comparison and as the last resort. Its height is
/// judged from the head's skin, bounded by what is plausible above the head joint.
Body TemplateBodyOf(const Character& character);

}  // namespace ego
