// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace ego {

/// A part of a figure that is unwrapped as one: a cylinder about its axis, cut open at the back of
/// it. Without a direction there is only the box around it.
struct UvPiece {
  Vec3 origin{0.0};
  Vec3 direction{0.0};  // unit, or zero
};

/// Texture coordinates of a figure: each piece is unrolled about its axis; what looks along the
/// axis, and pieces without one, are projected along the six directions of the coordinate axes.
/// Charts lie side by side in the unit square at one scale. Each triangle keeps a good part of its
/// area, so none that has one is without one in the atlas.
struct UvAtlas {
  std::vector<std::uint32_t> chart;          // of each triangle
  std::vector<std::array<glm::vec2, 3>> uv;  // of each triangle's corners, in [0, 1]
};

/// `piece` says per triangle which of the pieces it belongs to.
UvAtlas MakeUvAtlas(std::span<const Vec3> positions,
                    std::span<const std::array<std::uint32_t, 3>> triangles,
                    std::span<const std::uint16_t> piece, std::span<const UvPiece> pieces);

}  // namespace ego
