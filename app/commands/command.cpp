// SPDX-License-Identifier: MIT
#include "app/commands/command.h"

namespace ego {

std::vector<Command> AddCommands(CLI::App& program) {
  return {AddRetargetCommand(program), AddSolveCommand(program), AddRenderCommand(program),
          AddCalibrateCommand(program), AddPeopleCommand(program), AddMotionsCommand(program)};
}

}  // namespace ego
