// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "assets/people/person_shape.h"
#include "assets/people/polygonise.h"

namespace ego {

/// Divides a mesh where the region changes: new vertices on the edges that cross a border, so that
/// every triangle lies in one region and the mesh stays closed. Returns the triangles' regions.
std::vector<Region> CutByRegion(ClosedMesh& mesh, const std::function<Region(const Vec3&)>& region);

}  // namespace ego
