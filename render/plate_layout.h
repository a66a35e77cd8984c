// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/draw_list.h"
#include "render/text_atlas.h"

namespace ego {

/// A corner of a rectangle as shaders/plate.vert takes it.
struct PlateVertex {
  glm::vec3 position;  // normalised device coordinates
  glm::vec2 local;     // pixels from the rectangle's middle
  glm::vec4 shape;     // half width, half height, corner radius, 1 for a glyph
  glm::vec2 uv;
  glm::vec4 color;  // sRGB, with opacity
};

/// Lays name plates out at their anchors, far ones first: a mark in the figure's colour and the
/// name on a quiet ground. Crisp: on whole pixels, at the monitor's scale. Plates that would cover
/// each other give way, and none leaves the picture by its lower edge or its sides; anchors outside
/// the picture have no plate. Appends two triangles per rectangle.
void LayoutPlates(std::span<const DrawList::Plate> plates, const Camera& camera, ViewportSize size,
                  float content_scale, TextAtlas& atlas, std::vector<PlateVertex>& out);

}  // namespace ego
