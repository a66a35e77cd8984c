// SPDX-License-Identifier: MIT
#include "render/shadow_mesh.h"

#include <array>
#include <cmath>
#include <map>

namespace ego {

std::vector<std::uint32_t> ClusterTriangles(std::span<const glm::vec3> positions,
                                            std::span<const glm::vec3> normals,
                                            std::span<const std::uint32_t> triangles, float cell) {
  if (!(cell > 0.0f)) return {triangles.begin(), triangles.end()};
  std::map<std::array<int, 4>, std::uint32_t> first_in;
  std::vector<std::uint32_t> representative(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::vec3 p = glm::clamp(positions[v] / cell, -1e8f, 1e8f);
    int octant = 0;
    if (v < normals.size()) {
      const glm::vec3& n = normals[v];
      octant = (n.x > 0.0f ? 1 : 0) + (n.y > 0.0f ? 2 : 0) + (n.z > 0.0f ? 4 : 0);
    }
    const std::array<int, 4> key = {static_cast<int>(std::floor(p.x)),
                                    static_cast<int>(std::floor(p.y)),
                                    static_cast<int>(std::floor(p.z)), octant};
    representative[v] = first_in.try_emplace(key, static_cast<std::uint32_t>(v)).first->second;
  }
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::uint32_t a = representative[triangles[i]];
    const std::uint32_t b = representative[triangles[i + 1]];
    const std::uint32_t c = representative[triangles[i + 2]];
    if (a != b && b != c && c != a) kept.insert(kept.end(), {a, b, c});
  }
  return kept;
}

}  // namespace ego
