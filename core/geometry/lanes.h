// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/math.h"

// Code over lanes of either width is written once, as templates that are always inlined into a
// function of the processor it is for.
#define EGO_LANES_INLINE [[gnu::always_inline]] inline
#if defined(__x86_64__)
#define EGO_WIDE_LANES_TARGET __attribute__((target("avx2")))
#else
#define EGO_WIDE_LANES_TARGET
#endif

namespace ego {

/// Doubles that are computed side by side, each exactly as it would be alone: two, which every
/// 64-bit processor has, or four, which most have. Nothing is summed across lanes of a width that
/// the processor chooses, so that both give the same bits.
using Lanes = double __attribute__((vector_size(16)));
using WideLanes = double __attribute__((vector_size(32)));
template <class V>
inline constexpr std::size_t kLaneCount = sizeof(V) / sizeof(double);
/// What comparing lanes gives: all bits of a lane set where it holds.
template <class V>
using LaneMask = decltype(V{} < V{});

enum class LaneWidth : std::uint8_t { kTwo, kFour };
/// The width that this processor is fastest with.
LaneWidth FastestLanes();

template <class V = Lanes>
EGO_LANES_INLINE V Splat(double x) {
  V all;
  for (std::size_t k = 0; k < kLaneCount<V>; ++k) all[k] = x;
  return all;
}
template <class V>
EGO_LANES_INLINE bool Any(const LaneMask<V>& mask) {
  auto any = mask[0];
  for (std::size_t k = 1; k < kLaneCount<V>; ++k) any |= mask[k];
  return any != 0;
}

/// `a` in the lanes of `mask`, `b` in the others; both are computed.
template <class V>
EGO_LANES_INLINE V Select(const LaneMask<V>& mask, const V& a, const V& b) {
  return mask ? a : b;
}
template <class V>
EGO_LANES_INLINE V Min(const V& a, const V& b) {
  return Select<V>(b < a, b, a);
}
template <class V>
EGO_LANES_INLINE V Max(const V& a, const V& b) {
  return Select<V>(a < b, b, a);
}
template <class V>
EGO_LANES_INLINE V Abs(const V& x) {
  constexpr auto kAllButSign = std::numeric_limits<std::int64_t>::max();
  return (V)((LaneMask<V>)x & kAllButSign);
}
template <class V>
EGO_LANES_INLINE V Sqrt(const V& x) {
  V root;
  for (std::size_t k = 0; k < kLaneCount<V>; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

/// Four doubles as they are stored, for lanes of either width: two take those from `first` on.
using Quad = std::array<double, 4>;
template <class V>
EGO_LANES_INLINE V Load(const Quad& quad, std::size_t first) {
  V lanes;
  __builtin_memcpy(&lanes, quad.data() + first, sizeof(V));
  return lanes;
}
template <class V>
EGO_LANES_INLINE void Store(const V& lanes, Quad& quad, std::size_t first) {
  __builtin_memcpy(quad.data() + first, &lanes, sizeof(V));
}
/// Vectors side by side; like those of GLM not initialised by themselves.
template <class V>
struct LaneVectors {
  V x;
  V y;
  V z;

  Vec3 At(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};
using Lanes3 = LaneVectors<Lanes>;

/// Four vectors as they are stored.
struct QuadVectors {
  Quad x{};
  Quad y{};
  Quad z{};

  Vec3 At(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void Set(std::size_t lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
  /// One in the even lanes, one in the odd.
  void SetAlternating(const Vec3& even, const Vec3& odd) {
    x = {even.x, odd.x, even.x, odd.x};
    y = {even.y, odd.y, even.y, odd.y};
    z = {even.z, odd.z, even.z, odd.z};
  }
};
template <class V>
EGO_LANES_INLINE LaneVectors<V> Load(const QuadVectors& quad, std::size_t first) {
  return {Load<V>(quad.x, first), Load<V>(quad.y, first), Load<V>(quad.z, first)};
}
template <class V>
EGO_LANES_INLINE void Store(const LaneVectors<V>& lanes, QuadVectors& quad, std::size_t first) {
  Store<V>(lanes.x, quad.x, first);
  Store<V>(lanes.y, quad.y, first);
  Store<V>(lanes.z, quad.z, first);
}

template <class V = Lanes>
EGO_LANES_INLINE LaneVectors<V> Splat(const Vec3& v) {
  return {Splat<V>(v.x), Splat<V>(v.y), Splat<V>(v.z)};
}
/// Vector `k` of four in all lanes.
template <class V>
EGO_LANES_INLINE LaneVectors<V> Splat(const QuadVectors& four, std::size_t k) {
  return {Splat<V>(four.x[k]), Splat<V>(four.y[k]), Splat<V>(four.z[k])};
}
inline Lanes3 Pair(const Vec3& a, const Vec3& b) {
  return {Lanes{a.x, b.x}, Lanes{a.y, b.y}, Lanes{a.z, b.z}};
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> operator+(const LaneVectors<V>& a, const LaneVectors<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> operator-(const LaneVectors<V>& a, const LaneVectors<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> operator*(const V& s, const LaneVectors<V>& v) {
  return {s * v.x, s * v.y, s * v.z};
}
template <class V>
EGO_LANES_INLINE void operator+=(LaneVectors<V>& sum, const LaneVectors<V>& v) {
  sum.x += v.x;
  sum.y += v.y;
  sum.z += v.z;
}
template <class V>
EGO_LANES_INLINE V Dot(const LaneVectors<V>& a, const LaneVectors<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> Cross(const LaneVectors<V>& a, const LaneVectors<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> Select(const LaneMask<V>& mask, const LaneVectors<V>& a,
                                       const LaneVectors<V>& b) {
  return {Select<V>(mask, a.x, b.x), Select<V>(mask, a.y, b.y), Select<V>(mask, a.z, b.z)};
}
/// Sum over the lanes.
inline Vec3 Sum(const Lanes3& v) { return v.At(0) + v.At(1); }

}  // namespace ego
