// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace ego {

/// A glTF file with everything that it needs inside: one JSON text and one binary buffer, whatever
/// mixture of GLB chunks, data URIs, files beside it and compressed buffer views it came as.
struct GltfDocument {
  std::string name;  // file name, for messages
  std::string json;  // at most one buffer, without URI; no buffer view is compressed
  std::vector<std::uint8_t> bin;
  std::vector<std::string> notes;  // what had to be left out
};

/// Opens a document from bytes. Files that it refers to are read below `folder` only, never by an
/// absolute path, a scheme or "..": that is an error, as is every reference when there is no
/// folder. EXT_meshopt_compression is decoded, Draco and unknown required extensions are refused.
/// Checks buffers and buffer views; accessors, nodes and the rest are for who reads them.
Result<GltfDocument> OpenGltf(std::span<const std::uint8_t> bytes, std::string_view name,
                              const std::optional<std::filesystem::path>& folder);

}  // namespace ego
