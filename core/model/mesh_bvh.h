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
/// logarithmic time. Degenerate triangles are left out. A snapshot of one pose; Refit follows
/// another.
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

  /// Moves the triangles to their places in another pose of the same character and fits the boxes;
  /// the tree stays as it was built. As exact as a new tree and several times quicker to have;
  /// queries are slower the farther the pose is from the one it was built in.
  void Refit(const Character& character, const PosedMesh& mesh);

  /// Every crossing of the ray with a triangle, nearest first, at most `max_distance` away. Hits
  /// on a shared edge may come twice. `direction` is unit.
  std::vector<Hit> AllHits(const Vec3& origin_ws, const Vec3& direction, double max_distance) const;

  /// The nearest crossing.
  std::optional<Hit> FirstHit(const Vec3& origin_ws, const Vec3& direction,
                              double max_distance) const;

  /// Whether anything crosses the ray before `max_distance`.
  bool AnyHit(const Vec3& origin_ws, const Vec3& direction, double max_distance) const {
    return FirstHit(origin_ws, direction, max_distance).has_value();
  }

  /// Triangles whose box comes into a cone about a ray: within `radius + slope * distance` of it.
  /// Calls visit(part, triangle) for each candidate, some of them outside.
  void VisitCone(const Vec3& origin_ws, const Vec3& direction, double radius, double slope,
                 const std::function<void(int part, std::uint32_t triangle)>& visit) const;

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
  void FitLeaf(Node& node) const;
  static std::optional<Hit> Cross(const Triangle& triangle, const Vec3& origin,
                                  const Vec3& direction, double max_distance);
  /// Nearer first; at one distance by part and triangle.
  static bool Before(const Hit& a, const Hit& b);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace ego
