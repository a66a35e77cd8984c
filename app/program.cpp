// SPDX-License-Identifier: MIT
#include "app/program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/command.h"
#include "app/commands/terminal.h"
#include "app/studio.h"
#include "assets/motions/motions.h"

namespace ego {
namespace {

// Help and version go to stdout; what is wrong becomes one line on stderr.
int Answer(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return program.exit(error);
  std::string sentence = error.what();
  for (char& c : sentence) {
    if (c == '\n') c = ' ';
  }
  std::fprintf(stderr, "egostudio: %s (egostudio --help tells what there is)\n", sentence.c_str());
  return kWrongArguments;
}

}  // namespace

int RunProgram(int argc, char** argv) {
  CLI::App program{
      "Egostudio brings the motion of a performer to avatars of any build and keeps the contacts "
      "of the body with itself.\nWithout a verb it opens the studio window, on the demo or on the "
      "given files.",
      "egostudio"};
  program.set_version_flag("--version", "egostudio 0.1.0");
  std::vector<std::filesystem::path> files;
  program.add_option(
      "FILES", files,
      "Takes (.c3d .trc .bvh, motion scripts .json) and avatars (.glb .gltf .vrm) to open");
  std::string motion;
  program.add_option("--demo", motion,
                     "Open on this motion of the studio's own performer, by name or number of the "
                     "study: M7, arms_crossed (egostudio motions --list)");
  program.footer("Each verb has its own help: egostudio solve --help");
  const std::vector<Command> commands = AddCommands(program);
  program.require_subcommand(0, 1);
  try {
    program.parse(argc, argv);
    for (const Command& command : commands) {
      if (command.line->parsed()) return command.run();
    }
    if (!motion.empty()) {
      const Result<const MotionScript*> known = FindMotion(motion);
      if (!known) return Fail(known.error());
    }
    return RunStudio(files, motion);
  } catch (const CLI::ParseError& error) {
    return Answer(program, error);
  } catch (const std::bad_alloc&) {
    return Fail("not enough memory for this work");
  } catch (const std::exception& error) {
    return Fail(std::string("stopped by an unexpected fault: ") + error.what());
  }
}

}  // namespace ego
