// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/math.h"

namespace ego {

/// Two doubles that are computed side by side, each exactly as it would be alone: the width that
/// every 64-bit processor has, so that results do not depend on the machine.
using Lanes = double __attribute__((vector_size(16)));
inline constexpr std::size_t kLaneCount = 2;
/// What comparing lanes gives: all bits of a lane set where it holds.
using LaneMask = decltype(Lanes{} < Lanes{});

inline Lanes Splat(double x) { return Lanes{x, x}; }
inline double Sum(Lanes x) { return x[0] + x[1]; }
inline double Largest(Lanes x) { return x[0] < x[1] ? x[1] : x[0]; }
inline bool Any(LaneMask mask) { return (mask[0] | mask[1]) != 0; }

/// `a` in the lanes of `mask`, `b` in the others; both are computed.
inline Lanes Select(LaneMask mask, Lanes a, Lanes b) { return mask ? a : b; }
inline Lanes Min(Lanes a, Lanes b) { return Select(b < a, b, a); }
inline Lanes Max(Lanes a, Lanes b) { return Select(a < b, b, a); }
inline Lanes Abs(Lanes x) { return Max(x, -x); }
inline Lanes Sqrt(Lanes x) { return Lanes{std::sqrt(x[0]), std::sqrt(x[1])}; }

/// Two vectors side by side.
struct Lanes3 {
  Lanes x{};
  Lanes y{};
  Lanes z{};

  Vec3 At(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  Lanes3& operator+=(const Lanes3& other) {
    x += other.x;
    y += other.y;
    z += other.z;
    return *this;
  }
};

inline Lanes3 Splat(const Vec3& v) { return {Splat(v.x), Splat(v.y), Splat(v.z)}; }
inline Lanes3 Pair(const Vec3& a, const Vec3& b) {
  return {Lanes{a.x, b.x}, Lanes{a.y, b.y}, Lanes{a.z, b.z}};
}
inline Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Lanes3 operator*(Lanes s, const Lanes3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Lanes Dot(const Lanes3& a, const Lanes3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Lanes3 Cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes3 Select(LaneMask mask, const Lanes3& a, const Lanes3& b) {
  return {Select(mask, a.x, b.x), Select(mask, a.y, b.y), Select(mask, a.z, b.z)};
}
inline Vec3 Sum(const Lanes3& v) { return {Sum(v.x), Sum(v.y), Sum(v.z)}; }

}  // namespace ego
