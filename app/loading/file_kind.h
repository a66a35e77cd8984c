// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace ego {

/// What the studio opens a file as.
enum class FileKind { kTake, kAvatar };

/// By the extension, whatever its case: .c3d .trc .bvh and motion scripts .json are takes, .glb
/// .gltf .vrm avatars. Error: a sentence that names the file and what can be opened. The file
/// itself is not looked at.
Result<FileKind> KindOf(const std::filesystem::path& path);

/// The extension in lower case, with its dot.
std::string LowerExtension(const std::filesystem::path& path);

}  // namespace ego
