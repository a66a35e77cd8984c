// SPDX-License-Identifier: MIT
#include "core/model/mesh_point.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/check.h"

namespace ego {
namespace {

class Fnv1a {
 public:
  void Add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ = (hash_ ^ ((value >> (8 * byte)) & 0xffu)) * 0x100000001b3u;
    }
  }
  std::uint64_t Value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::uint32_t Bits(float value) {
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof value);
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

bool IsOn(const Character& character, const MeshPoint& point) {
  if (point.part < 0 || static_cast<std::size_t>(point.part) >= character.parts.size()) {
    return false;
  }
  const MeshPart& part = character.parts[static_cast<std::size_t>(point.part)];
  if (point.triangle >= part.triangles.size() / 3) return false;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double weight = point.barycentric[k];
    if (!(weight >= -1e-6 && weight <= 1.0 + 1e-6)) return false;
    sum += weight;
  }
  return std::abs(sum - 1.0) < 1e-6;
}

MeshPoint AtCorner(int part, std::uint32_t triangle, int corner) {
  MeshPoint point{part, triangle, Vec3{0.0}};
  point.barycentric[corner] = 1.0;
  return point;
}

std::vector<Mat4> SkinMatrices(const Character& character, std::span<const Mat4> node_global) {
  EGO_CHECK(node_global.size() == character.nodes.joints.size());
  std::vector<Mat4> matrices;
  matrices.reserve(character.palette.size());
  for (const PaletteEntry& entry : character.palette) {
    matrices.push_back(node_global[static_cast<std::size_t>(entry.node)] * entry.inverse_bind);
  }
  return matrices;
}

Vec3 SkinVertex(const MeshPart& part, std::span<const Mat4> skin_matrices, std::size_t vertex) {
  const MeshPart::Influences& influences = part.influences[vertex];
  const Vec4 position(Vec3(part.positions[vertex]), 1.0);
  Vec4 sum{0.0};
  for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
    const double weight = influences.weight[k];
    if (weight != 0.0) sum += weight * (skin_matrices[influences.entry[k]] * position);
  }
  return Vec3(sum);
}

PosedMesh PoseMesh(const Character& character, std::span<const Mat4> node_global) {
  const std::vector<Mat4> matrices = SkinMatrices(character, node_global);
  PosedMesh mesh;
  mesh.position_ws.resize(character.parts.size());
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const MeshPart& part = character.parts[p];
    mesh.position_ws[p].resize(part.positions.size());
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      mesh.position_ws[p][v] = SkinVertex(part, matrices, v);
    }
  }
  return mesh;
}

PosedMesh CanonicalMesh(const Character& character) {
  return PoseMesh(character, character.rig.canonical_global);
}

Vec3 Position(const Character& character, const PosedMesh& mesh, const MeshPoint& point) {
  const auto p = static_cast<std::size_t>(point.part);
  const MeshPart& part = character.parts[p];
  Vec3 sum{0.0};
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t vertex = part.triangles[3 * std::size_t{point.triangle} + std::size_t(k)];
    sum += point.barycentric[k] * mesh.position_ws[p][vertex];
  }
  return sum;
}

Vec3 PosePoint(const Character& character, std::span<const Mat4> skin_matrices,
               const MeshPoint& point) {
  const MeshPart& part = character.parts[static_cast<std::size_t>(point.part)];
  Vec3 sum{0.0};
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t vertex = part.triangles[3 * std::size_t{point.triangle} + std::size_t(k)];
    sum += point.barycentric[k] * SkinVertex(part, skin_matrices, vertex);
  }
  return sum;
}

std::array<double, kJointCount> JointShares(const Character& character, const MeshPart& part,
                                            std::size_t vertex) {
  std::array<double, kJointCount> share{};
  const MeshPart::Influences& influences = part.influences[vertex];
  for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
    if (influences.weight[k] == 0.0f) continue;
    const int node = character.palette[influences.entry[k]].node;
    share[Index(character.rig.driver[static_cast<std::size_t>(node)])] +=
        static_cast<double>(influences.weight[k]);
  }
  return share;
}

Attachment AttachmentAt(const Character& character, const MeshPoint& point) {
  const MeshPart& part = character.parts[static_cast<std::size_t>(point.part)];
  std::array<double, kJointCount> share{};
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] == 0.0) continue;
    const std::uint32_t vertex = part.triangles[3 * std::size_t{point.triangle} + std::size_t(k)];
    const std::array<double, kJointCount> corner = JointShares(character, part, vertex);
    for (std::size_t j = 0; j < kJointCount; ++j) share[j] += point.barycentric[k] * corner[j];
  }
  std::array<std::size_t, kJointCount> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  Attachment attachment;
  double sum = 0.0;
  for (std::size_t k = 0; k < attachment.joint.size(); ++k) {
    attachment.joint[k] = static_cast<HumanoidJoint>(order[k]);
    attachment.weight[k] = share[order[k]];
    sum += attachment.weight[k];
  }
  for (double& weight : attachment.weight) weight /= sum;
  return attachment;
}

std::uint64_t MeshHash(const Character& character) {
  Fnv1a hash;
  hash.Add(character.parts.size());
  for (const MeshPart& part : character.parts) {
    hash.Add(part.positions.size());
    for (const glm::vec3& p : part.positions) {
      hash.Add(Bits(p.x) | (std::uint64_t{Bits(p.y)} << 32));
      hash.Add(Bits(p.z));
    }
    hash.Add(part.triangles.size());
    for (const std::uint32_t index : part.triangles) hash.Add(index);
  }
  return hash.Value();
}

}  // namespace ego
