// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "assets/people/polygonise.h"

namespace ego {

/// A closed ball stretched to these radii; `segments` around, half as many from pole to pole.
ClosedMesh Ball(const Vec3& centre, const Vec3& radius, int segments);

/// A closed box whose edges are rounded with `round`; `half` includes the rounding. `cuts` edges
/// along each side.
ClosedMesh RoundBox(const Vec3& centre, const Vec3& half, double round, int cuts);

/// A closed tube with round ends along points, with a radius at each.
ClosedMesh Tube(const std::vector<Vec3>& points, const std::vector<double>& radius, int segments);

}  // namespace ego
