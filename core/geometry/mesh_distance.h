// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/geometry/triangle_quad.h"

namespace ego {

/// A signed distance and the direction in which it grows.
struct SignedDistance {
  double distance = 0.0;
  Vec3 gradient{0.0};  // about unit length near the surface
};

/// Smooth signed distance of `p` from a closed triangle mesh (outward normals), negative inside.
///
/// A mean over the triangles with the weights A (e^2 / (q + e^2))^4, q the squared distance: near
/// the surface of the signed distances to the triangles' planes, away from it of the unsigned
/// distances, where planes seen from the side would lie about the sign. `epsilon` (metres) is the
/// width of the smoothing; beyond `width` (metres, about half the mesh's own) only the unsigned
/// distance counts. Infinitely differentiable but where closest points change their feature.
/// Triangles without area fill the last four. The same bits for any `lanes`.
SignedDistance SmoothMeshDistance(std::span<const TriangleQuad> mesh, const Vec3& p, double epsilon,
                                  double width, LaneWidth lanes = FastestLanes());

/// Axis-aligned box of a mesh's vertices, to leave out what is far.
struct Box {
  Vec3 low{0.0};
  Vec3 high{0.0};
  static Box Of(std::span<const Vec3> points);
  /// Never more than the distance to the mesh.
  double Distance(const Vec3& p) const {
    return glm::length(glm::max(Vec3{0.0}, glm::max(low - p, p - high)));
  }
};

}  // namespace ego
