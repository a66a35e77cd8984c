// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/loading/load_avatar.h"
#include "app/loading/load_take.h"
#include "core/metrics/retarget_score.h"
#include "core/pipeline/stage_frame.h"

namespace ego {

/// What `egostudio solve --report` writes, as JSON. Residuals are absent for takes that came as a
/// skeleton.
std::string FormatSolveReport(const LoadedTake& take);

/// One avatar of a retarget report.
struct AvatarOutcome {
  const LoadedAvatar* avatar = nullptr;
  std::string file;     // written; empty when none
  RetargetScore score;  // of the chosen method
  RetargetScore copy;   // of joint angles alone, same frames
  StepTime adapt;       // one avatar, one frame
};

/// What `egostudio retarget --report` writes, as JSON: lengths in percent of height, steps in
/// degrees, times in microseconds.
std::string FormatRetargetReport(const LoadedTake& take, std::string_view method,
                                 const StepTime& normalize,
                                 const std::vector<AvatarOutcome>& outcomes);

}  // namespace ego
