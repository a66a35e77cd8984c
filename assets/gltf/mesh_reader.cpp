// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tiny_gltf.h>

#include "assets/gltf/accessor_reader.h"
#include "assets/gltf/scene_reader.h"

namespace ego {
namespace {

/// Bound on all vertices and triangle corners of one character.
constexpr std::size_t kMaxTotal = std::size_t{1} << 25;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

/// Where in the palette a mesh's joints begin.
struct Binding {
  std::uint16_t first = 0;
  std::size_t joints = 0;  // 0: rigid, one entry
};

struct Budget {
  std::size_t left = kMaxTotal;
  bool Take(std::size_t count) {
    if (count > left) return false;
    left -= count;
    return true;
  }
};

/// Corner indices as three per triangle. Error: an index past the vertices.
Result<std::vector<std::uint32_t>> ReadTriangles(const tinygltf::Model& model,
                                                 const tinygltf::Primitive& primitive,
                                                 std::size_t vertices, const std::string& what) {
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    auto read = ReadIntegers(model, primitive.indices, 1, what + ", indices");
    if (!read) return Error{read.error()};
    corners = *std::move(read);
  } else {
    corners.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  for (const std::uint32_t corner : corners) {
    if (corner >= vertices) {
      return Error{what + " has the vertex index " + std::to_string(corner) + " but only " +
                   std::to_string(vertices) + " vertices"};
    }
  }
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  std::vector<std::uint32_t> triangles;
  const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::uint32_t a = strip ? corners[i - 2] : corners[0];
    const std::uint32_t b = corners[i - 1];
    const std::uint32_t c = corners[i];
    if (a == b || b == c || c == a) continue;
    if (strip && i % 2 == 1) {
      triangles.insert(triangles.end(), {b, a, c});
    } else {
      triangles.insert(triangles.end(), {a, b, c});
    }
  }
  return triangles;
}

std::vector<glm::vec3> AsVec3(const std::vector<float>& numbers) {
  std::vector<glm::vec3> out(numbers.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  }
  return out;
}

/// Area-weighted vertex normals where the file has none; unit length everywhere. In double
/// precision: squares of what a file may say do not fit into a float.
void FinishNormals(MeshPart& part) {
  std::vector<Vec3> normals(part.normals.begin(), part.normals.end());
  if (normals.size() != part.positions.size()) {
    normals.assign(part.positions.size(), Vec3{0.0});
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      const Vec3 a(part.positions[part.triangles[t]]);
      const Vec3 b(part.positions[part.triangles[t + 1]]);
      const Vec3 c(part.positions[part.triangles[t + 2]]);
      for (std::size_t k = 0; k < 3; ++k) {
        normals[part.triangles[t + k]] += glm::cross(b - a, c - a);
      }
    }
  }
  part.normals.resize(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double length = glm::length(normals[v]);
    part.normals[v] = length > 1e-60 ? glm::vec3(normals[v] / length) : glm::vec3(0.0f, 1.0f, 0.0f);
  }
}

