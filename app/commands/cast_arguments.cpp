// SPDX-License-Identifier: MIT
#include "app/commands/cast_arguments.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <utility>

#include "app/commands/terminal.h"
#include "app/loading/file_kind.h"
#include "assets/motions/motions.h"
#include "core/baselines/retarget_method.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

// A sentence when the file is absent or of another kind than expected there.
Result<void> CheckFile(const fs::path& path, FileKind expected) {
  const Result<FileKind> kind = KindOf(path);
  if (!kind) return Error{kind.error()};
  if (*kind != expected) {
    return Error{path.string() +
                 (expected == FileKind::kTake
                      ? ": an avatar, where a take (.c3d, .trc, .bvh) is expected"
                      : ": a take, where an avatar (.glb, .gltf, .vrm) is expected")};
  }
  std::error_code error;
  if (!fs::exists(path, error)) return Error{path.string() + ": there is no such file"};
  return {};
}

}  // namespace

void AddCastOptions(CLI::App& line, CastArguments& arguments) {
  const auto names = RetargetMethodNames();
  arguments.method = std::string(names.front());
  CLI::Option* take = line.add_option("--take", arguments.take,
                                      "Take: .c3d, .trc or .bvh, or a motion script .json");
  line.add_option(
          "--demo", arguments.demo,
          "Motion of the studio's own performer instead of a take, by name or number of the "
          "study: M7, arms_crossed (egostudio motions --list)")
      ->excludes(take);
  line.add_option("--avatar", arguments.avatars, "Avatar: .glb, .gltf or .vrm; may be repeated")
      ->allow_extra_args(false);
  line.add_option(
          "--method", arguments.method,
          "mdb: keeps contacts; paper: its closest reading of the paper; copy: joint angles "
          "alone")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->capture_default_str();
  line.add_option("--marker-set", arguments.marker_set,
                  "Marker set file for the take, .json (default: by its labels)");
}

Result<Cast> LoadCast(const CastArguments& arguments) {
  if (!arguments.take.empty()) {
    const Result<void> checked = CheckFile(arguments.take, FileKind::kTake);
    if (!checked) return Error{checked.error()};
  }
  for (const fs::path& path : arguments.avatars) {
    const Result<void> checked = CheckFile(path, FileKind::kAvatar);
    if (!checked) return Error{checked.error()};
  }
  if (!arguments.demo.empty()) {
    const Result<const MotionScript*> known = FindMotion(arguments.demo);
    if (!known) return Error{known.error()};
  }
  Cast cast;
  for (const fs::path& path : arguments.avatars) {
    ProgressLine line("loading " + path.filename().string());
    Result<LoadedAvatar> avatar = LoadAvatar(path, line.AsProgress());
    if (!avatar) return Error{avatar.error()};
    cast.avatars.push_back(*std::move(avatar));
  }
  if (arguments.avatars.empty()) {
    ProgressLine line("making the demo's cast");
    for (std::size_t i = 0; i < DemoAvatarCount(); ++i) {
      line.Show(static_cast<double>(i) / static_cast<double>(DemoAvatarCount()), "");
      cast.avatars.push_back(LoadDemoAvatar(i));
    }
  }
  if (arguments.take.empty()) {
    Result<LoadedTake> motion = LoadMotion(arguments.demo);
    if (!motion) return Error{motion.error()};
    cast.take = *std::move(motion);
  } else {
    std::optional<fs::path> marker_set;
    if (!arguments.marker_set.empty()) marker_set = arguments.marker_set;
    ProgressLine line("solving " + arguments.take.filename().string());
    Result<LoadedTake> take = LoadTake(arguments.take, marker_set, line.AsProgress());
    if (!take) return Error{take.error()};
    cast.take = *std::move(take);
  }
  PrintNotes(cast.take.name, cast.take.notes);
  for (const LoadedAvatar& avatar : cast.avatars) PrintNotes(avatar.name, avatar.notes);
  return cast;
}

}  // namespace ego
