// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/markers/marker_take.h"
#include "core/pipeline/captured_motion.h"
#include "core/skeleton/joint_tree.h"

namespace ego::test {

/// What holds for whatever a reader makes of any bytes: either one sentence that names the file,
/// or a take whose arrays fit together and whose numbers are finite. Ends the program when not:
/// for fuzzers and for the replay of their corpora.
void CheckTake(const Result<MarkerTake>& take, std::string_view file);
void CheckMotion(const Result<JointMotion>& motion, std::string_view file);
/// The same for what becomes of a motion that was read: a sentence, or poses that are finite.
void CheckCapture(const Result<CapturedMotion>& captured, const JointMotion& motion);

}  // namespace ego::test
