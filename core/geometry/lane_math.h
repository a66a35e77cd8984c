// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/math.h"
#include "core/geometry/lanes.h"

namespace ego {

// Angles side by side, to within some 1e-15 of the standard library's. The polynomials interpolate
// at Chebyshev's nodes.

/// All bits of the lanes where `mask` is not set are cleared.
template <class V>
EGO_LANES_INLINE V Masked(const LaneMask<V>& mask, const V& x) {
  return (V)(mask & (LaneMask<V>)x);
}

/// |magnitude| with the sign of `sign`.
template <class V>
EGO_LANES_INLINE V CopySign(const V& magnitude, const V& sign) {
  const LaneMask<V> bit = (LaneMask<V>)Splat<V>(-0.0);
  return (V)(((LaneMask<V>)magnitude & ~bit) | ((LaneMask<V>)sign & bit));
}

template <class V, std::size_t N>
EGO_LANES_INLINE V Polynomial(const std::array<double, N>& coefficient, const V& x) {
  V sum = Splat<V>(coefficient[N - 1]);
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + Splat<V>(coefficient[k]);
  return sum;
}

template <class V>
struct SineCosine {
  V sine;
  V cosine;
};
/// Of angles up to some hundred turns.
template <class V>
EGO_LANES_INLINE SineCosine<V> SinCos(const V& angle) {
  // sin x = x + x^3 P(x^2), cos x = 1 - x^2 / 2 + x^4 P(x^2) within an eighth of a turn.
  constexpr std::array<double, 6> kSine = {-0.16666666666666666,    0.008333333333330827,
                                           -0.0001984126983657571,  2.755731600817155e-06,
                                           -2.5051112272573243e-08, 1.5916726193889336e-10};
  constexpr std::array<double, 6> kCosine = {0.041666666666666664,   -0.0013888888888887322,
                                             2.4801587298651292e-05, -2.755731721268659e-07,
                                             2.0876134024090145e-09, -1.1381754653662937e-11};
  // The first is short, so that its product with a small whole number is exact.
  constexpr double kQuarter = 1.5707963267341256;
  constexpr double kQuarterRest = 6.077100506506192e-11;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: the sum's low bits are the integer
  const V shifted = angle * Splat<V>(2.0 / kPi) + Splat<V>(kRound);
  const LaneMask<V> quarter = (LaneMask<V>)shifted;
  const V turns = shifted - Splat<V>(kRound);
  const V x = (angle - turns * Splat<V>(kQuarter)) - turns * Splat<V>(kQuarterRest);
  const V x2 = x * x;
  const V sine = x + x * x2 * Polynomial<V>(kSine, x2);
  const V cosine = Splat<V>(1.0) - Splat<V>(0.5) * x2 + x2 * x2 * Polynomial<V>(kCosine, x2);
  const LaneMask<V> is_odd = -(quarter & 1);
  const LaneMask<V> sine_sign = (quarter & 2) << 62;
  const LaneMask<V> cosine_sign = ((quarter + 1) & 2) << 62;
  const V s = (V)((is_odd & (LaneMask<V>)cosine) | (~is_odd & (LaneMask<V>)sine));
  const V c = (V)((is_odd & (LaneMask<V>)sine) | (~is_odd & (LaneMask<V>)cosine));
  return {(V)((LaneMask<V>)s ^ sine_sign), (V)((LaneMask<V>)c ^ cosine_sign)};
}

/// Angle of (x, y), in [-pi, pi]; 0 or pi where y is 0.
template <class V>
EGO_LANES_INLINE V Atan2(const V& y, const V& x) {
  // atan z = z + z^3 P(z^2) within a sixteenth of a turn.
  constexpr std::array<double, 11> kArc = {
      -0.3333333333333333,   0.19999999999995516, -0.14285714284665682, 0.11111111015187018,
      -0.0909090457530649,   0.07692183125376892, -0.06664510525508936, 0.05858140904866328,
      -0.050854078345894844, 0.03923044778479309, -0.019175404711104935};
  constexpr double kTangent = 0.41421356237309503;  // of a sixteenth of a turn
  const V one = Splat<V>(1.0);
  const V across = Abs<V>(y);
  const V along = Abs<V>(x);
  const LaneMask<V> is_steep = across > along;
  const V low = Select<V>(is_steep, along, across);
  const V high = Select<V>(is_steep, across, along);
  const LaneMask<V> is_far = low > Splat<V>(kTangent) * high;
  const V numerator = Select<V>(is_far, low - high, low);
  const V denominator = Select<V>(is_far, low + high, high);
  const V z = numerator / Select<V>(denominator > V{}, denominator, one);
  const V z2 = z * z;
  V angle = z + z * z2 * Polynomial<V>(kArc, z2);
  angle += Masked<V>(is_far, Splat<V>(0.25 * kPi));
  angle = Select<V>(is_steep, Splat<V>(0.5 * kPi) - angle, angle);
  angle = Select<V>(x < V{}, Splat<V>(kPi) - angle, angle);
  return CopySign<V>(angle, y);
}

/// Of a cosine in [-1, 1].
template <class V>
EGO_LANES_INLINE V Acos(const V& cosine) {
  const V one = Splat<V>(1.0);
  return Atan2<V>(Sqrt<V>(Max<V>(V{}, (one - cosine) * (one + cosine))), cosine);
}

/// See `Smoothstep` and `SoftMin` in smooth.h.
template <class V>
EGO_LANES_INLINE V Smoothstep(const V& x) {
  const V t = Min<V>(Splat<V>(1.0), Max<V>(V{}, x));
  return t * t * t * (t * (t * Splat<V>(6.0) - Splat<V>(15.0)) + Splat<V>(10.0));
}
template <class V>
EGO_LANES_INLINE V SoftMin(const V& a, const V& b, const V& c) {
  const V least = Min<V>(Min<V>(a, b), c);
  const V one = Splat<V>(1.0);
  const LaneMask<V> positive = least > V{};
  const auto term = [&](const V& x) __attribute__((always_inline)) {
    const V r = least / Select<V>(positive, x, one);
    return (r * r) * (r * r);
  };
  const V sum = Select<V>(positive, term(a) + term(b) + term(c), one);
  return Masked<V>(positive, least / Sqrt<V>(Sqrt<V>(sum)));
}

/// Rotations side by side.
template <class V>
struct LaneQuats {
  V w;
  V x;
  V y;
  V z;

