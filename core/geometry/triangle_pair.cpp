// SPDX-License-Identifier: MIT
#include "core/geometry/triangle_pair.h"

namespace ego {
namespace {

/// 1 / x, or 0 where x is not above 0.
Lanes Inverse(const Lanes& x) {
  const LaneMask<Lanes> above = x > Lanes{};
  return Select<Lanes>(above, Splat(1.0) / Select<Lanes>(above, x, Splat(1.0)), Lanes{});
}

}  // namespace

TrianglePair MakeTrianglePair(const Lanes3& a, const Lanes3& b, const Lanes3& c) {
  TrianglePair t;
  t.a = a;
  t.ab = b - a;
  t.ac = c - a;
  t.center = Splat(1.0 / 3.0) * (a + b + c);
  const Lanes3 to_a = a - t.center;
  const Lanes3 to_b = b - t.center;
  const Lanes3 to_c = c - t.center;
  t.reach = Sqrt<Lanes>(Max<Lanes>(Max<Lanes>(Dot(to_a, to_a), Dot(to_b, to_b)), Dot(to_c, to_c)));
  const Lanes3 normal = Cross(t.ab, t.ac);
  t.square = Dot(normal, normal);
  const Lanes length = Sqrt<Lanes>(t.square);
  t.area = Splat(0.5) * length;
  t.normal = Inverse(length) * normal;
  t.ab_ab = Dot(t.ab, t.ab);
  t.ab_ac = Dot(t.ab, t.ac);
  t.ac_ac = Dot(t.ac, t.ac);
  const Lanes3 bc = t.ac - t.ab;
  t.per_ab = Inverse(t.ab_ab);
  t.per_ac = Inverse(t.ac_ac);
  t.per_bc = Inverse(Dot(bc, bc));
  t.per_square = Inverse(t.square);
  return t;
}

}  // namespace ego
