// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

#include "app/studio.h"

namespace ego::test {

/// Whether a program is on the path.
bool Installed(const char* program);

/// An X server of the test's own, on a display number that the server finds free; $DISPLAY names
/// it until the end.
class VirtualDisplay {
 public:
  VirtualDisplay(int width, int height);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  bool ready() const { return ready_; }

 private:
  pid_t server_ = -1;
  bool ready_ = false;
};

/// Real events, by xdotool. Returns when they are with the server; the studio has not polled in
/// between.
void Do(const std::string& actions);

/// Runs frames until it is so; false after a minute.
bool RunUntil(Studio& studio, const std::function<bool()>& wanted);

}  // namespace ego::test
