// SPDX-License-Identifier: MIT
#include "core/geometry/closest_point.h"

#include <algorithm>
#include <cmath>

namespace ego {

Triangle Triangle::Of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Triangle triangle;
  triangle.a = a;
  triangle.b = b;
  triangle.c = c;
  triangle.ab = b - a;
  triangle.ac = c - a;
  const Vec3 normal = glm::cross(triangle.ab, triangle.ac);
  const double length = glm::length(normal);
  triangle.area = 0.5 * length;
  if (length > 0.0) triangle.normal = normal / length;
  return triangle;
}

Vec3 ClosestOnTriangle(const Triangle& triangle, const Vec3& p) {
  // Ericson, Real-Time Collision Detection, 5.1.5: by the Voronoi region of the projection.
  const Vec3& ab = triangle.ab;
  const Vec3& ac = triangle.ac;
  const Vec3 ap = p - triangle.a;
  const double d1 = glm::dot(ab, ap);
  const double d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};

  const Vec3 bp = p - triangle.b;
  const double d3 = glm::dot(ab, bp);
  const double d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 > d3 ? d1 / (d1 - d3) : 0.0;
    return {1.0 - v, v, 0.0};
  }

  const Vec3 cp = p - triangle.c;
  const double d5 = glm::dot(ab, cp);
  const double d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 > d6 ? d2 / (d2 - d6) : 0.0;
    return {1.0 - w, 0.0, w};
  }

  const double va = d3 * d6 - d5 * d4;
  const double along = d4 - d3;
  const double beyond = d5 - d6;
  if (va <= 0.0 && along >= 0.0 && beyond >= 0.0) {
    const double w = along + beyond > 0.0 ? along / (along + beyond) : 0.0;
    return {0.0, 1.0 - w, w};
  }

  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return {1.0, 0.0, 0.0};
  return {va / sum, vb / sum, vc / sum};
}

SegmentPair ClosestOnSegments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 u = a1 - a0;
  const Vec3 v = b1 - b0;
  const Vec3 w = a0 - b0;
  const double uu = glm::dot(u, u);
  const double vv = glm::dot(v, v);
  if (!(uu > 0.0)) return {0.0, ClosestOnSegment(a0, b0, b1)};
  if (!(vv > 0.0)) return {ClosestOnSegment(b0, a0, a1), 0.0};
  const double uv = glm::dot(u, v);
  const double uw = glm::dot(u, w);
  const double vw = glm::dot(v, w);
  const double denominator = uu * vv - uv * uv;
  double s = 0.0;
  if (denominator > 1e-12 * uu * vv) {
    s = std::clamp((uv * vw - vv * uw) / denominator, 0.0, 1.0);
  } else {
    // Parallel: the middle of the stretch of a that b projects on.
    const double p0 = -uw / uu;
    const double p1 = (uv - uw) / uu;
    const double low = std::clamp(std::min(p0, p1), 0.0, 1.0);
    const double high = std::clamp(std::max(p0, p1), 0.0, 1.0);
    s = 0.5 * (low + high);
  }
  double t = (uv * s + vw) / vv;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  }
  return {s, t};
}

}  // namespace ego
