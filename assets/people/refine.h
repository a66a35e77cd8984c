// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "assets/people/polygonise.h"

namespace ego {

/// Splits edges of a closed mesh that are longer than `longest_edge` at their middle, draws the new
/// vertices onto the surface and evens them out along it, so that small things (eyes, lips, finger
/// tips) get the triangles they need. Stays a closed 2-manifold. `rounds` bounds the work: one
/// halves the edges.
void Refine(const ImplicitSurface& surface, const std::function<double(const Vec3&)>& longest_edge,
            int rounds, ClosedMesh& mesh);

}  // namespace ego
