// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace ego {

/// Fewer triangles over the same vertices, good enough to cast a shadow: vertices in the same
/// cell of a grid, facing the same way, become the first of them, and triangles that collapse are
/// left out (Rossignac and Borrel, Multi-resolution 3D approximations, 1993). Winding is kept.
std::vector<std::uint32_t> ClusterTriangles(std::span<const glm::vec3> positions,
                                            std::span<const glm::vec3> normals,
                                            std::span<const std::uint32_t> triangles, float cell);

}  // namespace ego
