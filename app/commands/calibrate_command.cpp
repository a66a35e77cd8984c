// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "app/commands/command.h"
#include "app/commands/terminal.h"
#include "assets/calibration/calibration_document.h"
#include "assets/calibration/calibration_file.h"
#include "assets/calibration/calibration_report.h"
#include "assets/calibration/check_calibration.h"
#include "assets/calibration/propose_calibration.h"
#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path avatar;
  fs::path out;
  fs::path report;
  bool check = false;
  bool force = false;
};

/// A calibration that a person has worked on is not thrown away unasked.
Result<void> MayReplace(const fs::path& path, const Character& character) {
  std::error_code code;
  if (!fs::exists(path, code)) return {};
  const Result<LoadedCalibration> old = ReadCalibration(path, character);
  if (!old) {
    return Error{path.string() + ": is there already and is no calibration of this character; " +
                 "--force replaces it"};
  }
  const std::size_t picked = Summarize(old->calibration).picked;
  if (picked == 0) return {};
  return Error{path.string() + ": holds " + std::to_string(picked) +
               " points that a person picked or confirmed; --force replaces it, --check looks it "
               "over as it is"};
}

Result<CalibrationDocument> Open(const Arguments& arguments) {
  ProgressLine line("calibrating " + arguments.avatar.filename().string());
  Result<Character> character = ReadCharacter(arguments.avatar, line.AsProgress());
  if (!character) return Error{character.error()};
  if (arguments.check) {
    const fs::path path =
        arguments.out.empty() ? CalibrationPathFor(arguments.avatar) : arguments.out;
    Result<LoadedCalibration> loaded = ReadCalibration(path, *character);
    if (!loaded) return Error{loaded.error()};
    Result<Character> mended = WithJointOverrides(*character, loaded->calibration.joint_override);
    if (!mended) return Error{mended.error()};
    CalibrationDocument document;
    document.avatar = arguments.avatar;
    document.path = path;
    document.character = std::make_shared<const Character>(*std::move(mended));
    document.calibration = std::move(loaded->calibration);
    document.warnings = std::move(loaded->warnings);
    return document;
  }
  if (!arguments.force) {
    if (const auto may = MayReplace(arguments.out, *character); !may) return Error{may.error()};
  }
  Result<AvatarCalibration> proposal = ProposeCalibration(*character, line.AsProgress());
  if (!proposal) return Error{proposal.error()};
  CalibrationDocument document;
  document.avatar = arguments.avatar;
  document.path = arguments.out;
  document.character = std::make_shared<const Character>(*std::move(character));
  document.calibration = *std::move(proposal);
  return document;
}

int Calibrate(const Arguments& arguments) {
  const Result<CalibrationDocument> document = Open(arguments);
  if (!document) return Fail(document.error());
  PrintNotes(document->character->name, document->character->notes);
  PrintNotes(document->character->name, document->warnings);
  const Character& character = *document->character;
  const SurfaceMesh surface(character);
  const auto findings = CalibrationChecker(character, surface).Check(document->calibration);
  if (!arguments.check) {
    const Result<void> written = WriteCalibration(arguments.out, character, document->calibration);
    if (!written) return Fail(written.error());
  }
  if (!arguments.report.empty()) {
    const Result<void> reported =
        WriteFileAtomically(arguments.report, FormatCalibrationReport(*document, findings));
    if (!reported) return Fail(reported.error());
  }
  for (const CalibrationFinding& finding : findings) {
    std::printf("%s: %s\n", std::string(Name(finding.severity)).c_str(), finding.sentence.c_str());
  }
  const CalibrationSummary summary = Summarize(document->calibration);
  std::printf("%s: %zu picked, %zu proposed, %zu doubtful, %zu missing%s\n",
              document->path.string().c_str(), summary.picked, summary.proposed, summary.doubtful,
              summary.missing, NeedsAPerson(findings) ? "; a person should look" : "");
  return NeedsAPerson(findings) ? kPersonShouldLook : kDone;
}

}  // namespace

Command AddCalibrateCommand(CLI::App& program) {
  CLI::App* line = program.add_subcommand(
      "calibrate", "Find the points on an avatar's skin that the method needs, and check them");
  auto arguments = std::make_shared<Arguments>();
  line->add_option("--avatar", arguments->avatar, "Avatar: .glb, .gltf or .vrm")->required();
  line->add_option("--out", arguments->out,
                   "Calibration to write, .calib.json; with --check the one to read");
  line->add_option("--report", arguments->report,
                   "Also write findings, every point's confidence and the gaps that test postures "
                   "leave, .json");
  line->add_flag("--check", arguments->check,
                 "Look over the calibration there is instead of proposing one");
  line->add_flag("--force", arguments->force, "Replace a calibration that a person has worked on");
  line->footer(
      "Exit codes:\n  0  the calibration stands as it is\n  1  the work failed\n  2  the command "
      "line makes no sense\n  3  written (or read), but a person should look: the findings say "
      "where\n\nExample:\n  egostudio calibrate --avatar knight.glb --out knight.glb.calib.json "
      "--report report.json");
  line->callback([arguments] {
    if (!arguments->check && arguments->out.empty()) {
      throw CLI::RequiredError("--out (unless --check is given)");
    }
  });
  return {line, [arguments] { return Calibrate(*arguments); }};
}

}  // namespace ego
