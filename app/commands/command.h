// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace ego {

/// Exit codes of every verb.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;            // the work failed; one sentence on stderr says why
inline constexpr int kWrongArguments = 2;    // the command line makes no sense
inline constexpr int kPersonShouldLook = 3;  // calibrate: done, but with doubts

/// A verb of the program, for example `egostudio solve`: its own command line and what it does
/// once that is parsed. `run` returns an exit code.
struct Command {
  CLI::App* line = nullptr;
  std::function<int()> run;
};

Command AddRetargetCommand(CLI::App& program);
Command AddSolveCommand(CLI::App& program);
Command AddRenderCommand(CLI::App& program);
Command AddPeopleCommand(CLI::App& program);
Command AddCalibrateCommand(CLI::App& program);
Command AddMotionsCommand(CLI::App& program);

/// All verbs, in the order in which --help lists them.
std::vector<Command> AddCommands(CLI::App& program);

}  // namespace ego
