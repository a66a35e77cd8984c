// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/model/character.h"
#include "core/skeleton/pose.h"

namespace ego::test {

/// The skin of a character as one list of triangles, written without the code that it judges.
struct Skin {
  std::vector<Vec3> position;
  std::vector<std::array<std::size_t, 3>> triangles;
  /// How much of each vertex every humanoid joint carries.
  std::vector<std::array<double, kJointCount>> share;
};

/// All vertices of all parts one after the other, linear blend skinning in double precision, world
/// space.
Skin SkinOf(const Character& character, const Pose& pose);

/// In the canonical pose, vertices of equal position made one.
Skin WeldedSkinOf(const Character& character);
/// The same skin where another pose puts it: every weld is of vertices with equal weights.
Skin WeldedSkinOf(const Character& character, const Pose& pose);

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Where a ray crosses a triangle, by its plane and the sides of its edges: the distance in lengths
/// of `direction`, nothing where it does not.
std::optional<double> CrossingOf(const Vec3& origin, const Vec3& direction, const Vec3& a,
                                 const Vec3& b, const Vec3& c);

/// To the nearest triangle.
double DistanceTo(const Vec3& p, const Skin& skin);

/// Whether a point lies in a closed skin: its triangles together fill the whole sphere around it
/// (sum of solid angles, Van Oosterom and Strackee 1983).
bool IsInside(const Vec3& p, const Skin& skin);

/// Volume that the triangles enclose, cubic metres.
double VolumeOf(const Skin& skin);

}  // namespace ego::test
