// SPDX-License-Identifier: MIT
#include "render/skinning.h"

#include <cmath>
#include <numeric>

#include "core/base/check.h"

namespace ego {

void SkinningPalette(const Character& character, std::span<const Mat4> node_global,
                     const Vec3& offset_ws, std::span<glm::mat4> matrices) {
  EGO_CHECK(matrices.size() == character.palette.size());
  for (std::size_t i = 0; i < character.palette.size(); ++i) {
    const PaletteEntry& entry = character.palette[i];
    Mat4 m = node_global[static_cast<std::size_t>(entry.node)] * entry.inverse_bind;
    m[3] += Vec4{offset_ws, 0.0};
    matrices[i] = glm::mat4(m);
  }
}

SkinnedMesh::SkinnedMesh(const MeshPart& part) {
  std::vector<std::uint32_t> order(part.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  *this = SkinnedMesh(part, order);
}

SkinnedMesh::SkinnedMesh(const MeshPart& part, std::span<const std::uint32_t> order) {
  first_.reserve(order.size() + 1);
  first_.push_back(0);
  for (const std::uint32_t v : order) {
    bind_position_.push_back(part.positions[v]);
    bind_normal_.push_back(v < part.normals.size() ? part.normals[v] : glm::vec3{0.0f, 1.0f, 0.0f});
    if (v < part.influences.size()) {
      const MeshPart::Influences& all = part.influences[v];
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (all.weight[k] != 0.0f) influences_.push_back({all.entry[k], all.weight[k]});
      }
    }
    first_.push_back(static_cast<std::uint32_t>(influences_.size()));
  }
}

void SkinnedMesh::Skin(std::span<const glm::mat4> palette, std::span<glm::vec3> positions,
                       std::span<glm::vec3> normals) const {
  EGO_CHECK(positions.size() <= VertexCount() && normals.size() == positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    glm::vec4 x{0.0f}, y{0.0f}, z{0.0f}, t{0.0f};
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
      const glm::mat4& m = palette[influences_[i].entry];
      const float w = influences_[i].weight;
      x += w * m[0];
      y += w * m[1];
      z += w * m[2];
      t += w * m[3];
    }
    const glm::vec3& p = bind_position_[v];
    const glm::vec3& n = bind_normal_[v];
    positions[v] = glm::vec3(x * p.x + y * p.y + z * p.z + t);
    const glm::vec3 turned(x * n.x + y * n.y + z * n.z);
    const float length_squared = glm::dot(turned, turned);
    normals[v] =
        length_squared > 1e-30f ? turned / std::sqrt(length_squared) : glm::vec3{0.0f, 1.0f, 0.0f};
  }
}

bool SkinnedMesh::IsMirrored(std::span<const glm::mat4> palette) const {
  return !influences_.empty() &&
         glm::determinant(glm::mat3(palette[influences_.front().entry])) < 0.0f;
}

}  // namespace ego
