// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace ego {

/// The scalar and vector types of all computation. Double, so that identity and scale hold to
/// rounding; drawing converts to float at the border of `render`.
using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;
/// Unit quaternion, Hamilton convention, constructor order (w, x, y, z).
using Quat = glm::dquat;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr Quat kIdentity{1.0, 0.0, 0.0, 0.0};
inline constexpr Vec3 kUp{0.0, 1.0, 0.0};

constexpr double Radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double Degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace ego
