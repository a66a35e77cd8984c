// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/math.h"
#include "core/model/rig.h"
#include "core/skeleton/humanoid_map.h"
#include "core/skeleton/joint_tree.h"

namespace ego {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // width * height * 4, sRGB, first row at the top
};

struct Material {
  std::string name;
  glm::vec4 base_color{1.0f};  // linear, multiplies the image
  int base_color_image = -1;   // into Character::images
  bool double_sided = false;
  bool alpha_mask = false;  // discard below alpha_cutoff
  float alpha_cutoff = 0.5f;
  bool blend = false;
};

/// One drawable piece. Positions are in the file's bind space and units; a vertex is placed by
/// sum of weight * node_global[palette.node] * palette.inverse_bind * position, whatever the unit
/// (the rig's node transforms carry the scale to metres).
struct MeshPart {
  std::string name;
  int material = -1;  // into Character::materials
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit; computed when the file has none
  std::vector<glm::vec2> uvs;      // empty or one per vertex
  /// Up to eight influences per vertex, indices into Character::palette; weights sum to one.
  static constexpr std::size_t kInfluences = 8;
  struct Influences {
    std::array<std::uint16_t, kInfluences> entry{};
    std::array<float, kInfluences> weight{};
  };
  std::vector<Influences> influences;    // one per vertex
  std::vector<std::uint32_t> triangles;  // three per triangle, within range
};

/// One skin joint of the character: rigid meshes have one of their own with an identity-like
/// inverse bind matrix.
struct PaletteEntry {
  int node = 0;
  Mat4 inverse_bind{1.0};
};

/// A rigged character as a loader hands it over, ready to be posed and drawn.
struct Character {
  std::string name;
  std::string source_path;  // the file it came from; empty for generated ones
  JointTree nodes;          // every node of the file's scene, parents first
  std::vector<PaletteEntry> palette;
  std::vector<MeshPart> parts;
  std::vector<Material> materials;
  std::vector<Image> images;
  HumanoidMap map;
  Rig rig;
  std::vector<std::string> notes;  // sentences for the user: doubtful joints, guessed units
};

}  // namespace ego
