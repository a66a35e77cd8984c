// SPDX-License-Identifier: MIT
#pragma once

namespace ego {

/// The whole program: parses the command line, runs a verb or the studio. Returns the exit code:
/// 0 on success, 1 when the work failed (one sentence on stderr says why), 2 for wrong arguments.
int RunProgram(int argc, char** argv);

}  // namespace ego
