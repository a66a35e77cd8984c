// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/model/character.h"
#include "core/model/mesh_point.h"

namespace ego {

/// Bounding volume hierarchy over the triangles of a posed character: rays and nearest points in
/// logarithmic time. Degenerate triangles are left out. A snapshot: build again for another pose.
class MeshBvh {
 public:
  /// Only triangles that `use` accepts (all when empty) are put in.
  using TriangleFilter = std::function<bool(int part, std::uint32_t triangle)>;
  MeshBvh(const Character& character, const PosedMesh& mesh, const TriangleFilter& use = {});

  struct Hit {
    MeshPoint place;
    Vec3 position_ws{0.0};
    Vec3 normal_ws{0.0};    // of the triangle, unit, by its winding
    double distance = 0.0;  // along the ray; to the query point
  };

  /// Every crossing of the ray with a triangle, nearest first, at most `max_distance` away. Hits
  /// on a shared edge may come twice. `direction` is unit.
  std::vector<Hit> AllHits(const Vec3& origin_ws, const Vec3& direction, double max_distance) const;

  /// The nearest crossing.
  std::optional<Hit> FirstHit(const Vec3& origin_ws, const Vec3& direction,
                              double max_distance) const;

  /// The place of the skin nearest to a point; nothing when there are no triangles.
  std::optional<Hit> Nearest(const Vec3& point_ws) const;

  bool Empty() const { return triangles_.empty(); }

 private:
  struct Triangle {
    Vec3 a, b, c;
    int part;
    std::uint32_t index;
  };
  struct Node {
    Vec3 low, high;
    // A leaf holds triangles [first, first + count); an inner node has count 0, its left child
    // follows it and its right child is at `first`.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  void Build(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace ego
