// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/loading/load_avatar.h"
#include "app/loading/load_take.h"
#include "core/base/result.h"

namespace CLI {
class App;
}

namespace ego {

/// What several verbs ask for: who performs, who follows, and how.
struct CastArguments {
  std::filesystem::path take;                  // empty: the demo's
  std::string demo;                            // which motion the demo shows; empty: several
  std::vector<std::filesystem::path> avatars;  // empty: the demo's
  std::filesystem::path marker_set;            // empty: chosen by the labels
  std::string method;                          // one of RetargetMethodNames
};

/// Declares --take, --demo, --avatar, --method and --marker-set.
void AddCastOptions(CLI::App& line, CastArguments& arguments);

/// Everyone on stage, loaded.
struct Cast {
  LoadedTake take;
  std::vector<LoadedAvatar> avatars;
};

/// Loads them with progress on stderr and prints their notes. All names are checked before
/// anything that takes long begins.
Result<Cast> LoadCast(const CastArguments& arguments);

}  // namespace ego
