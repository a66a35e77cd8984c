// SPDX-License-Identifier: MIT
// Reads the #include lines of the project and fails on one that crosses a layer the wrong way:
//   app -> { render, capture, assets } -> core -> { glm, standard library }
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {"core"}},
    {"capture", {"capture", "core"}},
    {"assets", {"assets", "core"}},
    {"render", {"render", "core"}},
    {"app", {"app", "render", "capture", "assets", "core"}},
};

// Headers of the standard library have no folder and no ".h".
bool IsStandard(const std::string& include) {
  return include.find('/') == std::string::npos && include.find('.') == std::string::npos;
}

bool IsGlm(const std::string& include) { return include.rfind("glm/", 0) == 0; }

// What core must not use, because another host embeds it: threads, clocks, files, environment.
const std::set<std::string> kNotInCore = {"thread", "mutex",   "condition_variable", "chrono",
                                          "future", "fstream", "filesystem",         "iostream"};

struct Include {
  fs::path file;
  int line;
  std::string target;
  bool angled;
};

std::vector<Include> IncludesOf(const fs::path& root) {
  std::vector<Include> all;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
      if (text.rfind("#include", 0) != 0) continue;
      const std::size_t open = text.find_first_of("<\"", 8);
      const std::size_t close = text.find_first_of(">\"", open + 1);
      if (close == std::string::npos) continue;
      all.push_back({entry.path(), line, text.substr(open + 1, close - open - 1), text[open] == '<'});
    }
  }
  return all;
}

TEST(Layering, IncludesFollowTheDependencyRule) {
  for (const auto& [layer, allowed] : kMayInclude) {
    for (const Include& include : IncludesOf(fs::path(EGO_SOURCE_DIR) / layer)) {
      if (include.angled) continue;
      const std::string target_layer = include.target.substr(0, include.target.find('/'));
      EXPECT_TRUE(allowed.count(target_layer))
          << include.file << ":" << include.line << " includes \"" << include.target << "\"";
    }
  }
}

TEST(Layering, CoreUsesOnlyGlmAndThePortableStandardLibrary) {
  for (const Include& include : IncludesOf(fs::path(EGO_SOURCE_DIR) / "core")) {
    if (!include.angled) continue;
    EXPECT_TRUE(IsStandard(include.target) || IsGlm(include.target))
        << include.file << ":" << include.line << " includes <" << include.target << ">";
    EXPECT_FALSE(kNotInCore.count(include.target))
        << include.file << ":" << include.line << " includes <" << include.target << ">";
  }
}

TEST(Layering, ThirdPartyHeadersStayInSourceFiles) {
  for (const auto& [layer, allowed] : kMayInclude) {
    for (const Include& include : IncludesOf(fs::path(EGO_SOURCE_DIR) / layer)) {
      if (!include.angled || include.file.extension() != ".h") continue;
      if (include.file.string().find("/render/gl/") != std::string::npos) continue;
      EXPECT_TRUE(IsStandard(include.target) || IsGlm(include.target) ||
                  include.target == "nlohmann/json_fwd.hpp")
          << include.file << ":" << include.line << " includes <" << include.target << ">";
    }
  }
}

TEST(Layering, FilesAreFound) {
  EXPECT_GT(IncludesOf(fs::path(EGO_SOURCE_DIR) / "core").size(), 20u);
}

}  // namespace
