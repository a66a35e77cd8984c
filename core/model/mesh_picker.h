// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/base/math.h"
#include "core/model/character.h"
#include "core/model/mesh_bvh.h"
#include "core/model/mesh_point.h"

namespace ego {

/// What lies under a cursor: the ray through the cursor's middle and how thick the cursor is.
/// World space, metres. A perspective camera has radius 0 and slope = tan of the cursor's half
/// angle, an orthographic one has slope 0.
struct PickCone {
  Vec3 origin_ws{0.0};
  Vec3 direction{0.0, 0.0, -1.0};  // unit
  double radius = 0.0;             // at the origin
  double slope = 0.0;              // by which the radius grows per metre
};

struct VertexPick {
  MeshPoint place;           // at a corner
  std::uint32_t vertex = 0;  // of Character::parts[place.part]
  Vec3 position_ws{0.0};
  double off_axis = 0.0;  // distance from the ray, in cursor radii
};

/// Picks on the skinned mesh in any pose. The tree over the triangles is built once, in the
/// canonical pose, and refitted to each new pose: a frame's work on 100 k triangles.
class MeshPicker {
 public:
  explicit MeshPicker(std::shared_ptr<const Character> character);

  /// Skins the mesh; `node_global` as PoseNodes writes it. The canonical pose until then.
  void SetPose(std::span<const Mat4> node_global);
  void SetPose(const ModelPose& pose);

  /// The nearest skin on a ray, both sides of every triangle. `direction` is unit.
  std::optional<MeshBvh::Hit> Pick(const Vec3& origin_ws, const Vec3& direction) const;

  /// The vertex that a click would take: of the visible vertices inside the cone the one nearest
  /// to its axis; where none is inside, the nearest to the axis of the corners of the triangle
  /// hit (visible or not: of a corner behind its own triangle's edge one sees the triangle);
  /// nothing where the ray misses the character too. Vertices at one place count once, the one
  /// with the lowest part and number.
  std::optional<VertexPick> NearestVertex(const PickCone& cone) const;

  /// Whether nothing lies between the eye and a place of the skin. For an orthographic camera the
  /// eye is far off against the view direction.
  bool Visible(const Vec3& eye_ws, const Vec3& position_ws) const;

  /// The skinned positions of the present pose.
  const PosedMesh& Mesh() const { return mesh_; }
  /// Where a place of the skin is in the present pose, and the normal of its triangle.
  Vec3 Position(const MeshPoint& place) const;
  Vec3 Normal(const MeshPoint& place) const;
  const Character& TheCharacter() const { return *character_; }

 private:
  std::shared_ptr<const Character> character_;
  PosedMesh mesh_;
  MeshBvh bvh_;
};

}  // namespace ego
