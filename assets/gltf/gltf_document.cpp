// SPDX-License-Identifier: MIT
#include "assets/gltf/gltf_document.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <nlohmann/json.hpp>

#include "assets/files/file_io.h"
#include "assets/gltf/glb_container.h"
#include "assets/gltf/gltf_uri.h"
#include "assets/gltf/meshopt_view.h"

namespace ego {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 31;
/// Parsers recurse on nested JSON; glTF needs about ten levels.
constexpr int kMaxDepth = 64;

/// Extensions that are understood, or that change only what is not shown.
constexpr std::array<std::string_view, 4> kUnderstood = {
    "KHR_mesh_quantization", "EXT_meshopt_compression", "EXT_texture_webp", "VRM"};

/// A message; thrown inside this file only, because every step may fail.
struct Refusal {
  std::string message;
};

void CheckDepth(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) throw Refusal{"its JSON is nested deeper than glTF ever is"};
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

/// A count or index; `missing` when absent.
std::size_t Number(const Json& object, const char* key, std::size_t missing, const char* what) {
  const auto found = object.find(key);
  if (found == object.end()) return missing;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kMaxBytes) {
    throw Refusal{std::string(what) + " has a bad " + key +
                  "; expected a whole number from 0 to 2 GiB"};
  }
  return found->get<std::size_t>();
}

Json& Array(Json& root, const char* key) {
  Json& array = root[key];
  if (array.is_null()) array = Json::array();
  if (!array.is_array()) throw Refusal{std::string("'") + key + "' is not an array"};
  for (const Json& item : array) {
    if (!item.is_object()) throw Refusal{std::string("'") + key + "' holds no objects"};
  }
  return array;
}

Result<std::vector<std::uint8_t>> ReadFileBeside(
    const std::string& uri, const std::optional<std::filesystem::path>& folder) {
  const auto path = PathBeside(uri, folder);
  if (!path) throw Refusal{path.error()};
  return ReadFile(*path);
}

std::size_t AppendAligned(std::vector<std::uint8_t>& bin, std::span<const std::uint8_t> bytes) {
  bin.resize((bin.size() + 15) / 16 * 16);
  if (bytes.size() > kMaxBytes - bin.size()) throw Refusal{"its buffers are larger than 2 GiB"};
  const std::size_t at = bin.size();
  bin.insert(bin.end(), bytes.begin(), bytes.end());
  return at;
}

struct Range {
  std::size_t begin = 0;
  std::size_t size = 0;
  bool absent = false;
};

/// Buffers, one after the other, into `bin`.
std::vector<Range> GatherBuffers(Json& root, const GltfChunks& chunks, GltfDocument& document,
                                 const std::optional<std::filesystem::path>& folder) {
  std::vector<Range> ranges;
  for (const Json& buffer : Array(root, "buffers")) {
    const std::string what = "buffer " + std::to_string(ranges.size());
    const std::size_t length = Number(buffer, "byteLength", 0, what.c_str());
    std::vector<std::uint8_t> loaded;
    std::span<const std::uint8_t> bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
      if (!uri->is_string()) throw Refusal{what + " has a URI that is no text"};
      const std::string& text = uri->get_ref<const std::string&>();
      if (text.starts_with("data:")) {
        const std::size_t comma = text.find(";base64,");
        if (comma == std::string::npos) throw Refusal{what + " has a data URI without base64"};
        loaded = Base64(std::string_view(text).substr(comma + 8));
      } else {
        auto file = ReadFileBeside(text, folder);
        if (!file) throw Refusal{what + " cannot be read: " + file.error()};
        loaded = *std::move(file);
      }
      bytes = loaded;
    } else if (ranges.empty() && chunks.has_bin) {
      bytes = chunks.bin;
    } else if (buffer.contains("extensions")) {
      ranges.push_back({0, length, true});  // a fallback that nothing needs once views are decoded
      continue;
    } else {
      throw Refusal{what + " has neither a URI nor a binary chunk"};
    }
    if (bytes.size() < length) {
      throw Refusal{what + " is to have " + std::to_string(length) + " bytes but has only " +
                    std::to_string(bytes.size())};
    }
    ranges.push_back({AppendAligned(document.bin, bytes.first(length)), length, false});
  }
  return ranges;
}

/// Position of [offset, offset + length) of a buffer in the gathered binary.
std::size_t Locate(const Json& view, const std::vector<Range>& buffers, std::size_t length,
                   const std::string& what) {
  const std::size_t buffer = Number(view, "buffer", kMaxBytes, what.c_str());
  const std::size_t offset = Number(view, "byteOffset", 0, what.c_str());
  if (buffer >= buffers.size()) {
    throw Refusal{what + " refers to a buffer that the file does not have"};
  }
  if (buffers[buffer].absent) throw Refusal{what + " lies in a buffer without data"};
  if (length > buffers[buffer].size || offset > buffers[buffer].size - length) {
    throw Refusal{what + " runs past the end of buffer " + std::to_string(buffer)};
  }
  return buffers[buffer].begin + offset;
}

