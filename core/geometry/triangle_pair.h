// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/lanes.h"

namespace ego {

/// Two triangles side by side (of a body's crude mesh: one and its mirror partner) with what every
/// query of a closest point needs, computed once per frame.
struct TrianglePair {
  Lanes3 a;
  Lanes3 ab;
  Lanes3 ac;
  Lanes3 normal;  // unit, right-handed about a, b, c; zero for a triangle without area
  Lanes3 center;  // centroid
  Lanes reach{};  // from there to the farthest corner
  Lanes area{};
  // Products of the edges, and one over those that are divided by (0 for an edge without length
  // and for a triangle without area).
  Lanes ab_ab{};
  Lanes ab_ac{};
  Lanes ac_ac{};
  Lanes square{};  // of twice the area
  Lanes per_ab{};
  Lanes per_ac{};
  Lanes per_bc{};
  Lanes per_square{};

  static TrianglePair Of(const Lanes3& a, const Lanes3& b, const Lanes3& c);
};

/// The points of both triangles that are closest to a point.
struct ClosestPair {
  Lanes b{};  // barycentric coordinates of corners b and c, not negative
  Lanes c{};
  Lanes3 away;  // from the closest point to the given one
};

/// The same as `ClosestOnTriangle` of each, to rounding. A triangle without area is treated as its
/// edges; where rounding finds none of them, as its corner a.
inline ClosestPair ClosestOnPair(const TrianglePair& t, const Lanes3& p) {
  // By the Voronoi region of the projection, as there; every region's answer is selected instead
  // of branched to, the first that applies last.
  const Lanes3 ap = p - t.a;
  const Lanes zero{};
  const Lanes one = Splat(1.0);
  const Lanes d1 = Dot(t.ab, ap);
  const Lanes d2 = Dot(t.ac, ap);
  const Lanes d3 = d1 - t.ab_ab;  // ab . bp
  const Lanes d4 = d2 - t.ab_ac;  // ac . bp
  const Lanes d5 = d1 - t.ab_ac;  // ab . cp
  const Lanes d6 = d2 - t.ac_ac;  // ac . cp
  const Lanes vb = t.ac_ac * d1 - t.ab_ac * d2;
  const Lanes vc = t.ab_ab * d2 - t.ab_ac * d1;
  const Lanes va = t.square - vb - vc;

  Lanes b = vb * t.per_square;
  Lanes c = vc * t.per_square;
  const Lanes along = d4 - d3;
  const LaneMask on_bc = (va <= zero) & (along >= zero) & (d5 >= d6);
  const Lanes on_edge = Min(along * t.per_bc, one);
  b = Select(on_bc, one - on_edge, b);
  c = Select(on_bc, on_edge, c);
  const LaneMask on_ac = (vb <= zero) & (d2 >= zero) & (d6 <= zero);
  b = Select(on_ac, zero, b);
  c = Select(on_ac, d2 * t.per_ac, c);
  const LaneMask at_c = (d6 >= zero) & (d5 <= d6);
  b = Select(at_c, zero, b);
  c = Select(at_c, one, c);
  const LaneMask on_ab = (vc <= zero) & (d1 >= zero) & (d3 <= zero);
  b = Select(on_ab, d1 * t.per_ab, b);
  c = Select(on_ab, zero, c);
  const LaneMask at_b = (d3 >= zero) & (d4 <= d3);
  b = Select(at_b, one, b);
  c = Select(at_b, zero, c);
  const LaneMask at_a = (d1 <= zero) & (d2 <= zero);
  b = Select(at_a, zero, b);
  c = Select(at_a, zero, c);
  return {b, c, ap - b * t.ab - c * t.ac};
}

}  // namespace ego
