// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/motions/motion_player.h"
#include "assets/motions/motion_script.h"
#include "assets/motions/true_contact.h"
#include "assets/people/person.h"
#include "core/base/result.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// The scripts that ship: the nine of the study first, in their order, then the others by name.
std::span<const MotionScript> ShippedMotions();

/// The shipped script of this name ("arms_crossed") or number in the study ("M7"), whatever the
/// case. Error: a sentence that lists the names there are.
Result<const MotionScript*> FindMotion(std::string_view name);

/// The performer of the scripted motions: DemoCast()[0], made once and kept.
const Person& ScriptedPerformer();
const MotionFigure& ScriptedFigure();

/// A scripted motion performed, with what is known about it.
struct ScriptedTake {
  CapturedMotion motion;  // 60 frames per second
  std::vector<TrueContact> contacts;
};

/// A script done by a figure. Shipped motions begin and end in the same stance, so that they can
/// follow one another and each can loop. Deterministic.
ScriptedTake Perform(const MotionFigure& figure, const MotionScript& script);

/// A script done by the scripted performer, with the markers the performer wears.
ScriptedTake PerformWithMarkers(const MotionScript& script);

/// The same for a shipped script. Error: see FindMotion.
Result<ScriptedTake> PerformShipped(std::string_view name);

/// The demo: the shipped motions that show contacts best, one after the other; loops without a
/// seam.
MotionScript DemoScript();
ScriptedTake PerformDemo();

}  // namespace ego
