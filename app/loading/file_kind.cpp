// SPDX-License-Identifier: MIT
#include "app/loading/file_kind.h"

#include <string>

namespace ego {

std::string LowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

Result<FileKind> KindOf(const std::filesystem::path& path) {
  const std::string extension = LowerExtension(path);
  for (const char* take : {".c3d", ".trc", ".bvh", ".json"}) {
    if (extension == take) return FileKind::kTake;
  }
  for (const char* avatar : {".glb", ".gltf", ".vrm"}) {
    if (extension == avatar) return FileKind::kAvatar;
  }
  return Error{path.string() +
               ": cannot tell what to open it as; takes are .c3d, .trc or .bvh, motion scripts "
               ".json, avatars .glb, .gltf or .vrm"};
}

}  // namespace ego