std::string TextOr(const Json& object, const char* key, const char* otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

void GatherViews(Json& root, const std::vector<Range>& buffers, GltfDocument& document) {
  std::size_t index = 0;
  for (Json& view : Array(root, "bufferViews")) {
    const std::string what = "buffer view " + std::to_string(index++);
    const std::size_t length = Number(view, "byteLength", 0, what.c_str());
    const Json packed =
        view.value("extensions", Json::object()).value("EXT_meshopt_compression", Json());
    if (packed.is_object()) {
      const std::size_t bytes = Number(packed, "byteLength", 0, what.c_str());
      const std::size_t at = Locate(packed, buffers, bytes, what);
      const std::string mode = TextOr(packed, "mode", "");
      const std::string filter = TextOr(packed, "filter", "NONE");
      const MeshoptView description{Number(packed, "count", 0, what.c_str()),
                                    Number(packed, "byteStride", 0, what.c_str()), mode, filter};
      const auto decoded = DecodeMeshopt(description, std::span(document.bin).subspan(at, bytes));
      if (!decoded) throw Refusal{what + " holds damaged EXT_meshopt_compression data"};
      if (decoded->size() < length) {
        throw Refusal{what + " is to have " + std::to_string(length) + " bytes but decodes to " +
                      std::to_string(decoded->size())};
      }
      view["byteOffset"] = AppendAligned(document.bin, *decoded);
      view["extensions"].erase("EXT_meshopt_compression");
      if (view["extensions"].empty()) view.erase("extensions");
    } else {
      view["byteOffset"] = Locate(view, buffers, length, what);
    }
    view["buffer"] = 0;
  }
}

/// What a file that was beside the document is, by its first bytes.
const char* MimeType(const std::vector<std::uint8_t>& file) {
  if (file.size() > 2 && file[0] == 0xFF && file[1] == 0xD8) return "image/jpeg";
  if (file.size() > 2 && file[0] == 'R' && file[1] == 'I') return "image/webp";
  return "image/png";
}

void GatherImages(Json& root, GltfDocument& document,
                  const std::optional<std::filesystem::path>& folder) {
  if (!root.contains("images")) return;
  for (Json& image : Array(root, "images")) {
    const std::string uri = TextOr(image, "uri", "");
    if (uri.empty() || uri.starts_with("data:")) continue;
    const auto file = ReadFileBeside(uri, folder);
    if (!file) {
      document.notes.push_back("texture left out: " + file.error());
      continue;
    }
    const std::size_t at = AppendAligned(document.bin, *file);
    image.erase("uri");
    image["mimeType"] = MimeType(*file);
    image["bufferView"] = root["bufferViews"].size();
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", at}, {"byteLength", file->size()}});
  }
}

bool MayBeIgnored(std::string_view extension) {
  return std::find(kUnderstood.begin(), kUnderstood.end(), extension) != kUnderstood.end() ||
         extension.starts_with("VRMC_") || extension.starts_with("KHR_materials_") ||
         extension.starts_with("KHR_texture_") || extension.starts_with("KHR_lights_") ||
         extension.starts_with("EXT_texture_") || extension.starts_with("KHR_animation_");
}

void CheckExtensions(Json& root) {
  if (const auto required = root.find("extensionsRequired"); required != root.end()) {
    for (const Json& name : *required) {
      const std::string text = name.is_string() ? name.get<std::string>() : "?";
      if (text == "KHR_draco_mesh_compression") {
        throw Refusal{
            "its meshes are compressed with Draco, which is not supported; save it "
            "without compression"};
      }
      if (!MayBeIgnored(text)) {
        throw Refusal{"it requires the extension " + text.substr(0, 80) +
                      ", which is not supported"};
      }
    }
  }
  // The document no longer holds compressed views.
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = root.find(list);
    if (found == root.end()) continue;
    if (!found->is_array()) throw Refusal{std::string("'") + list + "' is not an array"};
    Json kept = Json::array();
    for (const Json& name : *found) {
      if (name != "EXT_meshopt_compression") kept.push_back(name);
    }
    if (kept.empty()) {
      root.erase(list);
    } else {
      root[list] = kept;
    }
  }
}

GltfDocument Open(std::span<const std::uint8_t> bytes, std::string_view name,
                  const std::optional<std::filesystem::path>& folder) {
  GltfDocument document;
  document.name = name;
  const Result<GltfChunks> chunks = SplitGlb(bytes);
  if (!chunks) throw Refusal{chunks.error()};
  CheckDepth(chunks->json);
  Json root = Json::parse(chunks->json, nullptr, false);
  if (root.is_discarded() || !root.is_object()) throw Refusal{"its JSON is malformed or cut off"};
  const Json asset = root.value("asset", Json::object());
  if (!asset.is_object() || !TextOr(asset, "version", "").starts_with("2.")) {
    throw Refusal{"it does not say that it is glTF 2.0 (asset.version)"};
  }
  CheckExtensions(root);
  const std::vector<Range> buffers = GatherBuffers(root, *chunks, document, folder);
  GatherViews(root, buffers, document);
  GatherImages(root, document, folder);
  root.erase("buffers");
  if (!document.bin.empty()) root["buffers"] = {{{"byteLength", document.bin.size()}}};
  if (root["bufferViews"].empty()) root.erase("bufferViews");
  if (document.bin.empty() && root.contains("bufferViews")) {
    throw Refusal{"it has buffer views but all of its buffers are empty"};
  }
  document.json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  return document;
}

}  // namespace

Result<GltfDocument> OpenGltf(std::span<const std::uint8_t> bytes, std::string_view name,
                              const std::optional<std::filesystem::path>& folder) {
  const std::string prefix = std::string(name) + ": ";
  try {
    return Open(bytes, name, folder);
  } catch (const Refusal& refusal) {
    return Error{prefix + refusal.message};
  } catch (const nlohmann::json::exception&) {
    return Error{prefix + "its JSON does not have the structure of glTF 2.0"};
  } catch (const std::bad_alloc&) {
    return Error{prefix + "it needs more memory than there is"};
  }
}

}  // namespace ego
