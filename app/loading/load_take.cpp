// SPDX-License-Identifier: MIT
#include "app/loading/load_take.h"

#include <cmath>
#include <utility>

#include "app/loading/file_kind.h"
#include "assets/markers/marker_set_file.h"
#include "assets/motions/motion_script_file.h"
#include "assets/motions/motions.h"
#include "assets/takes/bvh.h"
#include "assets/takes/c3d.h"
#include "assets/takes/trc.h"
#include "core/pipeline/skeleton_capture.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

// Sentences of the layers below name the take by its own name; a person thinks of the file.
Error Naming(const fs::path& path, const std::string& sentence) {
  if (sentence == "cancelled" || sentence.find(path.filename().string()) != std::string::npos) {
    return Error{sentence};
  }
  return Error{path.string() + ": " + sentence};
}

Result<LoadedTake> Checked(LoadedTake take, const fs::path& path) {
  const CapturedMotion& motion = *take.motion;
  if (motion.poses.empty()) return Error{path.string() + ": the take has no frames"};
  if (!std::isfinite(motion.rate_hz) || motion.rate_hz <= 0.0) {
    return Error{path.string() + ": the take's frame rate must be above zero"};
  }
  return take;
}

Result<MarkerSet> SetFor(const MarkerTake& take, const std::optional<fs::path>& file) {
  return file ? ReadMarkerSet(*file) : ChooseMarkerSet(take.labels);
}

Result<LoadedTake> LoadMarkers(const fs::path& path, const std::optional<fs::path>& marker_set,
                               const Progress& progress) {
  const Result<MarkerTake> take = LowerExtension(path) == ".trc" ? ReadTrc(path) : ReadC3d(path);
  if (!take) return Naming(path, take.error());
  const Result<MarkerSet> set = SetFor(*take, marker_set);
  if (!set) return marker_set ? Error{set.error()} : Naming(path, set.error());
  Result<SolvedTake> solved = SolveTake(*take, *set, {}, progress);
  if (!solved) return Naming(path, solved.error());

  LoadedTake loaded;
  loaded.name = take->name;
  loaded.path = path;
  loaded.notes = take->warnings;
  for (const std::string& warning : solved->report.warnings) loaded.notes.push_back(warning);
  loaded.motion = std::make_shared<const CapturedMotion>(std::move(solved->motion));
  loaded.solve = std::move(solved->report);
  return Checked(std::move(loaded), path);
}

Result<LoadedTake> LoadSkeletonMotion(const fs::path& path) {
  const Result<JointMotion> motion = ReadBvh(path);
  if (!motion) return Naming(path, motion.error());
  LoadedTake loaded;
  loaded.name = motion->name;
  loaded.path = path;
  loaded.notes = motion->warnings;
  Result<CapturedMotion> captured = CaptureFromJointMotion(*motion, &loaded.notes);
  if (!captured) return Naming(path, captured.error());
  loaded.motion = std::make_shared<const CapturedMotion>(*std::move(captured));
  return Checked(std::move(loaded), path);
}

LoadedTake Performed(ScriptedTake take, std::string name) {
  LoadedTake loaded;
  loaded.motion = std::make_shared<const CapturedMotion>(std::move(take.motion));
  loaded.name = std::move(name);
  return loaded;
}

Result<LoadedTake> LoadScript(const fs::path& path) {
  const Result<MotionScript> script = ReadMotionScript(path);
  if (!script) return Naming(path, script.error());
  LoadedTake loaded = Performed(PerformWithMarkers(*script), script->title);
  loaded.path = path;
  return Checked(std::move(loaded), path);
}

}  // namespace

Result<LoadedTake> LoadTake(const fs::path& path, const std::optional<fs::path>& marker_set,
                            const Progress& progress) {
  const Result<FileKind> kind = KindOf(path);
  if (!kind) return Error{kind.error()};
  if (*kind != FileKind::kTake) {
    return Error{path.string() +
                 ": an avatar, where a take (.c3d, .trc, .bvh or .json) is expected"};
  }
  if (!Report(progress, 0.0, "reading")) return Error{"cancelled"};
  if (LowerExtension(path) == ".json") return LoadScript(path);
  if (LowerExtension(path) == ".bvh") return LoadSkeletonMotion(path);
  return LoadMarkers(path, marker_set, progress);
}

Result<LoadedTake> LoadMotion(const std::string& name) {
  if (name.empty()) return Performed(PerformDemo(), "Demo");
  const Result<const MotionScript*> script = FindMotion(name);
  if (!script) return Error{script.error()};
  return Performed(PerformWithMarkers(**script), (*script)->title);
}

}  // namespace ego
