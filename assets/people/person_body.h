// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "assets/people/person_shape.h"
#include "core/body/body.h"

namespace ego {

/// All triangles of a figure in the canonical pose, with the weights of their vertices: what its
/// calibration is measured on.
struct FigureSurface {
  std::vector<Vec3> position_ms;
  std::vector<Attachment> attachment;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A point of the surface and how it follows the skeleton.
struct SkinPoint {
  Vec3 position_ms{0.0};
  Vec3 normal_ms{0.0};  // unit, outward
  Attachment attachment;
};

/// Where a ray from inside the figure comes out of it for the first time; of a ray that misses the
/// figure, the vertex nearest to its origin. The surface must not be empty.
SkinPoint PointAlong(const FigureSurface& surface, const Vec3& origin_ms, const Vec3& direction);

/// The ray that finds a sample point on a person: from inside the body through the skin.
struct SampleRay {
  Vec3 origin_ms;
  Vec3 direction;
};
SampleRay RayOf(const PersonShape& shape, SamplePoint point);

/// Mean distance from the bone to the skin around the middle of a segment: nine rings of twelve
/// rays, from 0.3 to 0.7 of its length. The paper's limb radius (section 4.2).
double MeasureRadius(const FigureSurface& surface, const Vec3& start, const Vec3& end);

/// Measures sample points, limb radii, hands and feet on the surface.
Body MeasureBody(const PersonShape& shape, const FigureSurface& surface);

}  // namespace ego
