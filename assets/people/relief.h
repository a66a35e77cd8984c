// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "assets/people/polygonise.h"
#include "assets/people/region.h"

namespace ego {

/// How far a region stands out beside another one, metres, and over which width along the surface
/// it falls back to the common surface (zero: nowhere, the whole region stands out).
struct Lift {
  double height = 0.0;
  double fade = 0.0;
};
using LiftBeside = std::function<Lift(Region region, Region other)>;

/// A closed mesh whose regions end in steps: hems, cuffs, soles, lids.
struct ReliefMesh {
  ClosedMesh mesh;
  std::vector<Region> regions;        // of triangles
  std::vector<bool> step;             // of triangles: part of a step between regions
  std::vector<std::uint32_t> source;  // of vertices: the vertex of the plain mesh it was
  std::vector<Vec3> normals;          // of vertices, unit; steps apart
};

/// Raises the regions of a closed mesh over one another. `normals` are those of the plain
/// surface; vertices move along them (soles: level). The result is closed as the mesh was.
ReliefMesh Relieve(const ClosedMesh& mesh, std::span<const Region> regions,
                   std::span<const Vec3> normals, const LiftBeside& lift);

}  // namespace ego
