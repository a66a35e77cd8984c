// SPDX-License-Identifier: MIT
#include "core/adapt/limb_ik.h"

#include "core/geometry/lane_math.h"
#include "core/geometry/rotation.h"

// Both limbs of a pair are solved side by side; a limb alone is a pair with itself.

namespace ego {
namespace {

using V = Lanes;
using V3 = Lanes3;
using Q = LaneQuats<Lanes>;
using Mask = LaneMask<Lanes>;

/// People reach 167 degrees; bones do not fold further.
constexpr double kMaxFlexion = Radians(172.0);

EGO_LANES_INLINE V Pair(double a, double b) { return V{a, b}; }
EGO_LANES_INLINE Mask Pair(bool a, bool b) { return Mask{a ? -1 : 0, b ? -1 : 0}; }

/// A chain in each lane; see LimbChain.
struct Chains {
  EGO_LANES_INLINE Chains(const LimbChain& a, const LimbChain& b)
      : of{&a, &b},
        base_ws(ego::Pair(a.base_ws, b.base_ws)),
        frame_ws(ego::Pair(a.frame_ws, b.frame_ws)),
        upper_ls(ego::Pair(a.upper_ls, b.upper_ls)),
        lower_ls(ego::Pair(a.lower_ls, b.lower_ls)),
        upper_unit(ego::Pair(a.upper_unit, b.upper_unit)),
        lower_unit(ego::Pair(a.lower_unit, b.lower_unit)),
        upper_length(Pair(a.upper_length, b.upper_length)),
        lower_length(Pair(a.lower_length, b.lower_length)),
        reach(upper_length + lower_length),
        hinge_ls(ego::Pair(a.hinge_ls, b.hinge_ls)),
        hinge_across(ego::Pair(a.hinge_across, b.hinge_across)),
        has_bones(Pair(a.has_bones, b.has_bones)),
        base_locked(Pair(a.base_locked, b.base_locked)),
        mid_locked(Pair(a.mid_locked, b.mid_locked)),
        captured_deficit(Pair(a.captured_deficit, b.captured_deficit)),
        captured_flexion(Pair(a.captured_flexion, b.captured_flexion)),
        reach_softness(Pair(a.reach_softness, b.reach_softness)),
        swivel_share(Pair(a.swivel_share, b.swivel_share)) {}

  std::array<const LimbChain*, 2> of;
  V3 base_ws;
  Q frame_ws;
  V3 upper_ls;
  V3 lower_ls;
  V3 upper_unit;
  V3 lower_unit;
  V upper_length;
  V lower_length;
  V reach;
  V3 hinge_ls;
  V3 hinge_across;
  Mask has_bones;
  Mask base_locked;
  Mask mid_locked;
  V captured_deficit;
  V captured_flexion;
  V reach_softness;
  V swivel_share;
};

struct Postures {
  Q base;
  Q mid;

