// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/model/character.h"

namespace ego {

/// A character's mesh in one degree of detail. Vertices are shared between the levels: a coarser
/// one uses the first of those that a finer one uses.
struct DetailLevel {
  struct Part {
    std::uint32_t vertex_count = 0;  // from the part's first on
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint32_t first_shadow_index = 0;  // coarser still, over the same vertices
    std::uint32_t shadow_index_count = 0;
  };
  float error = 0.0f;  // how far the surface is off, units of the mesh
  std::vector<Part> parts;
};

/// Every level of a character, the finest first: level 0 has all its triangles.
struct DetailLevels {
  std::vector<DetailLevel> levels;
  std::vector<std::uint32_t> indices;  // of all levels, counted from each part's first vertex
  /// Per part: which vertex comes where in the shared order.
  std::vector<std::vector<std::uint32_t>> order;
};

/// Halves the triangles again and again by collapsing edges in the order of their quadric error
/// (Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997). Parts that
/// meet in vertices of equal position stay closed there; borders between them keep their lines.
/// The parts' indices must be in range. Levels end where nothing can be collapsed any more, or the
/// shape would be lost.
DetailLevels MakeDetailLevels(std::span<const MeshPart> parts);

}  // namespace ego
