// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <string_view>

#include <stb/stb_image_write.h>
#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include "assets/files/file_io.h"
#include "assets/gltf/animation_writer.h"
#include "assets/gltf/character_file.h"
#include "assets/gltf/glb_container.h"
#include "assets/gltf/gltf_document.h"
#include "assets/gltf/gltf_model.h"
#include "assets/gltf/scene_reader.h"
#include "assets/gltf/weight_repair.h"
#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using Json = nlohmann::json;
using J = HumanoidJoint;

constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

Json Numbers(const Mat4& matrix) {
  Json numbers = Json::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) numbers.push_back(matrix[c][r]);
  }
  return numbers;
}

/// Whether this is what VRM 1.0 calls a finger's bone: "leftThumbMetacarpal", "rightLittleDistal".
bool IsVrmFinger(std::string_view name) {
  for (const std::string_view side : {"left", "right"}) {
    if (!name.starts_with(side)) continue;
    name.remove_prefix(side.size());
    for (const std::string_view finger : {"Thumb", "Index", "Middle", "Ring", "Little"}) {
      if (!name.starts_with(finger)) continue;
      name.remove_prefix(finger.size());
      return name == "Proximal" || name == "Distal" ||
             name == (finger == "Thumb" ? "Metacarpal" : "Intermediate");
    }
    return false;
  }
  return false;
}

/// Builds a document from a character, piece by piece.
class Builder {
 public:
  explicit Builder(const Character& character) : character_(character) {}