  EGO_LANES_INLINE Postures(const LimbPosture& a, const LimbPosture& b)
      : base(ego::Pair(a.base, b.base)), mid(ego::Pair(a.mid, b.mid)) {}
  LimbPosture At(std::size_t lane) const { return {base.At(lane), mid.At(lane)}; }
};

struct Placements {
  Q base_ws;
  V3 mid;
  V3 end;
};

EGO_LANES_INLINE Placements Place(const Chains& chain, const Postures& posture) {
  Placements placed;
  placed.base_ws = chain.frame_ws * posture.base;
  placed.mid = chain.base_ws + placed.base_ws * chain.upper_ls;
  placed.end = placed.mid + placed.base_ws * (posture.mid * chain.lower_ls);
  return placed;
}

/// See Flexion.
struct Flexions {
  V3 axis_ls;
  V angle;
  V in_plane;
};

EGO_LANES_INLINE Flexions MeasureFlexion(const Chains& chain, const Q& mid) {
  const V3 lower = mid * chain.lower_unit;
  const V3 normal = Cross(chain.upper_unit, lower);
  const V3 axis = UnitOr<V>(normal + Splat(kHingeWeight) * chain.hinge_across, chain.hinge_across);
  const V along = Dot(chain.upper_unit, lower);
  const V across = Dot(axis, normal);
  return {Select<V>(chain.has_bones, axis, chain.hinge_ls),
          Masked<V>(chain.has_bones, Atan2<V>(across, along)),
          Select<V>(chain.has_bones, Sqrt<V>(along * along + across * across), Splat(1.0))};
}

/// Fades a direction out where what defines it is shorter than `scale`; `square` of its length.
EGO_LANES_INLINE V Trust(const V& square, const V& scale) {
  return square / (square + scale * scale);
}

/// 1, but near 0, below `least` away from it, less.
EGO_LANES_INLINE V NearTrust(const V& distance, const V& least) {
  const Mask far = distance > least;
  return Select<V>(far, Splat(1.0), Smoothstep<V>(distance / Select<V>(far, Splat(1.0), least)));
}

/// The signed angle to flex to for an unsigned `required` one. A limb that was captured
/// over-stretched stays on that side while no more bend is asked than it had, and turns to flexing
/// the right way round within some ten degrees beyond; continuous also where the captured angle
/// passes through zero.
EGO_LANES_INLINE V Signed(const V& required, const V& captured) {
  const V beyond = (required + captured) / Splat(Radians(10.0));
  const V turning = required + Splat(2.0) * captured / (Splat(1.0) + beyond * beyond);
  return Select<V>(captured >= V{}, required, Select<V>(required <= -captured, -required, turning));
}

/// Mid rotation, of which `flexion` is measured, with the angle between the bones brought to
/// `cosine`.
EGO_LANES_INLINE Q FlexTo(const Chains& chain, const Q& mid, const Flexions& flexion,
                          const V& cosine) {
  const V one = Splat(1.0);
  // Where the lower bone lies along the hinge nothing turns it.
  const Mask can_turn = ~chain.mid_locked & chain.has_bones & (flexion.in_plane >= Splat(1e-6));
  const V limit = Max<V>(Splat(kMaxFlexion), chain.captured_flexion);
  const V bounded = Min<V>(one, Max<V>(-one, cosine / Select<V>(can_turn, flexion.in_plane, one)));
  const V required = Min<V>(limit, Acos<V>(bounded));
  const V angle = Signed(required, chain.captured_flexion);
  return Select<V>(can_turn, Normalized(AngleAxis<V>(angle - flexion.angle, flexion.axis_ls) * mid),
                   mid);
}

/// Chord deficit 1 - cos(flexion) that is used when `wanted` would put the end in place. Soft where
/// the limb gets straight, and exact where the captured limb already has it.
EGO_LANES_INLINE V SoftDeficit(const Chains& chain, const V& wanted) {
  const V& c = chain.reach_softness;
  const V half = Splat(0.5);
  const Mask is_soft = c > V{};
  const V four_square = Splat(4.0) * c * c;
  const auto soft = [&](const V& x) __attribute__((always_inline)) {
    return half * (x + Sqrt<V>(x * x + four_square));
  };
  const V away = (wanted - chain.captured_deficit) / Select<V>(is_soft, c, Splat(1.0));
  const V exact =
      (chain.captured_deficit - soft(chain.captured_deficit)) / (Splat(1.0) + away * away);
  return Max<V>(V{}, Select<V>(is_soft, soft(wanted) + exact, wanted));
}

/// The smallest rotations that take `from` to `to` (unit); see `SmallestRotation`.
EGO_LANES_INLINE Q SmallestTurn(const V3& from, const V3& to, const Q& base_ws,
                                const V3& hinge_ls) {
  const V cosine = Dot(from, to);
  const V3 axis = Cross(from, to);
  const V one = Splat(1.0);
  const Mask opposite = cosine <= Splat(-1.0 + 1e-9);
  Q turn = Normalized(Q{Select<V>(opposite, one, one + cosine), axis.x, axis.y, axis.z});
  if (Any<V>(opposite)) {
    const V3 hinge = base_ws * hinge_ls;
    const auto one_of = [&](std::size_t k) {
      return SmallestRotation(from.At(k), to.At(k), hinge.At(k));
    };
    turn = Select<V>(opposite, ego::Pair(one_of(0), one_of(1)), turn);
  }
  return turn;
}

/// Turns the whole limb by the smallest rotation that brings `from` to `to` (unit), as far as
/// `trust` says.
EGO_LANES_INLINE Q TurnBase(const Chains& chain, const Q& base, const V3& from, const V3& to,
                            const V& trust) {
  const Q base_ws = chain.frame_ws * base;
  Q turn = SmallestTurn(from, to, base_ws, chain.hinge_ls);
  const Mask in_part = trust < Splat(1.0);
  if (Any<V>(in_part)) {
    const Q part = Slerp<V>(ego::Pair(kIdentity, kIdentity), turn, trust);
    turn = Select<V>(in_part, part, turn);
  }
  return Select<V>(chain.base_locked, base,
                   Normalized(Conjugate(chain.frame_ws) * (turn * base_ws)));
}

EGO_LANES_INLINE Q TwistBase(const Chains& chain, const Q& base, const V3& axis_ws,
                             const V& angle) {
  return Select<V>(chain.base_locked, base,
                   Normalized(Conjugate(chain.frame_ws) *
                              (AngleAxis<V>(angle, axis_ws) * (chain.frame_ws * base))));
}

/// See `ego::BoundTwist`.
EGO_LANES_INLINE V BoundTwist(const V& angle, const V& flexion) {
  const V magnitude = Abs<V>(angle);
  return CopySign<V>(SoftMin<V>(magnitude, Abs<V>(flexion), Max<V>(V{}, Splat(kPi) - magnitude)),
                     angle);
}

/// Angles from `from` to `to`, both at right angles to the unit `axis`.
EGO_LANES_INLINE V AngleAround(const V3& axis, const V3& from, const V3& to) {
  return Atan2<V>(Dot(axis, Cross(from, to)), Dot(from, to));
}

/// `flexion` is that of the posture.
EGO_LANES_INLINE Postures ReachEnd(const Chains& chain, const Postures& posture,
                                   const Flexions& flexion, const V3& end_target) {
  const V one = Splat(1.0);
  Postures reached = posture;
  const V3 to_target = end_target - chain.base_ws;
  const V distance = Sqrt<V>(Dot(to_target, to_target));
  // distance^2 = (upper + lower)^2 - 2 upper lower (1 - cos)
  const V deficit =
      (chain.reach - distance) * (chain.reach + distance) /
      Select<V>(chain.has_bones, Splat(2.0) * chain.upper_length * chain.lower_length, one);
  reached.mid = FlexTo(chain, posture.mid, flexion, one - SoftDeficit(chain, deficit));
  const V3 chord = Place(chain, reached).end - chain.base_ws;
  const V length = Sqrt<V>(Dot(chord, chord));
  const Mask has_both = (length >= Splat(1e-9)) & (distance >= Splat(1e-9));
  const V3 from = (one / Select<V>(has_both, length, one)) * chord;
  const V3 to = (one / Select<V>(has_both, distance, one)) * to_target;
  const Q base =
      TurnBase(chain, reached.base, from, to, NearTrust(distance, Splat(0.1) * chain.reach));
  reached.base = Select<V>(has_both, base, reached.base);
  return reached;
}

EGO_LANES_INLINE Postures StandardIk(const Chains& chain, const Postures& posture,
                                     const Flexions& flexion, const V3& mid_target,
                                     const V3& end_target) {
  Postures reached = ReachEnd(chain, posture, flexion, end_target);
  const Placements placed = Place(chain, reached);
  const V3 chord = placed.end - chain.base_ws;
  const V length = Sqrt<V>(Dot(chord, chord));
  const Mask has_chord = length >= Splat(1e-9);
  const V3 axis = (Splat(1.0) / Select<V>(has_chord, length, Splat(1.0))) * chord;
  const V3 mid = Perpendicular<V>(placed.mid - chain.base_ws, axis);
  const V3 wanted = Perpendicular<V>(mid_target - chain.base_ws, axis);
  const V trust = Trust(Dot(wanted, wanted), Splat(0.1) * chain.reach);
  const V bound =
      BoundTwist(AngleAround(axis, mid, wanted), MeasureFlexion(chain, reached.mid).angle);
  const Q base = TwistBase(chain, reached.base, axis, chain.swivel_share * trust * bound);
  reached.base = Select<V>(has_chord, base, reached.base);
  return reached;
}

EGO_LANES_INLINE Postures ReversedIk(const Chains& chain, const Postures& posture,
                                     const Flexions& flexion, const V3& mid_target,
                                     const V3& end_target) {
  const V one = Splat(1.0);
  Postures reached = posture;
  const V3 to_mid = mid_target - chain.base_ws;
  const V distance = Sqrt<V>(Dot(to_mid, to_mid));
  const Mask has_mid = distance > Splat(1e-9);
  const V3 upper_now = chain.frame_ws * (reached.base * chain.upper_unit);
  const V3 to = (one / Select<V>(has_mid, distance, one)) * to_mid;
  reached.base = Select<V>(has_mid,
                           TurnBase(chain, reached.base, upper_now, to,
                                    NearTrust(distance, Splat(0.2) * chain.upper_length)),
                           reached.base);

  const Placements placed = Place(chain, reached);
  const V3 upper = UnitOr<V>(placed.mid - chain.base_ws, chain.upper_unit);
  const V3 lower = UnitOr<V>(placed.end - placed.mid, chain.lower_unit);
  const V3 to_end = end_target - placed.mid;
  const V end_distance = Sqrt<V>(Dot(to_end, to_end));
  const Mask has_end = end_distance >= Splat(1e-9);
  const V3 wanted = (one / Select<V>(has_end, end_distance, one)) * to_end;
  // The bound is zero where the twist changes sides; what it is multiplied by stays outside.
  const V3 across = Perpendicular<V>(to_end, upper);
  const V twist =
      Trust(Dot(across, across), Splat(0.05) * chain.reach) *
      BoundTwist(AngleAround(upper, Perpendicular<V>(lower, upper), across), flexion.angle);
  const Q base = TwistBase(chain, reached.base, upper, twist);

  const V now = Dot(upper, lower);
  const V trust = NearTrust(end_distance, Splat(0.1) * chain.lower_length);
  const Q mid = FlexTo(chain, reached.mid, flexion, now + trust * (Dot(upper, wanted) - now));
  reached.base = Select<V>(has_end, base, reached.base);
  reached.mid = Select<V>(has_end, mid, reached.mid);
  if (Any<V>(~chain.has_bones)) {
    const Postures without = ReachEnd(chain, posture, flexion, end_target);
    reached.base = Select<V>(chain.has_bones, reached.base, without.base);
    reached.mid = Select<V>(chain.has_bones, reached.mid, without.mid);
  }
  return reached;
}

EGO_LANES_INLINE std::array<LimbPosture, 2> Blend(const std::array<LimbTask, 2>& task) {
  const LimbTask& a = task[0];
  const LimbTask& b = task[1];
  const Chains chain(*a.chain, *b.chain);
  const Postures start(a.start, b.start);
  const Flexions flexion = MeasureFlexion(chain, start.mid);
  const V3 mid = ego::Pair(a.mid_target, b.mid_target);
  const V3 end = ego::Pair(a.end_target, b.end_target);
  const V gamma = Pair(a.gamma, b.gamma);
  Postures blended = StandardIk(chain, start, flexion, mid, end);
  const Mask in_part = gamma > V{};
  if (Any<V>(in_part)) {
    const Postures reversed = ReversedIk(chain, start, flexion, mid, end);
    blended.base = Select<V>(in_part, Slerp<V>(blended.base, reversed.base, gamma), blended.base);
    blended.mid = Select<V>(in_part, Slerp<V>(blended.mid, reversed.mid, gamma), blended.mid);
  }
  return {blended.At(0), blended.At(1)};
}

// The same instructions as elsewhere, encoded shorter where the processor knows those of four
// lanes.
EGO_WIDE_LANES_TARGET
std::array<LimbPosture, 2> BlendWide(const std::array<LimbTask, 2>& task) { return Blend(task); }

EGO_LANES_INLINE LimbPosture Reach(const LimbChain& chain, const LimbPosture& posture,
                                   const Vec3& end_target) {
  const Chains chains(chain, chain);
  const Postures postures(posture, posture);
  return ReachEnd(chains, postures, MeasureFlexion(chains, postures.mid), Splat(end_target)).At(0);
}

EGO_WIDE_LANES_TARGET
LimbPosture ReachWide(const LimbChain& chain, const LimbPosture& posture, const Vec3& end_target) {
  return Reach(chain, posture, end_target);
}

}  // namespace

double BoundTwist(double angle, double flexion) {
  return BoundTwist(Splat(angle), Splat(flexion))[0];
}

LimbPosture ReachEnd(const LimbChain& chain, const LimbPosture& posture, const Vec3& end_target) {
  return FastestLanes() == LaneWidth::kFour ? ReachWide(chain, posture, end_target)
                                            : Reach(chain, posture, end_target);
}

LimbPosture StandardIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target) {
  return BlendedIk(chain, posture, mid_target, end_target, 0.0);
}

LimbPosture ReversedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target) {
  return BlendedIk(chain, posture, mid_target, end_target, 1.0);
}

LimbPosture BlendedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                      const Vec3& end_target, double gamma) {
  const LimbTask task{&chain, posture, mid_target, end_target, gamma};
  return BlendedIk({task, task})[0];
}

std::array<LimbPosture, 2> BlendedIk(const std::array<LimbTask, 2>& task, LaneWidth lanes) {
  return lanes == LaneWidth::kFour ? BlendWide(task) : Blend(task);
}

}  // namespace ego
