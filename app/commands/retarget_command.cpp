// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "app/commands/cast_arguments.h"
#include "app/commands/command.h"
#include "app/commands/reports.h"
#include "app/commands/terminal.h"
#include "app/stage/step_clock.h"
#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"
#include "assets/takes/bvh.h"
#include "core/baselines/retarget_method.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  CastArguments cast;
  fs::path out;
  std::string format = "glb";
  fs::path report;
};

// The motion of every avatar, and how good it is.
struct Retargeted {
  std::vector<AvatarOutcome> outcomes;   // one per avatar
  std::vector<std::vector<Pose>> poses;  // per avatar, per frame
  StepTime normalize;
};

Retargeted RetargetAll(const Cast& cast, std::string_view method_name) {
  const CapturedMotion& motion = *cast.take.motion;
  const std::unique_ptr<RetargetMethod> method = MakeRetargetMethod(method_name);
  const std::unique_ptr<RetargetMethod> copy = MakeRetargetMethod("copy");
  Retargeted all;
  all.outcomes.resize(cast.avatars.size());
  all.poses.resize(cast.avatars.size());
  StepClock normalize;
  std::vector<StepClock> adapt(cast.avatars.size());
  ProgressLine line("retargeting " + cast.take.name);
  Pose copied;
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    const Pose& performer_pose = motion.poses[frame];
    const auto start = StepClock::Clock::now();
    method->SetPerformerPose(motion.performer, performer_pose);
    normalize.Add(StepClock::Clock::now() - start);
    copy->SetPerformerPose(motion.performer, performer_pose);
    for (std::size_t i = 0; i < cast.avatars.size(); ++i) {
      const Body& body = *cast.avatars[i].body;
      Pose& pose = all.poses[i].emplace_back();
      const auto begin = StepClock::Clock::now();
      method->Adapt(body, pose);
      adapt[i].Add(StepClock::Clock::now() - begin);
      copy->Adapt(body, copied);
      AvatarOutcome& outcome = all.outcomes[i];
      Accumulate(motion.performer, performer_pose, body, pose, motion.rate_hz, {}, outcome.score);
      Accumulate(motion.performer, performer_pose, body, copied, motion.rate_hz, {}, outcome.copy);
    }
    line.Show(static_cast<double>(frame + 1) / static_cast<double>(motion.poses.size()),
              "adapting and measuring");
  }
  all.normalize = normalize.Summary();
  for (std::size_t i = 0; i < cast.avatars.size(); ++i) {
    all.outcomes[i].avatar = &cast.avatars[i];
    all.outcomes[i].adapt = adapt[i].Summary();
  }
  return all;
}

// A name for each avatar's file that no other has.
std::vector<fs::path> FileNames(const Cast& cast, const fs::path& folder,
                                const std::string& extension) {
  std::set<std::string> used;
  std::vector<fs::path> names;
  for (const LoadedAvatar& avatar : cast.avatars) {
    const std::string base = cast.take.name + "-" + avatar.name;
    std::string name = base;
    for (int n = 2; !used.insert(name).second; ++n) name = base + "-" + std::to_string(n);
    for (char& c : name) {
      if (c == '/' || static_cast<unsigned char>(c) < 0x20) c = '_';
    }
    names.push_back(folder / (name + "." + extension));
  }
  return names;
}

void PrintOutcome(const AvatarOutcome& outcome) {
  std::printf("%s: ", outcome.file.c_str());
  const auto percent = [](const ContactScore& score) { return 100.0 * score.gap_error.Mean(); };
  if (outcome.score.palm.gap_error.count > 0) {
    std::printf("palm contacts off by %.1f %% of height (copy %.1f %%), ",
                percent(outcome.score.palm), percent(outcome.copy.palm));
  }
  std::printf("largest joint step %.1f degrees (copy %.1f)\n", Degrees(outcome.score.largest_step),
              Degrees(outcome.copy.largest_step));
}

int Retarget(const Arguments& arguments) {
  std::error_code error;
  fs::create_directories(arguments.out, error);
  if (!fs::is_directory(arguments.out)) {
    return Fail(arguments.out.string() + ": a folder to write the avatars to cannot be made there");
  }
  Result<Cast> cast = LoadCast(arguments.cast);
  if (!cast) return Fail(cast.error());

  Retargeted all = RetargetAll(*cast, arguments.cast.method);
  const double rate_hz = cast->take.motion->rate_hz;
  const std::vector<fs::path> files = FileNames(*cast, arguments.out, arguments.format);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const LoadedAvatar& avatar = cast->avatars[i];
    ProgressLine line("writing " + files[i].filename().string());
    const Result<void> written = arguments.format == "bvh"
                                     ? WriteBvh(files[i], *avatar.body, all.poses[i], rate_hz)
                                     : WriteRetargeted(files[i], *avatar.character, all.poses[i],
                                                       rate_hz, cast->take.name, line.AsProgress());
    if (!written) return Fail(written.error());
    all.outcomes[i].file = files[i].string();
  }
  if (!arguments.report.empty()) {
    const Result<void> reported = WriteFileAtomically(
        arguments.report,
        FormatRetargetReport(cast->take, arguments.cast.method, all.normalize, all.outcomes));
    if (!reported) return Fail(reported.error());
  }
  for (const AvatarOutcome& outcome : all.outcomes) PrintOutcome(outcome);
  return kDone;
}

}  // namespace

Command AddRetargetCommand(CLI::App& program) {
  CLI::App* line =
      program.add_subcommand("retarget", "Bring a take to avatars and write them with the motion");
  auto arguments = std::make_shared<Arguments>();
  AddCastOptions(*line, arguments->cast);
  line->add_option("--out", arguments->out, "Folder to write to, one file per avatar")->required();
  line->add_option("--format", arguments->format,
                   "glb: the avatar with the animation in it; bvh: its skeleton's motion")
      ->check(CLI::IsMember({"glb", "bvh"}))
      ->capture_default_str();
  line->add_option("--report", arguments->report,
                   "Also write contacts kept, joint steps and times, beside plain copying, .json");
  line->footer(
      "Without --take the demo's motion is used, without --avatar the demo's cast.\n\n"
      "Example:\n  egostudio retarget --take karate.c3d --avatar knight.glb --avatar child.vrm "
      "--out retargeted --report report.json");
  return {line, [arguments] { return Retarget(*arguments); }};
}

}  // namespace ego
