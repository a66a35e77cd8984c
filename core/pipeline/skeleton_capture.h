// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/captured_motion.h"
#include "core/skeleton/joint_tree.h"

namespace ego {

/// A skeleton motion as a captured one: its joints mapped to the humanoid, its unit found, its
/// rest pose aligned to the canonical T-pose, every frame turned into joint angles and a root
/// path in metres, with a performer who has the motion's bone lengths and the template's surface,
/// fitted to what the motion proves free (core/body/surface_fit.h).
///
/// * Unit: the one of metre, centimetre, inch, millimetre and decimetre that gives the person a
///   height (from the legs) between 1.0 and 2.5 m, the nearest to 1.7 m; when none does, the
///   person is made 1.7 m tall.
/// * Rest pose: the zero rotation where it has the shape of a person, else the frame of the motion
///   that is nearest to a T-pose.
/// * Floor: the lowest 5 per cent of what the soles reach over the take (`floor_offset` is what was
///   added to the file's heights).
///
/// `notes`, when given, receives sentences for the user (guessed unit, missing joints).
/// Errors, one sentence without the file's name: no humanoid is found, the motion has no frames.
Result<CapturedMotion> CaptureFromJointMotion(const JointMotion& motion,
                                              std::vector<std::string>* notes = nullptr);

}  // namespace ego
