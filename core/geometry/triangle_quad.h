// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/lanes.h"

namespace ego {

/// Triangles with what every query of a closest point needs, computed once per frame. `Number` and
/// `Vectors` are lanes, or four as they are stored.
template <class Number, class Vectors>
struct TriangleFields {
  Vectors a;
  Vectors ab;
  Vectors ac;
  Vectors normal;  // unit, right-handed about a, b, c; zero for a triangle without area
  Number area;
  // Products of the edges, and one over those that are divided by (0 for an edge without length
  // and for a triangle without area).
  Number ab_ab;
  Number ab_ac;
  Number ac_ac;
  Number bc_bc;
  Number per_ab;
  Number per_ac;
  Number per_bc;
  Number per_square;  // of twice the area
};
template <class V>
using TriangleLanes = TriangleFields<V, LaneVectors<V>>;
using TriangleQuad = TriangleFields<Quad, QuadVectors>;

/// Triangles with these corners.
template <class V>
EGO_LANES_INLINE TriangleLanes<V> MakeTriangles(const LaneVectors<V>& a, const LaneVectors<V>& b,
                                                const LaneVectors<V>& c) {
  const V one = Splat<V>(1.0);
  const auto inverse = [&](const V& x) __attribute__((always_inline)) {
    const LaneMask<V> above = x > V{};
    return Select<V>(above, one / Select<V>(above, x, one), V{});
  };
  TriangleLanes<V> t;
  t.a = a;
  t.ab = b - a;
  t.ac = c - a;
  const LaneVectors<V> normal = Cross(t.ab, t.ac);
  const V square = Dot(normal, normal);
  const V length = Sqrt<V>(square);
  t.area = Splat<V>(0.5) * length;
  t.normal = inverse(length) * normal;
  t.ab_ab = Dot(t.ab, t.ab);
  t.ab_ac = Dot(t.ab, t.ac);
  t.ac_ac = Dot(t.ac, t.ac);
  const LaneVectors<V> bc = t.ac - t.ab;
  t.bc_bc = Dot(bc, bc);
  t.per_ab = inverse(t.ab_ab);
  t.per_ac = inverse(t.ac_ac);
  t.per_bc = inverse(t.bc_bc);
  t.per_square = inverse(square);
  return t;
}
/// Four of them.
TriangleQuad MakeTriangleQuad(const QuadVectors& a, const QuadVectors& b, const QuadVectors& c);

template <class V>
EGO_LANES_INLINE TriangleLanes<V> Load(const TriangleQuad& quad, std::size_t first) {
  return {Load<V>(quad.a, first),         Load<V>(quad.ab, first),     Load<V>(quad.ac, first),
          Load<V>(quad.normal, first),    Load<V>(quad.area, first),   Load<V>(quad.ab_ab, first),
          Load<V>(quad.ab_ac, first),     Load<V>(quad.ac_ac, first),  Load<V>(quad.bc_bc, first),
          Load<V>(quad.per_ab, first),    Load<V>(quad.per_ac, first), Load<V>(quad.per_bc, first),
          Load<V>(quad.per_square, first)};
}
template <class V>
EGO_LANES_INLINE void Store(const TriangleLanes<V>& t, TriangleQuad& quad, std::size_t first) {
  Store<V>(t.a, quad.a, first);
  Store<V>(t.ab, quad.ab, first);
  Store<V>(t.ac, quad.ac, first);
  Store<V>(t.normal, quad.normal, first);
  Store<V>(t.area, quad.area, first);
  Store<V>(t.ab_ab, quad.ab_ab, first);
  Store<V>(t.ab_ac, quad.ab_ac, first);
  Store<V>(t.ac_ac, quad.ac_ac, first);
  Store<V>(t.bc_bc, quad.bc_bc, first);
  Store<V>(t.per_ab, quad.per_ab, first);
  Store<V>(t.per_ac, quad.per_ac, first);
  Store<V>(t.per_bc, quad.per_bc, first);
  Store<V>(t.per_square, quad.per_square, first);
}
/// One of four in all lanes.
template <class V>
EGO_LANES_INLINE TriangleLanes<V> Splat(const TriangleQuad& quad, std::size_t k) {
  return {Splat<V>(quad.a, k),         Splat<V>(quad.ab, k),     Splat<V>(quad.ac, k),
          Splat<V>(quad.normal, k),    Splat<V>(quad.area[k]),   Splat<V>(quad.ab_ab[k]),
          Splat<V>(quad.ab_ac[k]),     Splat<V>(quad.ac_ac[k]),  Splat<V>(quad.bc_bc[k]),
          Splat<V>(quad.per_ab[k]),    Splat<V>(quad.per_ac[k]), Splat<V>(quad.per_bc[k]),
          Splat<V>(quad.per_square[k])};
}

/// The points of triangles that are closest to a point.
template <class V>
struct ClosestLanes {
  V b;  // barycentric coordinates of corners b and c, not negative
  V c;
  LaneVectors<V> away;  // from the closest point to the given one
};

/// The same as `ClosestOnTriangle` of each, to rounding. A triangle without area is treated as its
/// edges.
template <class V>
EGO_LANES_INLINE ClosestLanes<V> ClosestOnTriangles(const TriangleLanes<V>& t,
                                                    const LaneVectors<V>& p) {
  const LaneVectors<V> ap = p - t.a;
  const V zero{};
  const V one = Splat<V>(1.0);
  const V two = Splat<V>(2.0);
  const auto clamp = [&](const V& x) __attribute__((always_inline)) {
    return Min<V>(Max<V>(x, zero), one);
  };
  const V d1 = Dot(t.ab, ap);
  const V d2 = Dot(t.ac, ap);
  // On each edge, and by how much its closest point is nearer than corner a (as squares).
  const V on_ab = clamp(d1 * t.per_ab);
  const V gain_ab = on_ab * (two * d1 - on_ab * t.ab_ab);
  const V on_ac = clamp(d2 * t.per_ac);
  const V gain_ac = on_ac * (two * d2 - on_ac * t.ac_ac);
  const V along = (d2 - t.ab_ac) - (d1 - t.ab_ab);  // bc . bp
  const V on_bc = clamp(along * t.per_bc);
  const V gain_bc = (two * d1 - t.ab_ab) + on_bc * (two * along - on_bc * t.bc_bc);
  const LaneMask<V> is_ac = gain_ac > gain_ab;
  V b = Select<V>(is_ac, zero, on_ab);
  V c = Select<V>(is_ac, on_ac, zero);
  const LaneMask<V> is_bc = gain_bc > Max<V>(gain_ab, gain_ac);
  b = Select<V>(is_bc, one - on_bc, b);
  c = Select<V>(is_bc, on_bc, c);
  // The projection, where it lies inside.
  const V inside_b = (t.ac_ac * d1 - t.ab_ac * d2) * t.per_square;
  const V inside_c = (t.ab_ab * d2 - t.ab_ac * d1) * t.per_square;
  const LaneMask<V> is_inside =
      Min<V>(Min<V>(inside_b, inside_c), one - inside_b - inside_c) > zero;
  b = Select<V>(is_inside, inside_b, b);
  c = Select<V>(is_inside, inside_c, c);
  return {b, c, ap - b * t.ab - c * t.ac};
}

}  // namespace ego
