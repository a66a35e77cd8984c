// SPDX-License-Identifier: MIT
#include "app/view/fonts.h"

#include <array>
#include <filesystem>
#include <string>

#include "assets/files/file_io.h"

namespace ego {
namespace {

// Where distributions put fonts; the folder of the package differs, the file's name does not.
constexpr std::array<const char*, 6> kFolders = {
    "/usr/share/fonts/opentype/inter", "/usr/share/fonts/truetype/jetbrains-mono",
    "/usr/share/fonts/truetype/inter", "/usr/share/fonts/inter",
    "/usr/share/fonts/jetbrains-mono", "/usr/local/share/fonts",
};

const char* FileName(Face face) {
  switch (face) {
    case Face::kText:
      return "Inter-Regular";
    case Face::kTextStrong:
      return "Inter-SemiBold";
    case Face::kMono:
      break;
  }
  return "JetBrainsMono-Regular";
}

}  // namespace

std::vector<std::uint8_t> ReadFace(Face face) {
  for (const char* folder : kFolders) {
    for (const char* extension : {".otf", ".ttf"}) {
      const std::filesystem::path path =
          std::filesystem::path(folder) / (std::string(FileName(face)) + extension);
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error)) continue;
      Result<std::vector<std::uint8_t>> bytes = ReadFile(path);
      if (bytes) return *std::move(bytes);
    }
  }
  return {};
}

}  // namespace ego
