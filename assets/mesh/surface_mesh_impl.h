// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "assets/mesh/half_edges.h"
#include "assets/mesh/surface_mesh.h"
#include "core/model/mesh_bvh.h"

namespace ego {

/// What the source files of SurfaceMesh share.
struct SurfaceMesh::Impl {
  explicit Impl(const Character& character);

  struct Triangle {
    int part;
    std::uint32_t number;
  };

  const Vec3& At(std::uint32_t face, int corner) const {
    return position[welded[face][static_cast<std::size_t>(corner)]];
  }
  /// Number of a triangle in the lists below.
  std::uint32_t FaceOf(const MeshPoint& place) const {
    return first_face[static_cast<std::size_t>(place.part)] + place.triangle;
  }
  MeshPoint PlaceOn(std::uint32_t face, const Vec3& barycentric) const {
    return {triangle[face].part, triangle[face].number, barycentric};
  }
  bool Has(const MeshPoint& place) const;
  Vec3 PositionOf(const MeshPoint& place) const;
  /// Corner of a triangle on a posed mesh.
  Vec3 Posed(const PosedMesh& posed, std::uint32_t face, int corner) const;

  std::vector<Triangle> triangle;                    // of all parts, in order
  std::vector<std::uint32_t> first_face;             // per part
  std::vector<std::array<std::uint32_t, 3>> vertex;  // per face: vertices of the part
  std::vector<std::array<std::uint32_t, 3>> welded;  // per face: welded vertices
  std::vector<Vec3> position;                        // per welded vertex, canonical
  std::vector<MeshPoint> representative;             // per welded vertex
  std::optional<HalfEdges> edges;
  std::optional<MeshBvh> bvh;
  std::array<Vec3, kJointCount> joint;  // canonical
  double middle_x = 0.0;
};

}  // namespace ego