  GltfDocument Build() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Egostudio"}};
    root_["bufferViews"] = Json::array();
    root_["accessors"] = Json::array();
    AddNodes();
    AddMaterials();
    for (const MeshPart& part : character_.parts) AddPart(part);
    AddVrm();
    root_["scene"] = 0;
    root_["scenes"] = {{{"nodes", scene_}}};
    root_["buffers"] = {{{"byteLength", document_.bin.size()}}};
    document_.json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
    return std::move(document_);
  }

 private:
  std::size_t AddView(const void* data, std::size_t bytes, int target) {
    document_.bin.resize((document_.bin.size() + 3) / 4 * 4);
    const std::size_t offset = document_.bin.size();
    document_.bin.resize(offset + bytes);
    if (bytes > 0) std::memcpy(document_.bin.data() + offset, data, bytes);
    Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}};
    if (target != 0) view["target"] = target;
    root_["bufferViews"].push_back(view);
    return root_["bufferViews"].size() - 1;
  }

  template <class T>
  std::size_t AddAccessor(const std::vector<T>& data, std::size_t count, int component,
                          const char* type, int target) {
    const std::size_t view = AddView(data.data(), data.size() * sizeof(T), target);
    root_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return root_["accessors"].size() - 1;
  }

  void AddNodes() {
    root_["nodes"] = Json::array();
    std::vector<int> roots;
    const auto& joints = character_.nodes.joints;
    const std::vector<Mat4>& global = character_.rig.canonical_global;
    for (std::size_t n = 0; n < joints.size(); ++n) {
      const int parent = joints[n].parent;
      const Mat4 local = parent < 0 ? global[n] : glm::inverse(global[At(parent)]) * global[n];
      root_["nodes"].push_back({{"name", joints[n].name}, {"matrix", Numbers(local)}});
      if (parent < 0) {
        roots.push_back(static_cast<int>(n));
      } else {
        root_["nodes"][At(parent)]["children"].push_back(n);
      }
    }
    if (roots.size() == 1) {
      scene_.push_back(roots[0]);
      return;
    }
    // Joints of one skin need one root.
    root_["nodes"].push_back({{"name", character_.name}, {"children", roots}});
    scene_.push_back(root_["nodes"].size() - 1);
  }

  void AddMaterials() {
    std::vector<int> texture(character_.images.size(), -1);
    for (std::size_t i = 0; i < character_.images.size(); ++i) {
      const Image& image = character_.images[i];
      if (image.width <= 0) continue;
      std::vector<std::uint8_t> png;
      const auto append = [](void* to, void* data, int size) {
        auto* out = static_cast<std::vector<std::uint8_t>*>(to);
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        out->insert(out->end(), bytes, bytes + size);
      };
      stbi_write_png_to_func(append, &png, image.width, image.height, 4, image.rgba.data(),
                             image.width * 4);
      root_["images"].push_back(
          {{"bufferView", AddView(png.data(), png.size(), 0)}, {"mimeType", "image/png"}});
      root_["textures"].push_back({{"source", root_["images"].size() - 1}});
      texture[i] = static_cast<int>(root_["textures"].size()) - 1;
    }
    for (const Material& material : character_.materials) {
      const glm::vec4 c = glm::clamp(material.base_color, 0.0f, 1.0f);
      Json out = {{"name", material.name},
                  {"doubleSided", material.double_sided},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {c.r, c.g, c.b, c.a}},
                    {"metallicFactor", 0.0},
                    {"roughnessFactor", 0.9}}}};
      const int image = material.base_color_image;
      if (image >= 0 && texture[At(image)] >= 0) {
        out["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture[At(image)]}};
      }
      if (material.alpha_mask) {
        out["alphaMode"] = "MASK";
        out["alphaCutoff"] = material.alpha_cutoff;
      } else if (material.blend) {
        out["alphaMode"] = "BLEND";
      }
      root_["materials"].push_back(out);
    }
  }

  /// The palette entries that a part uses become a skin of its own.
  std::map<std::uint16_t, std::uint16_t> AddSkin(const MeshPart& part) {
    std::map<std::uint16_t, std::uint16_t> slot;
    for (const MeshPart::Influences& influences : part.influences) {
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (influences.weight[k] > 0.0f) slot[influences.entry[k]] = 0;
      }
    }
    std::vector<float> matrices;
    std::vector<int> joints;
    for (auto& [entry, index] : slot) {
      index = static_cast<std::uint16_t>(joints.size());
      joints.push_back(character_.palette[entry].node);
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
          const double affine =
              r == 3 ? (c == 3 ? 1.0 : 0.0) : character_.palette[entry].inverse_bind[c][r];
          matrices.push_back(static_cast<float>(affine));
        }
      }
    }
    root_["skins"].push_back(
        {{"joints", joints},
         {"inverseBindMatrices", AddAccessor(matrices, joints.size(), kFloat, "MAT4", 0)}});
    return slot;
  }

  void AddPart(const MeshPart& part) {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    const std::size_t count = part.positions.size();
    const auto slot = AddSkin(part);
    Json attributes;
    const std::size_t position = AddAccessor(part.positions, count, kFloat, "VEC3", kVertices);
    glm::vec3 low = part.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& p : part.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    root_["accessors"][position]["min"] = {low.x, low.y, low.z};
    root_["accessors"][position]["max"] = {high.x, high.y, high.z};
    attributes["POSITION"] = position;
    attributes["NORMAL"] = AddAccessor(part.normals, count, kFloat, "VEC3", kVertices);
    if (!part.uvs.empty()) {
      attributes["TEXCOORD_0"] = AddAccessor(part.uvs, count, kFloat, "VEC2", kVertices);
    }
    for (std::size_t set = 0; set < MeshPart::kInfluences / 4; ++set) {
      std::vector<std::uint16_t> joints;
      std::vector<float> weights;
      bool used = set == 0;
      for (const MeshPart::Influences& influences : part.influences) {
        for (std::size_t k = 4 * set; k < 4 * set + 4; ++k) {
          const float weight = influences.weight[k];
          used = used || weight > 0.0f;
          weights.push_back(weight);
          joints.push_back(weight > 0.0f ? slot.at(influences.entry[k]) : std::uint16_t{0});
        }
      }
      if (!used) break;
      const std::string number = std::to_string(set);
      attributes["JOINTS_" + number] =
          AddAccessor(joints, count, kUnsignedShort, "VEC4", kVertices);
      attributes["WEIGHTS_" + number] = AddAccessor(weights, count, kFloat, "VEC4", kVertices);
    }
    Json primitive = {{"attributes", attributes},
                      {"indices", AddAccessor(part.triangles, part.triangles.size(), kUnsignedInt,
                                              "SCALAR", kIndices)}};
    if (part.material >= 0) primitive["material"] = part.material;
    root_["meshes"].push_back({{"name", part.name}, {"primitives", {primitive}}});
    root_["nodes"].push_back({{"name", part.name},
                              {"mesh", root_["meshes"].size() - 1},
                              {"skin", root_["skins"].size() - 1}});
    scene_.push_back(root_["nodes"].size() - 1);
  }

  /// VRM 1.0 human bones, where the rig has all that VRM requires.
  void AddVrm() {
    std::array<int, kJointCount> node = character_.rig.node;
    // VRM wants the lowest joint of the trunk to be its spine.
    const auto trunk = node.begin() + static_cast<std::ptrdiff_t>(Index(J::kSpine));
    std::stable_partition(trunk, trunk + 3, [](int n) { return n >= 0; });
    Json bones;
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const auto joint = static_cast<J>(j);
      const bool optional = joint == J::kChest || joint == J::kUpperChest || joint == J::kNeck ||
                            joint == J::kLeftShoulder || joint == J::kRightShoulder ||
                            joint == J::kLeftToes || joint == J::kRightToes;
      if (node[j] < 0 && !optional) return;
      if (node[j] >= 0) bones[std::string(Name(joint))] = {{"node", node[j]}};
    }
    // Fingers are helper joints here; those that bear VRM's own names are declared.
    for (std::size_t n = 0; n < character_.nodes.joints.size(); ++n) {
      const std::string& name = character_.nodes.joints[n].name;
      if (IsVrmFinger(name) && !bones.contains(name)) bones[name] = {{"node", n}};
    }
    root_["extensionsUsed"] = {"VRMC_vrm"};
    root_["extensions"]["VRMC_vrm"] = {{"specVersion", "1.0"},
                                       {"meta",
                                        {{"name", character_.name},
                                         {"authors", {"Egostudio"}},
                                         {"licenseUrl", "https://vrm.dev/licenses/1.0/"}}},
                                       {"humanoid", {{"humanBones", bones}}}};
  }

  const Character& character_;
  GltfDocument document_;
  Json root_;
  Json scene_ = Json::array();
};

