// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/pipeline/captured_motion.h"
#include "core/solve/solve_take.h"

namespace ego {

/// A take as the studio plays it, with what is known about how it came to be.
struct LoadedTake {
  std::string name;
  std::filesystem::path path;                    // empty for the studio's own motions
  std::shared_ptr<const CapturedMotion> motion;  // never null, has frames and a rate above zero
  std::optional<SolveReport> solve;              // of marker takes
  std::vector<std::string> notes;                // sentences worth showing
};

/// Reads a take whatever its kind. Marker files are solved with the marker set of the given file,
/// or else with the shipped set that fits the labels; skeleton motions are mapped to the humanoid;
/// motion scripts are performed by the studio's own performer.
/// Error: one sentence that names the file; "cancelled" when `progress` said so.
Result<LoadedTake> LoadTake(const std::filesystem::path& path,
                            const std::optional<std::filesystem::path>& marker_set = {},
                            const Progress& progress = {});

/// A motion of the studio's own performer, which needs no file: of the name or the study's number
/// ("M7"); empty: the demo, several of them in a row. Error: a sentence that lists the names.
Result<LoadedTake> LoadMotion(const std::string& name = {});

}  // namespace ego
