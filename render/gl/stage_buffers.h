// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/draw_list.h"
#include "render/gl/handle.h"
#include "render/plate_layout.h"
#include "render/text_atlas.h"

namespace ego::gl {

/// What a loaded character keeps on the graphics side: indices and pictures. Its vertices are
/// skinned by the processor and streamed each frame.
struct CharacterBuffers {
  Buffer indices;
  std::vector<Texture> images;  // as Character::images
};

/// The vertex data of one picture, uploaded anew each time, and how shaders read it.
class StageBuffers {
 public:
  void Create();
  void Upload(const DrawList& list);
  void UploadPlates(std::span<const PlateVertex> vertices, TextAtlas& atlas);

  /// Draws a mesh, or its coarser one that casts the shadow, with the indices of its character
  /// (null: the list's own).
  void DrawMesh(const DrawList::Mesh& mesh, bool as_shadow,
                const CharacterBuffers* character) const;
  void DrawSpots(bool glows) const;
  void DrawSquare() const;
  /// The floor as cells that share their corners, between these lines; `shaded` tells row by row
  /// along z which of them a shadow can reach.
  void UploadFloor(std::span<const float> x, std::span<const float> z,
                   std::span<const std::uint8_t> shaded);
  /// The cells that are shaded, or all the others.
  void DrawFloor(bool shaded) const;
  void DrawPlates() const;
  GLuint GlyphTexture() const { return glyphs_.Name(); }

 private:
  VertexArray mesh_array_, square_array_, spot_array_, floor_array_, plate_array_;
  Buffer positions_, normals_, uvs_, indices_;
  Buffer square_, spots_, plates_, floor_, floor_indices_;
  Texture glyphs_;
  std::size_t shadow_spots_ = 0, glow_spots_ = 0;
  GLsizei plate_vertices_ = 0;
  GLsizei shaded_floor_indices_ = 0, plain_floor_indices_ = 0;
};

}  // namespace ego::gl
