// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/math.h"

namespace ego {

/// Signed distance, roughly, negative inside.
using ImplicitSurface = std::function<double(const Vec3&)>;

/// Moves a point onto the surface by Newton steps along the gradient, none longer than `bound`.
Vec3 DrawOnto(const ImplicitSurface& surface, Vec3 point, double bound, int steps);

/// Where an implicit surface is sampled: the planes of a rectilinear lattice, bent into space by
/// `place` (one to one, so that small things such as fingers can get a denser lattice).
struct SampleLattice {
  std::vector<double> x, y, z;  // increasing
  std::function<Vec3(const Vec3&)> place = [](const Vec3& p) { return p; };
};

/// A lattice of equal cells that covers a box.
SampleLattice UniformLattice(const Vec3& low, const Vec3& high, double cell);

struct ClosedMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

/// The zero set as a closed mesh by surface nets (Gibson 1998): one vertex per lattice cell that
/// the surface crosses, drawn onto the surface and evened out along it. Always a closed 2-manifold:
/// samples are first made well-composed (Latecki 1997), by turning the fewest outside samples
/// inside where the lattice cannot tell two sheets apart. What lies outside the lattice is cut off.
ClosedMesh Polygonise(const ImplicitSurface& surface, const SampleLattice& lattice);

}  // namespace ego
