// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ego::test {

/// A small humanoid of 15 joints with one square of skin on every joint, as JSON and binary, for
/// each test to bend in its own way.
struct Sample {
  nlohmann::json root;
  std::vector<std::uint8_t> bin;

  std::size_t View(const void* data, std::size_t bytes) {
    bin.resize((bin.size() + 3) / 4 * 4);
    const std::size_t at = bin.size();
    bin.resize(at + bytes);
    std::memcpy(bin.data() + at, data, bytes);
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes}});
    return root["bufferViews"].size() - 1;
  }
  template <class T>
  std::size_t Accessor(const std::vector<T>& data, int component, const char* type,
                       std::size_t width) {
    const std::size_t view = View(data.data(), data.size() * sizeof(T));
    root["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component},
                                 {"count", data.size() / width},
                                 {"type", type}});
    return root["accessors"].size() - 1;
  }
  nlohmann::json& Attribute(const char* name) {
    return root["meshes"][0]["primitives"][0]["attributes"][name];
  }
  nlohmann::json& AccessorOf(const char* name) {
    return root["accessors"][Attribute(name).get<std::size_t>()];
  }
  /// The document as GLB, and as JSON text with its buffer in a data URI.
  std::vector<std::uint8_t> Glb();
  std::string GltfText();
};

/// The sample with joints and skin in this unit.
Sample MakeSample(double unit = 1.0);

}  // namespace ego::test
