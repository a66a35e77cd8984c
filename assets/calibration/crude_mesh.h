// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/body/body_surface.h"

namespace ego {

/// Places of all samples, canonical pose, metres.
using SamplePlaces = std::array<Vec3, kSampleCount>;

/// How sound each crude triangle is: 1 for one that faces as the template's (`usual`) does and is
/// no sliver, 0 for one without area (below 2 % of its longest edge squared), negative for one that
/// faces inward, seen from the template and from the middle of its mesh alike.
std::array<double, kTriangleCount> Soundness(const SamplePlaces& places, const SamplePlaces& usual);

/// Pairs of triangles of one crude mesh that have no corner in common and cut through each other.
std::vector<std::pair<std::size_t, std::size_t>> CrossingTriangles(const SamplePlaces& places);

}  // namespace ego
