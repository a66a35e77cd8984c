// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/commands/command.h"
#include "app/commands/reports.h"
#include "app/commands/terminal.h"
#include "app/loading/load_take.h"
#include "assets/files/file_io.h"
#include "assets/takes/bvh.h"

namespace ego {
namespace {

struct Arguments {
  std::filesystem::path take;
  std::filesystem::path out;
  std::filesystem::path report;
  std::filesystem::path marker_set;
};

int Solve(const Arguments& arguments) {
  std::optional<std::filesystem::path> marker_set;
  if (!arguments.marker_set.empty()) marker_set = arguments.marker_set;
  Result<LoadedTake> take = [&] {
    ProgressLine line("solving " + arguments.take.filename().string());
    return LoadTake(arguments.take, marker_set, line.AsProgress());
  }();
  if (!take) return Fail(take.error());
  PrintNotes(take->name, take->notes);

  const CapturedMotion& motion = *take->motion;
  const Result<void> written =
      WriteBvh(arguments.out, motion.performer, motion.poses, motion.rate_hz);
  if (!written) return Fail(written.error());
  if (!arguments.report.empty()) {
    const Result<void> reported = WriteFileAtomically(arguments.report, FormatSolveReport(*take));
    if (!reported) return Fail(reported.error());
  }
  std::printf("%s: %zu frames at %g Hz", arguments.out.string().c_str(), motion.poses.size(),
              motion.rate_hz);
  if (take->solve) {
    std::printf(", marker set %s, mean residual %.1f mm", take->solve->marker_set.c_str(),
                take->solve->mean_residual_mm);
  }
  std::printf("\n");
  return kDone;
}

}  // namespace

Command AddSolveCommand(CLI::App& program) {
  CLI::App* line = program.add_subcommand("solve", "Find the skeleton's motion in a marker take");
  auto arguments = std::make_shared<Arguments>();
  line->add_option("--take", arguments->take, "Take: .c3d, .trc or .bvh")->required();
  line->add_option("--out", arguments->out, "Captured skeleton to write, .bvh")->required();
  line->add_option("--report", arguments->report,
                   "Also write residuals, segment lengths and marker set, .json");
  line->add_option("--marker-set", arguments->marker_set,
                   "Marker set file, .json (default: the shipped set that fits the labels)");
  line->footer(
      "Example:\n  egostudio solve --take karate.c3d --out karate.bvh --report karate.json");
  return {line, [arguments] { return Solve(*arguments); }};
}

}  // namespace ego
