// SPDX-License-Identifier: MIT
#include "app/program.h"

#include <CLI/CLI.hpp>

namespace ego {

int RunProgram(int argc, char** argv) {
  CLI::App program{"Egostudio: live retargeting that keeps self-contacts", "egostudio"};
  program.set_version_flag("--version", "egostudio 0.1.0");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  return 0;
}

}  // namespace ego