Result<GltfDocument> Generated(const Character& character, const std::string& name) {
  if (character.parts.empty()) return Error{name + ": the character has no mesh to write"};
  GltfDocument document = Builder(character).Build();
  document.name = name;
  return document;
}

/// The character's file again, and its nodes in the character's order.
Result<GltfDocument> Reopened(const Character& character, std::vector<int>& node_of) {
  const std::filesystem::path source(character.source_path);
  const auto bytes = ReadFile(source);
  if (!bytes) return Error{bytes.error()};
  auto document = OpenGltf(*bytes, source.filename().string(), source.parent_path());
  if (!document) return document;
  const auto model = ParseModel(*document);
  if (!model) return Error{model.error()};
  const auto order = OrderNodes(**model);
  if (!order) return Error{document->name + ": " + order.error()};
  if (order->node_of.size() != character.nodes.joints.size()) {
    return Error{document->name + ": it has " + std::to_string(order->node_of.size()) +
                 " nodes but had " + std::to_string(character.nodes.joints.size()) +
                 " when it was read"};
  }
  node_of = order->node_of;
  NormalizeWeights(*document);
  return document;
}

}  // namespace

Result<void> WriteCharacter(const std::filesystem::path& path, const Character& character) {
  const auto document = Generated(character, path.filename().string());
  if (!document) return Error{document.error()};
  return WriteFileAtomically(path, PackGlb(document->json, document->bin));
}

Result<void> WriteRetargeted(const std::filesystem::path& path, const Character& character,
                             std::span<const Pose> poses, double rate_hz,
                             std::string_view animation_name, const Progress& progress) {
  try {
    std::vector<int> node_of;
    if (character.source_path.empty()) {
      node_of.resize(character.nodes.joints.size());
      for (std::size_t n = 0; n < node_of.size(); ++n) node_of[n] = static_cast<int>(n);
    }
    auto document = character.source_path.empty() ? Generated(character, path.filename().string())
                                                  : Reopened(character, node_of);
    if (!document) return Error{document.error()};
    if (auto put =
            PutAnimation(*document, node_of, character, {animation_name, poses, rate_hz}, progress);
        !put) {
      return put;
    }
    return WriteFileAtomically(path, PackGlb(document->json, document->bin));
  } catch (const std::bad_alloc&) {
    return Error{path.filename().string() + ": writing it needs more memory than there is"};
  }
}

}  // namespace ego
