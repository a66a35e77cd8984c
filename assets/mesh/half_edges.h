// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ego {

/// Half-edge connectivity of any heap of triangles over numbered vertices. A triangle that cannot
/// be joined to what is there already (a third one at an edge, a vertex where two surfaces touch)
/// stands alone; one that is wound against its neighbours is joined all the same.
class HalfEdges {
 public:
  /// An edge of a triangle: from its corner `edge` to corner (edge + 1) % 3.
  struct FaceEdge {
    std::uint32_t face = 0;
    int edge = 0;
  };

  /// Triangles name vertices below `vertex_count`; those that name one twice have no edges.
  HalfEdges(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t vertex_count);
  ~HalfEdges();
  HalfEdges(HalfEdges&&) noexcept;
  HalfEdges& operator=(HalfEdges&&) noexcept;

  /// The same edge as its other triangle has it; nothing at the edge of the mesh.
  std::optional<FaceEdge> Across(FaceEdge from) const;
  /// Vertices joined to this one by an edge, each once.
  std::vector<std::uint32_t> Neighbours(std::uint32_t vertex) const;
  /// Triangles that have this corner.
  std::vector<std::uint32_t> FacesAround(std::uint32_t vertex) const;
  /// Whether an edge with one triangle only ends here.
  bool OnBoundary(std::uint32_t vertex) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