  Quat At(std::size_t lane) const { return {w[lane], x[lane], y[lane], z[lane]}; }
};
inline LaneQuats<Lanes> Pair(const Quat& a, const Quat& b) {
  return {Lanes{a.w, b.w}, Lanes{a.x, b.x}, Lanes{a.y, b.y}, Lanes{a.z, b.z}};
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> operator*(const LaneQuats<V>& a, const LaneQuats<V>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}
template <class V>
EGO_LANES_INLINE LaneVectors<V> operator*(const LaneQuats<V>& q, const LaneVectors<V>& v) {
  const LaneVectors<V> axis{q.x, q.y, q.z};
  const LaneVectors<V> once = Cross(axis, v);
  const LaneVectors<V> twice = Cross(axis, once);
  return v + Splat<V>(2.0) * (q.w * once + twice);
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> Conjugate(const LaneQuats<V>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
template <class V>
EGO_LANES_INLINE V Dot(const LaneQuats<V>& a, const LaneQuats<V>& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> Scaled(const V& s, const LaneQuats<V>& q) {
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> Normalized(const LaneQuats<V>& q) {
  return Scaled<V>(Splat<V>(1.0) / Sqrt<V>(Dot(q, q)), q);
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> Select(const LaneMask<V>& mask, const LaneQuats<V>& a,
                                     const LaneQuats<V>& b) {
  return {Select<V>(mask, a.w, b.w), Select<V>(mask, a.x, b.x), Select<V>(mask, a.y, b.y),
          Select<V>(mask, a.z, b.z)};
}
template <class V>
EGO_LANES_INLINE LaneQuats<V> AngleAxis(const V& angle, const LaneVectors<V>& axis) {
  const SineCosine<V> half = SinCos<V>(Splat<V>(0.5) * angle);
  return {half.cosine, half.sine * axis.x, half.sine * axis.y, half.sine * axis.z};
}
/// See `Slerp` in rotation.h.
template <class V>
EGO_LANES_INLINE LaneQuats<V> Slerp(const LaneQuats<V>& from, const LaneQuats<V>& to, const V& t) {
  const V one = Splat<V>(1.0);
  const V dot = Dot(from, to);
  const V cosine = Min<V>(one, Abs<V>(dot));
  const V sine = Sqrt<V>((one - cosine) * (one + cosine));
  const LaneMask<V> is_turned = sine > Splat<V>(1e-9);
  const V angle = Atan2<V>(sine, cosine);
  const V divisor = one / Select<V>(is_turned, sine, one);
  const V on_from = Select<V>(is_turned, SinCos<V>((one - t) * angle).sine * divisor, one - t);
  const V on_to = CopySign<V>(Select<V>(is_turned, SinCos<V>(t * angle).sine * divisor, t), dot);
  const LaneQuats<V> a = Scaled<V>(on_from, from);
  const LaneQuats<V> b = Scaled<V>(on_to, to);
  return Normalized<V>(LaneQuats<V>{a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z});
}

/// `v` over its length, or `otherwise` where that is below 1e-12.
template <class V>
EGO_LANES_INLINE LaneVectors<V> UnitOr(const LaneVectors<V>& v, const LaneVectors<V>& otherwise) {
  const V one = Splat<V>(1.0);
  const V length = Sqrt<V>(Dot(v, v));
  const LaneMask<V> is_long = length > Splat<V>(1e-12);
  return Select<V>(is_long, (one / Select<V>(is_long, length, one)) * v, otherwise);
}
/// Part of `v` at right angles to the unit vector `axis`.
template <class V>
EGO_LANES_INLINE LaneVectors<V> Perpendicular(const LaneVectors<V>& v, const LaneVectors<V>& axis) {
  return v - Dot(v, axis) * axis;
}

}  // namespace ego
