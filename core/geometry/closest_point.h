// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "core/base/math.h"

namespace ego {

/// A triangle with what every closest-point query needs, computed once per frame.
struct Triangle {
  Vec3 a{0.0};
  Vec3 b{0.0};
  Vec3 c{0.0};
  Vec3 normal{0.0};  // unit, right-handed about a, b, c; zero for a triangle without area
  double area = 0.0;
  Vec3 ab{0.0};
  Vec3 ac{0.0};

  static Triangle Of(const Vec3& a, const Vec3& b, const Vec3& c);
};

/// Barycentric coordinates (non-negative, sum one) of the point of the triangle closest to `p`.
/// Continuous in `p` and the corners. A triangle without area is treated as its edges.
Vec3 ClosestOnTriangle(const Triangle& triangle, const Vec3& p);

inline Vec3 AtBarycentric(const Triangle& triangle, const Vec3& weight) {
  return weight.x * triangle.a + weight.y * triangle.b + weight.z * triangle.c;
}

/// Parameter in [0, 1] of the point of the segment a b closest to `p`; 0 for a segment without
/// length. Continuous.
inline double ClosestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = glm::dot(d, d);
  if (!(length2 > 0.0)) return 0.0;
  return std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0);
}

/// Parameters of a closest pair of two segments.
struct SegmentPair {
  double s = 0.0;  // on the first
  double t = 0.0;  // on the second
};
/// The closest pair of a0 a1 and b0 b1. Parallel segments have many: the pair in the middle of the
/// stretch where they face each other is taken. The distance is continuous everywhere; the pair
/// moves along the segments, never off their common direction, when they pass through parallel.
SegmentPair ClosestOnSegments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

}  // namespace ego
