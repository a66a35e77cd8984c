// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <string_view>

#include "core/base/progress.h"

namespace ego {

/// Says on stderr what went wrong, as one line, and gives the exit code for it.
int Fail(std::string_view sentence);

/// Prints sentences worth knowing on stderr, one line each, after the name of what they are about.
void PrintNotes(std::string_view about, std::span<const std::string> notes);

/// Progress of long work on stderr: one line that is written over and over on a terminal, one
/// line every few seconds where stderr is a file or a pipe. Quick work prints nothing.
class ProgressLine {
 public:
  /// `subject` begins each line ("solving walk.c3d").
  explicit ProgressLine(std::string subject);
  /// Leaves a terminal's line empty.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void Show(double fraction, std::string_view what);
  /// To hand to long work; refers to this object.
  Progress AsProgress();

 private:
  using Clock = std::chrono::steady_clock;
  std::string subject_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace ego
