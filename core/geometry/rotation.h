// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/base/math.h"

namespace ego {

/// Unit vector along `v`, or `fallback` where `v` is shorter than 1e-12.
inline Vec3 NormalizedOr(const Vec3& v, const Vec3& fallback) {
  const double length = glm::length(v);
  return length > 1e-12 ? v / length : fallback;
}

/// Part of `v` at right angles to the unit vector `axis`.
inline Vec3 Perpendicular(const Vec3& v, const Vec3& axis) { return v - glm::dot(v, axis) * axis; }

/// The smallest rotation that takes the unit vector `from` to the unit vector `to`. Where they
/// are opposite it is the half turn about `hinge` (its part at right angles to `from`, any length
/// but zero): the one place where it is not continuous.
inline Quat SmallestRotation(const Vec3& from, const Vec3& to, const Vec3& hinge) {
  const double cosine = glm::dot(from, to);
  const Vec3 axis = glm::cross(from, to);
  if (cosine > -1.0 + 1e-9) {
    return glm::normalize(Quat(1.0 + cosine, axis.x, axis.y, axis.z));
  }
  const Vec3 any = std::abs(from.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 turn =
      NormalizedOr(Perpendicular(hinge, from), glm::normalize(Perpendicular(any, from)));
  return Quat(0.0, turn.x, turn.y, turn.z);
}

/// Rotation about the direction of `r` by its length, radians; identity for the zero vector.
inline Quat FromRotationVector(const Vec3& r) {
  const double angle = glm::length(r);
  if (angle < 1e-12) return glm::normalize(Quat(1.0, 0.5 * r.x, 0.5 * r.y, 0.5 * r.z));
  return glm::angleAxis(angle, r / angle);
}

/// Angle of a rotation, radians, in [0, pi].
inline double AngleOf(const Quat& q) {
  return 2.0 * std::atan2(glm::length(Vec3{q.x, q.y, q.z}), std::abs(q.w));
}

/// Angle from unit vector `from` to unit vector `to` about the unit `axis`, radians, signed; the
/// parts along the axis do not count. 0 where either is along the axis.
inline double AngleAbout(const Vec3& axis, const Vec3& from, const Vec3& to) {
  const Vec3 a = Perpendicular(from, axis);
  const Vec3 b = Perpendicular(to, axis);
  return std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
}

/// The rotation part-way from one to the other, the shorter way; exactly `from` where they are
/// equal.
inline Quat Slerp(const Quat& from, const Quat& to, double t) {
  return glm::normalize(glm::slerp(from, to, t));
}

}  // namespace ego
