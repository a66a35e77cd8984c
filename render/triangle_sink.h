// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/math.h"

namespace ego {

/// Where triangles to draw are collected: world space, metres, counter-clockwise from outside.
struct TriangleSink {
  std::vector<glm::vec3>& positions;
  std::vector<glm::vec3>& normals;      // unit
  std::vector<std::uint32_t>& indices;  // counted from `first_vertex`
  std::size_t first_vertex = 0;         // where the mesh begins in `positions`
  double smallest = 0.0;                // metres that a round surface may be off; 0: at its best

  std::uint32_t Next() const { return static_cast<std::uint32_t>(positions.size() - first_vertex); }
};

/// How round a capsule is.
enum class Roundness { kLimb, kBone };

/// A capsule between two balls; radii may differ (a bone), ends may coincide (a ball).
void AppendCapsule(const Vec3& end_a, double radius_a, const Vec3& end_b, double radius_b,
                   Roundness roundness, TriangleSink& sink);

}  // namespace ego
