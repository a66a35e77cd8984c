// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace ego {

/// The capsule that shaders/capsule.vert bends into shape: xyz the unit direction from the end's
/// centre (axis along y), w which end. Triangles are counter-clockwise seen from outside.
struct CapsuleMesh {
  std::vector<glm::vec4> points;
  std::vector<std::uint16_t> indices;
};

/// `slices` around the axis, `rings` from each pole to its equator.
CapsuleMesh MakeCapsuleMesh(int slices, int rings);

}  // namespace ego
