// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "assets/people/person.h"
#include "core/base/result.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// The performer of the scripted motions: DemoCast()[0], made once and kept.
const Person& ScriptedPerformer();

/// Motions that ScriptedMotion knows.
std::vector<std::string_view> ScriptedMotionNames();

/// A motion of the scripted performer at 60 frames per second, contacts placed on the performer's
/// own skin, with the markers the performer wears. Begins and ends in the same relaxed stance, so
/// that motions can follow one another and each can loop. Deterministic. Takes a second or two when
/// it is the first one, since the performer is made then.
Result<CapturedMotion> ScriptedMotion(std::string_view name);

/// The demo: all motions one after the other, 30 to 40 seconds, loops without a seam.
CapturedMotion DemoMotion();

}  // namespace ego
