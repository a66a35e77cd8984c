// SPDX-License-Identifier: MIT
#include "assets/gltf/weight_repair.h"

#include <cmath>
#include <cstring>
#include <optional>

#include <nlohmann/json.hpp>

namespace ego {
namespace {

using Json = nlohmann::json;

/// Where a float VEC4 accessor lies in the binary buffer.
struct Weights {
  std::size_t first = 0;
  std::size_t stride = 16;
  std::size_t count = 0;
};

std::optional<Weights> Locate(const Json& root, const GltfDocument& document, const Json& index) {
  const Json& accessor = root.at("accessors").at(index.get<std::size_t>());
  if (accessor.at("componentType") != 5126 || accessor.at("type") != "VEC4" ||
      accessor.contains("sparse") || !accessor.contains("bufferView")) {
    return {};
  }
  const Json& view = root.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  Weights weights;
  weights.count = accessor.at("count").get<std::size_t>();
  weights.stride = view.value("byteStride", std::size_t{16});
  const std::size_t offset = accessor.value("byteOffset", std::size_t{0});
  const std::size_t length = view.at("byteLength").get<std::size_t>();
  weights.first = view.value("byteOffset", std::size_t{0}) + offset;
  const bool fits = weights.count > 0 && weights.stride >= 16 && offset <= length &&
                    length - offset >= 16 &&
                    weights.count - 1 <= (length - offset - 16) / weights.stride &&
                    weights.first - offset + length <= document.bin.size();
  if (!fits) return {};
  return weights;
}

}  // namespace

void NormalizeWeights(GltfDocument& document) {
  const Json root = Json::parse(document.json, nullptr, false);
  try {
    for (const Json& mesh : root.at("meshes")) {
      for (const Json& primitive : mesh.at("primitives")) {
        const Json& attributes = primitive.at("attributes");
        std::vector<Weights> sets;
        for (const char* name : {"WEIGHTS_0", "WEIGHTS_1"}) {
          if (!attributes.contains(name)) continue;
          if (const auto found = Locate(root, document, attributes.at(name))) {
            sets.push_back(*found);
          }
        }
        if (sets.empty() || sets.front().count != sets.back().count) continue;
        for (std::size_t v = 0; v < sets.front().count; ++v) {
          double sum = 0.0;
          float w[4];
          for (const Weights& set : sets) {
            std::memcpy(w, document.bin.data() + set.first + v * set.stride, sizeof w);
            for (const float value : w) sum += static_cast<double>(value);
          }
          if (!(sum > 0.0) || !std::isfinite(sum) || std::abs(sum - 1.0) < 1e-6) continue;
          for (const Weights& set : sets) {
            unsigned char* at = document.bin.data() + set.first + v * set.stride;
            std::memcpy(w, at, sizeof w);
            for (float& value : w) value = static_cast<float>(static_cast<double>(value) / sum);
            std::memcpy(at, w, sizeof w);
          }
        }
      }
    }
  } catch (const nlohmann::json::exception&) {
    return;  // no meshes, or malformed ones: nothing to repair here
  }
}

}  // namespace ego
