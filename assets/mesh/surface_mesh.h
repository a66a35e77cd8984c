// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/model/character.h"
#include "core/model/mesh_point.h"

namespace ego {

/// A closed or open chain of places around a line: where a plane cuts the skin.
struct SurfaceRing {
  std::vector<MeshPoint> place;   // in order; on mesh edges
  std::vector<Vec3> position_ms;  // of each, canonical pose
  bool closed = false;            // else the skin has a gap there
  double radius = 0.0;            // mean distance from the line, weighted by length, metres
  double covered = 0.0;           // share of the full turn that it goes around the line

  /// That many places at equal distances along the ring, the first at its beginning.
  std::vector<MeshPoint> Even(std::size_t count) const;

  /// Per place: where the chain leaves that place's triangle (the same point as the next place,
  /// by the weights of this triangle).
  std::vector<MeshPoint> leave;
};

/// The connectivity of a character's skin: a half-edge mesh of all parts, vertices at one place
/// welded across seams and parts, so that one can go from the shirt to the trousers. Where three
/// triangles share an edge the third is joined to the others at its corners only: steps and
/// distances pass, walks and rings end. Positions are canonical (model space, metres) unless a
/// posed mesh is passed.
class SurfaceMesh {
 public:
  using Vertex = std::uint32_t;  // welded vertex, below VertexCount()

  explicit SurfaceMesh(const Character& character);
  ~SurfaceMesh();
  SurfaceMesh(SurfaceMesh&&) noexcept;
  SurfaceMesh& operator=(SurfaceMesh&&) noexcept;

  std::size_t VertexCount() const;
  std::size_t TriangleCount() const;
  const Vec3& Position(Vertex vertex) const;
  /// Unit, from the triangles around; zero where they cancel.
  Vec3 Normal(Vertex vertex) const;
  /// One of the mesh's corners at this vertex, the first in order of part and triangle.
  MeshPoint PlaceOf(Vertex vertex) const;
  /// The vertex nearest to a place among the corners of its triangle, and the vertex nearest to a
  /// point of the canonical pose.
  std::optional<Vertex> VertexAt(const MeshPoint& place) const;
  std::optional<Vertex> Nearest(const Vec3& point_ms) const;
  bool OnBoundary(Vertex vertex) const;
  std::vector<Vertex> Neighbours(Vertex vertex) const;

  /// One arrow key: from the vertex nearest to `place` along the mesh edge that best follows
  /// `direction` (any length but zero, in the space of `posed`; components along the surface's
  /// normal do not count). Nothing when no edge leads within 75 degrees of it: the edge of the
  /// mesh.
  std::optional<MeshPoint> Step(const MeshPoint& place, const Vec3& direction,
                                const PosedMesh& posed) const;

  /// Walks along the surface by `way` (in the space of `posed`), straight over edges as on the
  /// unfolded surface; stops at the edge of the mesh. What a drag does between two frames.
  MeshPoint Walk(const MeshPoint& place, const Vec3& way, const PosedMesh& posed) const;

  /// The place on the other side of the body's middle plane x = MiddleX(): for a vertex the
  /// nearest vertex, one that faces the mirrored way where there is, else the nearest skin.
  /// Nothing when there is none within `tolerance` metres ("no mirror vertex here").
  std::optional<MeshPoint> MirrorOf(const MeshPoint& place, double tolerance) const;
  /// Of the canonical skeleton: half-way between shoulders and between hips.
  double MiddleX() const;

  /// The loop of skin around a line, cut by the plane across it at the share t of the way from
  /// `start_ms` to `end_ms`. Of the loops that go around the line (by more than half a turn) and
  /// are at most `farthest` from it on average, the outermost of those that lie on each other: one
  /// half as far again as the one below it is loose cloth. Nothing when there is none. A segment
  /// is its bone, with half its length for `farthest`, or `thickness` where that is more (limbs as
  /// thick as they are long).
  std::optional<SurfaceRing> Ring(LimbSegment segment, double t, double thickness = 0.0) const;
  std::optional<SurfaceRing> Ring(const Vec3& start_ms, const Vec3& end_ms, double t,
                                  double farthest) const;

  /// Shortest way along mesh edges (Dijkstra), metres; infinity where there is none, and beyond
  /// `limit`. Never less than the true geodesic distance.
  double GeodesicDistance(const MeshPoint& from, const MeshPoint& to, double limit = 1e30) const;
  std::vector<double> GeodesicDistances(Vertex from, double limit = 1e30) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
