// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "core/model/character.h"

namespace ego {

/// node_global[entry.node] * entry.inverse_bind, moved by `offset_ws`, for every palette entry.
/// `matrices` has one per entry.
void SkinningPalette(const Character& character, std::span<const Mat4> node_global,
                     const Vec3& offset_ws, std::span<glm::mat4> matrices);

/// A mesh part in the layout that linear blend skinning reads fastest: influences of weight zero
/// left out.
class SkinnedMesh {
 public:
  SkinnedMesh() = default;
  explicit SkinnedMesh(const MeshPart& part);
  /// The vertices in another order: which of the part's comes first, second...
  SkinnedMesh(const MeshPart& part, std::span<const std::uint32_t> order);

  std::size_t VertexCount() const { return bind_position_.size(); }

  /// Positions and unit normals in the palette's space of the first vertices, as many as both have
  /// places (VertexCount() at most). Normals follow the blended matrix, which is exact for
  /// rotations with uniform scale and mirrors.
  void Skin(std::span<const glm::mat4> palette, std::span<glm::vec3> positions,
            std::span<glm::vec3> normals) const;

  /// True when the palette mirrors the mesh, so that its triangles wind the other way.
  bool IsMirrored(std::span<const glm::mat4> palette) const;

 private:
  struct Influence {
    std::uint16_t entry;
    float weight;
  };
  std::vector<glm::vec3> bind_position_;
  std::vector<glm::vec3> bind_normal_;
  std::vector<std::uint32_t> first_;  // one more than vertices
  std::vector<Influence> influences_;
};

}  // namespace ego
