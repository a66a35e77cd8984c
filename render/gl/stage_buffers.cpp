// SPDX-License-Identifier: MIT
#include "render/gl/stage_buffers.h"

#include <array>
#include <cstddef>

namespace ego::gl {
namespace {

void Fill(GLenum target, const Buffer& buffer, const void* data, std::size_t bytes, GLenum usage) {
  glBindBuffer(target, buffer.Name());
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, usage);
}

template <class T>
void Stream(GLenum target, const Buffer& buffer, std::span<const T> data) {
  Fill(target, buffer, data.data(), data.size_bytes(), GL_STREAM_DRAW);
}

const void* Offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

void Attribute(GLuint index, GLint components, std::size_t stride, std::size_t offset,
               GLuint divisor = 0) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        Offset(offset));
  glVertexAttribDivisor(index, divisor);
}

}  // namespace

void StageBuffers::Create() {
  for (VertexArray* array :
       {&mesh_array_, &square_array_, &spot_array_, &floor_array_, &plate_array_}) {
    *array = VertexArray::Make();
  }
  for (Buffer* buffer : {&positions_, &normals_, &uvs_, &indices_, &square_, &spots_, &plates_,
                         &floor_, &floor_indices_}) {
    *buffer = Buffer::Make();
  }

  glBindVertexArray(mesh_array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.Name());
  Attribute(0, 3, sizeof(glm::vec3), 0);
  glBindBuffer(GL_ARRAY_BUFFER, normals_.Name());
  Attribute(1, 3, sizeof(glm::vec3), 0);
  glBindBuffer(GL_ARRAY_BUFFER, uvs_.Name());
  Attribute(2, 2, sizeof(glm::vec2), 0);

  constexpr std::array<glm::vec2, 4> kSquare = {glm::vec2{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  glBindVertexArray(square_array_.Name());
  Fill(GL_ARRAY_BUFFER, square_, kSquare.data(), sizeof(kSquare), GL_STATIC_DRAW);
  Attribute(0, 2, sizeof(glm::vec2), 0);
  glBindVertexArray(spot_array_.Name());
  Attribute(0, 2, sizeof(glm::vec2), 0);

  glBindVertexArray(floor_array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, floor_.Name());
  Attribute(0, 2, sizeof(glm::vec2), 0);

  glBindVertexArray(plate_array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, plates_.Name());
  Attribute(0, 3, sizeof(PlateVertex), offsetof(PlateVertex, position));
  Attribute(1, 2, sizeof(PlateVertex), offsetof(PlateVertex, local));
  Attribute(2, 4, sizeof(PlateVertex), offsetof(PlateVertex, shape));
  Attribute(3, 2, sizeof(PlateVertex), offsetof(PlateVertex, uv));
  Attribute(4, 4, sizeof(PlateVertex), offsetof(PlateVertex, color));
  glBindVertexArray(0);

  glyphs_ = Texture::Make();
  glBindTexture(GL_TEXTURE_2D, glyphs_.Name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void StageBuffers::Upload(const DrawList& list) {
  Stream(GL_ARRAY_BUFFER, positions_, std::span(list.positions));
  Stream(GL_ARRAY_BUFFER, normals_, std::span(list.normals));
  Stream(GL_ARRAY_BUFFER, uvs_, std::span(list.uvs));
  shadow_spots_ = list.contact_shadows.size();
  glow_spots_ = list.glows.size();
  std::vector<DrawList::Spot> spots = list.contact_shadows;
  spots.insert(spots.end(), list.glows.begin(), list.glows.end());
  Stream(GL_ARRAY_BUFFER, spots_, std::span<const DrawList::Spot>(spots));
  // The element array is part of the vertex array's state.
  glBindVertexArray(mesh_array_.Name());
  Stream(GL_ELEMENT_ARRAY_BUFFER, indices_, std::span(list.indices));
  glBindVertexArray(0);
}

void StageBuffers::UploadPlates(std::span<const PlateVertex> vertices, TextAtlas& atlas) {
  Stream(GL_ARRAY_BUFFER, plates_, vertices);
  plate_vertices_ = static_cast<GLsizei>(vertices.size());
  if (!atlas.TakeChanged()) return;
  glBindTexture(GL_TEXTURE_2D, glyphs_.Name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, TextAtlas::kSide, TextAtlas::kSide, 0, GL_RED,
               GL_UNSIGNED_BYTE, atlas.Pixels().data());
}

void StageBuffers::DrawMesh(const DrawList::Mesh& mesh, bool as_shadow,
                            const CharacterBuffers* character) const {
  const std::uint32_t first = as_shadow ? mesh.first_shadow_index : mesh.first_index;
  const std::uint32_t count = as_shadow ? mesh.shadow_index_count : mesh.index_count;
  glBindVertexArray(mesh_array_.Name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER,
               character != nullptr ? character->indices.Name() : indices_.Name());
  glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                           Offset(first * sizeof(std::uint32_t)),
                           static_cast<GLint>(mesh.first_vertex));
}

void StageBuffers::DrawSpots(bool glows) const {
  const std::size_t count = glows ? glow_spots_ : shadow_spots_;
  if (count == 0) return;
  glBindVertexArray(spot_array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, spots_.Name());
  const std::size_t base = glows ? shadow_spots_ * sizeof(DrawList::Spot) : 0;
  Attribute(3, 4, sizeof(DrawList::Spot), base + offsetof(DrawList::Spot, center), 1);
  Attribute(4, 4, sizeof(DrawList::Spot), base + offsetof(DrawList::Spot, color), 1);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
}

void StageBuffers::DrawSquare() const {
  glBindVertexArray(square_array_.Name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void StageBuffers::UploadFloor(std::span<const float> x, std::span<const float> z,
                               std::span<const std::uint8_t> shaded) {
  std::vector<glm::vec2> corners;
  for (const float along_z : z) {
    for (const float along_x : x) corners.emplace_back(along_x, along_z);
  }
  std::vector<std::uint16_t> cells;
  const auto append = [&](bool wanted) {
    for (std::size_t row = 0; row + 1 < z.size(); ++row) {
      for (std::size_t column = 0; column + 1 < x.size(); ++column) {
        if ((shaded[row * (x.size() - 1) + column] != 0) != wanted) continue;
        const std::size_t a = row * x.size() + column;
        const std::size_t c = a + x.size();
        for (const std::size_t corner : {a, c, a + 1, a + 1, c, c + 1}) {  // seen from above
          cells.push_back(static_cast<std::uint16_t>(corner));
        }
      }
    }
    return static_cast<GLsizei>(cells.size());
  };
  shaded_floor_indices_ = append(true);
  plain_floor_indices_ = append(false) - shaded_floor_indices_;
  Stream(GL_ARRAY_BUFFER, floor_, std::span<const glm::vec2>(corners));
  glBindVertexArray(floor_array_.Name());
  Stream(GL_ELEMENT_ARRAY_BUFFER, floor_indices_, std::span<const std::uint16_t>(cells));
}

void StageBuffers::DrawFloor(bool shaded) const {
  glBindVertexArray(floor_array_.Name());
  const std::size_t first = shaded ? 0 : static_cast<std::size_t>(shaded_floor_indices_);
  glDrawElements(GL_TRIANGLES, shaded ? shaded_floor_indices_ : plain_floor_indices_,
                 GL_UNSIGNED_SHORT, Offset(first * sizeof(std::uint16_t)));
}

void StageBuffers::DrawPlates() const {
  glBindVertexArray(plate_array_.Name());
  glDrawArrays(GL_TRIANGLES, 0, plate_vertices_);
}

}  // namespace ego::gl
