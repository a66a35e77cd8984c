// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace ego {

/// Long work reports through this and stops when it returns false (the caller then returns an
/// Error "cancelled"). `fraction` in [0, 1]; `what` is a short phrase ("fitting segment lengths").
/// Empty means nobody is listening.
using Progress = std::function<bool(double fraction, std::string_view what)>;

/// True when work may go on.
inline bool Report(const Progress& progress, double fraction, std::string_view what) {
  return !progress || progress(fraction, what);
}

}  // namespace ego