/// Influences from JOINTS_n and WEIGHTS_n, n = 0 and 1. Weights are made to sum to one.
Result<void> ReadInfluences(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                            const Binding& binding, const std::string& what, MeshPart& part) {
  part.influences.assign(part.positions.size(), {});
  for (MeshPart::Influences& influences : part.influences) {
    influences.entry.fill(binding.first);
    influences.weight[0] = 1.0f;
  }
  const auto attribute = [&](const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  if (binding.joints == 0 || attribute("JOINTS_0") < 0 || attribute("WEIGHTS_0") < 0) return {};
  for (MeshPart::Influences& influences : part.influences) influences.weight[0] = 0.0f;
  for (std::size_t set = 0; set < MeshPart::kInfluences / 4; ++set) {
    const std::string number = std::to_string(set);
    const int joints_at = attribute(("JOINTS_" + number).c_str());
    const int weights_at = attribute(("WEIGHTS_" + number).c_str());
    if (joints_at < 0 || weights_at < 0) break;
    const auto joints = ReadIntegers(model, joints_at, 4, what + ", JOINTS_" + number);
    if (!joints) return Error{joints.error()};
    const auto weights = ReadNumbers(model, weights_at, 4, what + ", WEIGHTS_" + number);
    if (!weights) return Error{weights.error()};
    if (joints->size() != 4 * part.positions.size() || weights->size() != joints->size()) {
      return Error{what + " has another number of joints or weights than vertices"};
    }
    for (std::size_t i = 0; i < joints->size(); ++i) {
      const float weight = std::max(0.0f, (*weights)[i]);
      if (weight == 0.0f) continue;  // the joint of an unused slot may be anything
      if ((*joints)[i] >= binding.joints) {
        return Error{what + " refers to skin joint " + std::to_string((*joints)[i]) + " of " +
                     std::to_string(binding.joints)};
      }
      MeshPart::Influences& influences = part.influences[i / 4];
      influences.entry[4 * set + i % 4] = static_cast<std::uint16_t>(binding.first + (*joints)[i]);
      influences.weight[4 * set + i % 4] = weight;
    }
  }
  for (MeshPart::Influences& influences : part.influences) {
    float sum = 0.0f;
    for (const float weight : influences.weight) sum += weight;
    if (sum > 0.0f) {
      for (float& weight : influences.weight) weight /= sum;
    } else {
      influences.weight[0] = 1.0f;
    }
  }
  return {};
}

Result<MeshPart> ReadPart(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                          const Binding& binding, const std::string& what, Budget& budget) {
  MeshPart part;
  const auto attribute = [&](const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  const auto positions = ReadNumbers(model, attribute("POSITION"), 3, what + ", POSITION");
  if (!positions) return Error{positions.error()};
  part.positions = AsVec3(*positions);
  auto triangles = ReadTriangles(model, primitive, part.positions.size(), what);
  if (!triangles) return Error{triangles.error()};
  part.triangles = *std::move(triangles);
  if (!budget.Take(part.positions.size() + part.triangles.size())) {
    return Error{what + " brings the character above " + std::to_string(kMaxTotal) +
                 " vertices and triangle corners"};
  }
  if (const int at = attribute("NORMAL"); at >= 0) {
    const auto normals = ReadNumbers(model, at, 3, what + ", NORMAL");
    if (!normals) return Error{normals.error()};
    part.normals = AsVec3(*normals);
  }
  FinishNormals(part);
  if (const int at = attribute("TEXCOORD_0"); at >= 0) {
    const auto uvs = ReadNumbers(model, at, 2, what + ", TEXCOORD_0");
    if (!uvs) return Error{uvs.error()};
    if (uvs->size() == 2 * part.positions.size()) {
      for (std::size_t i = 0; i < part.positions.size(); ++i) {
        part.uvs.emplace_back((*uvs)[2 * i], (*uvs)[2 * i + 1]);
      }
    }
  }
  if (auto read = ReadInfluences(model, primitive, binding, what, part); !read) {
    return Error{read.error()};
  }
  if (primitive.material >= 0) {
    if (At(primitive.material) >= model.materials.size()) {
      return Error{what + " refers to material " + std::to_string(primitive.material) +
                   ", which the file does not have"};
    }
    part.material = primitive.material;
  }
  return part;
}

void NoteOnce(Character& character, const std::string& note) {
  if (std::find(character.notes.begin(), character.notes.end(), note) == character.notes.end()) {
    character.notes.push_back(note);
  }
}

}  // namespace

Result<void> ReadMeshes(const tinygltf::Model& model, const SceneSkeleton& skeleton,
                        Character& character, const Progress& progress) {
  Budget budget;
  std::map<int, Binding> bound;  // skin -> its palette entries
  const std::size_t count = skeleton.order.node_of.size();
  for (std::size_t j = 0; j < count; ++j) {
    const tinygltf::Node& node = model.nodes[At(skeleton.order.node_of[j])];
    if (node.mesh < 0) continue;
    if (!Report(progress, 0.2 + 0.5 * static_cast<double>(j) / static_cast<double>(count),
                "reading meshes")) {
      return Error{"cancelled"};
    }
    const std::string& node_name = character.nodes.joints[j].name;
    if (At(node.mesh) >= model.meshes.size()) {
      return Error{"node '" + node_name + "' refers to mesh " + std::to_string(node.mesh) +
                   ", which the file does not have"};
    }
    Binding binding;
    const bool skinned = node.skin >= 0;
    if (skinned && At(node.skin) >= model.skins.size()) {
      return Error{"node '" + node_name + "' refers to skin " + std::to_string(node.skin) +
                   ", which the file does not have"};
    }
    const std::size_t entries = skinned ? model.skins[At(node.skin)].joints.size() : 1;
    const auto known = skinned ? bound.find(node.skin) : bound.end();
    if (known != bound.end()) {
      binding = known->second;
    } else {
      if (character.palette.size() + entries > 65535) {
        return Error{"mesh node '" + node_name + "' brings the character above 65535 skin joints"};
      }
      binding.first = static_cast<std::uint16_t>(character.palette.size());
      if (skinned && entries > 0) {
        binding.joints = entries;
        const std::vector<int>& joints = model.skins[At(node.skin)].joints;
        for (std::size_t k = 0; k < entries; ++k) {
          character.palette.push_back(
              {skeleton.order.joint_of[At(joints[k])], skeleton.inverse_bind[At(node.skin)][k]});
        }
        bound[node.skin] = binding;
      } else {
        character.palette.push_back({static_cast<int>(j), Mat4(1.0)});
      }
    }
    const tinygltf::Mesh& mesh = model.meshes[At(node.mesh)];
    const std::string mesh_name = mesh.name.empty() ? std::to_string(node.mesh) : mesh.name;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = mesh.primitives[p];
      const std::string what = "mesh '" + mesh_name + "', primitive " + std::to_string(p);
      const int mode = primitive.mode;
      if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
          mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        NoteOnce(character, "mesh '" + mesh_name + "' has points or lines, which are left out");
        continue;
      }
      if (!primitive.targets.empty()) NoteOnce(character, "morph targets are left out");
      auto part = ReadPart(model, primitive, binding, what, budget);
      if (!part) return Error{part.error()};
      part->name = mesh_name;
      if (!part->triangles.empty()) character.parts.push_back(*std::move(part));
    }
  }
  if (character.parts.empty()) return Error{"the file has no mesh with triangles"};
  return {};
}

}  // namespace ego
