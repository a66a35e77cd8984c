// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/joint_tree.h"

namespace ego::test {

/// What holds for whatever a reader makes of any bytes: either one sentence that names the file,
/// or a take whose arrays fit together and whose numbers are finite. Ends the program when not:
/// for fuzzers and for the replay of their corpora.
void CheckTake(const Result<MarkerTake>& take, std::string_view file);
void CheckMotion(const Result<JointMotion>& motion, std::string_view file);

}  // namespace ego::test
