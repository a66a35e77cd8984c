// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/math.h"

namespace ego::field {

/// Building blocks of implicit surfaces: signed distances, exact or nearly so close to the surface,
/// negative inside (after I. Quilez, "Distance functions").

/// Cubic curve through points that keeps their monotony (Fritsch and Carlson 1980); constant
/// beyond both ends.
class Profile {
 public:
  Profile() = default;
  /// Points (x, value) with increasing x, at least two.
  explicit Profile(std::vector<Vec2> points);
  double operator()(double x) const;

 private:
  std::vector<Vec2> point_;
  std::vector<double> slope_;
};

/// 0 below a, 1 above b, smooth between.
inline double SmoothStep(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Union whose seam is rounded over the width k.
inline double SmoothUnion(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h * 0.25 / k;
}

inline double SmoothIntersection(double a, double b, double k) { return -SmoothUnion(-a, -b, k); }

/// Sphere swept from a to b, its radius changing from ra to rb.
inline double Capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - t * ab) - (ra + t * (rb - ra));
}

inline double Ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radius) {
  const Vec3 q = (p - centre) / radius;
  const double k0 = glm::length(q);
  const double k1 = glm::length(q / radius);
  if (k1 < 1e-12) return -std::min({radius.x, radius.y, radius.z});
  return k0 * (k0 - 1.0) / k1;
}

/// Box whose edges are rounded with `round`; `half` includes the rounding.
inline double RoundBox(const Vec3& p, const Vec3& centre, const Vec3& half, double round) {
  const Vec3 q = glm::abs(p - centre) - half + Vec3(round);
  return glm::length(glm::max(q, Vec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - round;
}

/// Upright superellipse |x / half_width|^n + |z / half_depth|^n = 1: distance along the ray from
/// its middle.
double Superellipse(double x, double z, double half_width, double half_depth, double exponent);

}  // namespace ego::field
