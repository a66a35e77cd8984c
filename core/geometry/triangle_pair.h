// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/lanes.h"

namespace ego {

/// Triangles side by side with what every query of a closest point needs, computed once per frame.
template <class V>
struct TriangleLanes {
  LaneVectors<V> a;
  LaneVectors<V> ab;
  LaneVectors<V> ac;
  LaneVectors<V> normal;  // unit, right-handed about a, b, c; zero for a triangle without area
  LaneVectors<V> center;  // centroid
  V reach;                // from there to the farthest corner
  V area;
  // Products of the edges, and one over those that are divided by (0 for an edge without length
  // and for a triangle without area).
  V ab_ab;
  V ab_ac;
  V ac_ac;
  V square;  // of twice the area
  V per_ab;
  V per_ac;
  V per_bc;
  V per_square;
};

/// Two triangles as they are stored: of a body's crude mesh, one and its mirror partner.
using TrianglePair = TriangleLanes<Lanes>;
TrianglePair MakeTrianglePair(const Lanes3& a, const Lanes3& b, const Lanes3& c);

/// The first pair, or both.
template <class V>
EGO_LANES_INLINE TriangleLanes<V> Join(const TrianglePair& first, const TrianglePair& second) {
  const auto vectors = [&](Lanes3 TrianglePair::*member) __attribute__((always_inline)) {
    return Join<V>(first.*member, second.*member);
  };
  const auto lanes = [&](Lanes TrianglePair::*member) __attribute__((always_inline)) {
    return Join<V>(first.*member, second.*member);
  };
  using T = TrianglePair;
  return {vectors(&T::a),      vectors(&T::ab),   vectors(&T::ac),      vectors(&T::normal),
          vectors(&T::center), lanes(&T::reach),  lanes(&T::area),      lanes(&T::ab_ab),
          lanes(&T::ab_ac),    lanes(&T::ac_ac),  lanes(&T::square),    lanes(&T::per_ab),
          lanes(&T::per_ac),   lanes(&T::per_bc), lanes(&T::per_square)};
}

/// One of both in all lanes.
template <class V>
EGO_LANES_INLINE TriangleLanes<V> Splat(const TrianglePair& pair, std::size_t lane) {
  const auto vectors = [&](Lanes3 TrianglePair::*member) __attribute__((always_inline)) {
    const Lanes3& both = pair.*member;
    return LaneVectors<V>{Splat<V>(both.x[lane]), Splat<V>(both.y[lane]), Splat<V>(both.z[lane])};
  };
  const auto lanes = [&](Lanes TrianglePair::*member) __attribute__((always_inline)) {
    return Splat<V>((pair.*member)[lane]);
  };
  using T = TrianglePair;
  return {vectors(&T::a),      vectors(&T::ab),   vectors(&T::ac),      vectors(&T::normal),
          vectors(&T::center), lanes(&T::reach),  lanes(&T::area),      lanes(&T::ab_ab),
          lanes(&T::ab_ac),    lanes(&T::ac_ac),  lanes(&T::square),    lanes(&T::per_ab),
          lanes(&T::per_ac),   lanes(&T::per_bc), lanes(&T::per_square)};
}

/// The points of triangles that are closest to a point.
template <class V>
struct ClosestLanes {
  V b;  // barycentric coordinates of corners b and c, not negative
  V c;
  LaneVectors<V> away;  // from the closest point to the given one
};

/// The same as `ClosestOnTriangle` of each, to rounding. A triangle without area is treated as its
/// edges; where rounding finds none of them, as its corner a.
template <class V>
EGO_LANES_INLINE ClosestLanes<V> ClosestOnTriangles(const TriangleLanes<V>& t,
                                                    const LaneVectors<V>& p) {
  // By the Voronoi region of the projection, as there; every region's answer is selected instead
  // of branched to, the first that applies last.
  const LaneVectors<V> ap = p - t.a;
  const V zero{};
  const V one = Splat<V>(1.0);
  const V d1 = Dot(t.ab, ap);
  const V d2 = Dot(t.ac, ap);
  const V d3 = d1 - t.ab_ab;  // ab . bp
  const V d4 = d2 - t.ab_ac;  // ac . bp
  const V d5 = d1 - t.ab_ac;  // ab . cp
  const V d6 = d2 - t.ac_ac;  // ac . cp
  const V vb = t.ac_ac * d1 - t.ab_ac * d2;
  const V vc = t.ab_ab * d2 - t.ab_ac * d1;
  const V va = t.square - vb - vc;

  V b = vb * t.per_square;
  V c = vc * t.per_square;
  const V along = d4 - d3;
  const LaneMask<V> on_bc = (va <= zero) & (along >= zero) & (d5 >= d6);
  const V on_edge = Min<V>(along * t.per_bc, one);
  b = Select<V>(on_bc, one - on_edge, b);
  c = Select<V>(on_bc, on_edge, c);
  const LaneMask<V> on_ac = (vb <= zero) & (d2 >= zero) & (d6 <= zero);
  b = Select<V>(on_ac, zero, b);
  c = Select<V>(on_ac, d2 * t.per_ac, c);
  const LaneMask<V> at_c = (d6 >= zero) & (d5 <= d6);
  b = Select<V>(at_c, zero, b);
  c = Select<V>(at_c, one, c);
  const LaneMask<V> on_ab = (vc <= zero) & (d1 >= zero) & (d3 <= zero);
  b = Select<V>(on_ab, d1 * t.per_ab, b);
  c = Select<V>(on_ab, zero, c);
  const LaneMask<V> at_b = (d3 >= zero) & (d4 <= d3);
  b = Select<V>(at_b, one, b);
  c = Select<V>(at_b, zero, c);
  const LaneMask<V> at_a = (d1 <= zero) & (d2 <= zero);
  b = Select<V>(at_a, zero, b);
  c = Select<V>(at_a, zero, c);
  return {b, c, ap - b * t.ab - c * t.ac};
}

}  // namespace ego
