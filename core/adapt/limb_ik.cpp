// SPDX-License-Identifier: MIT
#include "core/adapt/limb_ik.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// People reach 167 degrees; bones do not fold further.
constexpr double kMaxFlexion = Radians(172.0);
/// How far the canonical hinge pulls the flexion axis, as a sine: it rules below 20 degrees.
constexpr double kHingeWeight = 0.35;

/// Fades a direction out where what defines it is shorter than `scale`.
double Trust(double length, double scale) {
  const double l2 = length * length;
  return l2 / (l2 + scale * scale);
}

/// The signed angle to flex to for an unsigned `required` one. A limb that was captured
/// over-stretched stays on that side while no more bend is asked than it had, and turns to flexing
/// the right way round within some ten degrees beyond; continuous also where the captured angle
/// passes through zero.
double Signed(double required, double captured) {
  if (captured >= 0.0) return required;
  if (required <= -captured) return -required;
  const double beyond = (required + captured) / Radians(10.0);
  return required + 2.0 * captured / (1.0 + beyond * beyond);
}

/// Mid rotation, of which `flexion` is measured, with the angle between the bones brought to
/// `cosine`.
Quat FlexTo(const LimbChain& chain, const Quat& mid, const Flexion& flexion, double cosine) {
  if (chain.mid_locked || !chain.has_bones) return mid;
  if (flexion.in_plane < 1e-6) return mid;  // the lower bone lies along the hinge: nothing turns it
  const double limit = std::max(kMaxFlexion, chain.captured_flexion);
  const double required =
      std::min(limit, std::acos(std::clamp(cosine / flexion.in_plane, -1.0, 1.0)));
  const double angle = Signed(required, chain.captured_flexion);
  return glm::normalize(glm::angleAxis(angle - flexion.angle, flexion.axis_ls) * mid);
}

/// Chord deficit 1 - cos(flexion) that is used when `wanted` would put the end in place. Soft where
/// the limb gets straight, and exact where the captured limb already has it.
double SoftDeficit(const LimbChain& chain, double wanted) {
  const double c = chain.reach_softness;
  if (!(c > 0.0)) return std::max(0.0, wanted);
  const auto soft = [c](double x) { return 0.5 * (x + std::sqrt(x * x + 4.0 * c * c)); };
  const double away = (wanted - chain.captured_deficit) / c;
  const double exact =
      (chain.captured_deficit - soft(chain.captured_deficit)) / (1.0 + away * away);
  return std::max(0.0, soft(wanted) + exact);
}

/// Turns the whole limb by the smallest rotation that brings `from` to `to` (unit), as far as
/// `trust` says.
Quat TurnBase(const LimbChain& chain, const Quat& base, const Vec3& from, const Vec3& to,
              double trust) {
  if (chain.base_locked) return base;
  const Quat base_ws = chain.frame_ws * base;
  const Quat turn = SmallestRotation(from, to, base_ws * chain.hinge_ls);
  const Quat part = trust >= 1.0 ? turn : Slerp(kIdentity, turn, trust);
  return glm::normalize(glm::conjugate(chain.frame_ws) * part * base_ws);
}

Quat TwistBase(const LimbChain& chain, const Quat& base, const Vec3& axis_ws, double angle) {
  if (chain.base_locked) return base;
  return glm::normalize(glm::conjugate(chain.frame_ws) * glm::angleAxis(angle, axis_ws) *
                        chain.frame_ws * base);
}

}  // namespace

LimbPlacement Place(const LimbChain& chain, const LimbPosture& posture) {
  LimbPlacement placed;
  placed.base_ws = chain.frame_ws * posture.base;
  placed.mid_ws = placed.base_ws * posture.mid;
  placed.mid = chain.base_ws + placed.base_ws * chain.upper_ls;
  placed.end = placed.mid + placed.mid_ws * chain.lower_ls;
  return placed;
}

LimbChain MakeChain(const Skeleton& skeleton, Limb limb, const Vec3& base_ws, const Quat& frame_ws,
                    const LimbPosture& captured, double reach_softness) {
  const LimbJoints joints = JointsOf(limb);
  LimbChain chain;
  chain.base_ws = base_ws;
  chain.frame_ws = frame_ws;
  chain.upper_ls = skeleton.offset[Index(joints.mid)];
  chain.lower_ls = skeleton.offset[Index(joints.end)];
  chain.hinge_ls = FlexionAxis(limb);
  chain.base_locked = skeleton.locked[Index(joints.base)];
  chain.mid_locked = skeleton.locked[Index(joints.mid)];
  chain.reach_softness = reach_softness;
  chain.captured = captured;
  chain.upper_length = glm::length(chain.upper_ls);
  chain.lower_length = glm::length(chain.lower_ls);
  chain.has_bones = chain.upper_length > 0.0 && chain.lower_length > 0.0;
  if (chain.has_bones) {
    chain.upper_unit = chain.upper_ls / chain.upper_length;
    chain.lower_unit = chain.lower_ls / chain.lower_length;
    chain.hinge_across =
        NormalizedOr(Perpendicular(chain.hinge_ls, chain.upper_unit), chain.hinge_ls);
    const Vec3 off = captured.mid * chain.lower_unit - chain.upper_unit;
    chain.captured_deficit = 0.5 * glm::dot(off, off);  // 1 - cos, exact near straight
    chain.captured_flexion = MeasureFlexion(chain, captured.mid).angle;
  }
  return chain;
}

Flexion MeasureFlexion(const LimbChain& chain, const Quat& mid) {
  if (!chain.has_bones) return {chain.hinge_ls, 0.0, 1.0};
  const Vec3& upper = chain.upper_unit;
  const Vec3 lower = mid * chain.lower_unit;
  const Vec3 normal = glm::cross(upper, lower);
  const Vec3& hinge = chain.hinge_across;
  Flexion flexion;
  flexion.axis_ls = NormalizedOr(normal + kHingeWeight * hinge, hinge);
  const double along = glm::dot(upper, lower);
  const double across = glm::dot(flexion.axis_ls, normal);
  flexion.angle = std::atan2(across, along);
  flexion.in_plane = std::sqrt(along * along + across * across);
  return flexion;
}

double BoundTwist(double angle, double flexion) {
  const double magnitude = std::abs(angle);
  return std::copysign(SoftMin(magnitude, std::abs(flexion), std::max(0.0, kPi - magnitude)),
                       angle);
}

LimbPosture ReachEnd(const LimbChain& chain, const LimbPosture& posture, const Vec3& end_target) {
  LimbPosture reached = posture;
  const Vec3 to_target = end_target - chain.base_ws;
  const double distance = glm::length(to_target);
  if (chain.has_bones) {
    const double upper = chain.upper_length;
    const double lower = chain.lower_length;
    // distance^2 = (upper + lower)^2 - 2 upper lower (1 - cos)
    const double reach = upper + lower;
    const double deficit = (reach - distance) * (reach + distance) / (2.0 * upper * lower);
    reached.mid = FlexTo(chain, posture.mid, MeasureFlexion(chain, posture.mid),
                         1.0 - SoftDeficit(chain, deficit));
  }
  const Vec3 chord = Place(chain, reached).end - chain.base_ws;
  const double length = glm::length(chord);
  if (length < 1e-9 || distance < 1e-9) return reached;
  const double trust =
      distance > 0.1 * chain.Reach() ? 1.0 : Smoothstep(distance / (0.1 * chain.Reach()));
  reached.base = TurnBase(chain, reached.base, chord / length, to_target / distance, trust);
  return reached;
}

LimbPosture StandardIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target) {
  LimbPosture reached = ReachEnd(chain, posture, end_target);
  const LimbPlacement placed = Place(chain, reached);
  const Vec3 chord = placed.end - chain.base_ws;
  const double length = glm::length(chord);
  if (length < 1e-9) return reached;
  const Vec3 axis = chord / length;
  const Vec3 mid = Perpendicular(placed.mid - chain.base_ws, axis);
  const Vec3 wanted = Perpendicular(mid_target - chain.base_ws, axis);
  const double angle = AngleAbout(axis, mid, wanted);
  const double trust = Trust(glm::length(wanted), 0.1 * chain.Reach());
  const double flexion = MeasureFlexion(chain, reached.mid).angle;
  reached.base =
      TwistBase(chain, reached.base, axis, chain.swivel_share * trust * BoundTwist(angle, flexion));
  return reached;
}

LimbPosture ReversedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                       const Vec3& end_target) {
  LimbPosture reached = posture;
  if (!chain.has_bones) return ReachEnd(chain, posture, end_target);
  const Vec3 to_mid = mid_target - chain.base_ws;
  const double distance = glm::length(to_mid);
  const Vec3 upper_now = chain.frame_ws * reached.base * chain.upper_unit;
  if (distance > 1e-9) {
    const double near = 0.2 * chain.upper_length;
    reached.base = TurnBase(chain, reached.base, upper_now, to_mid / distance,
                            distance > near ? 1.0 : Smoothstep(distance / near));
  }

  LimbPlacement placed = Place(chain, reached);
  const Vec3 upper = glm::normalize(placed.mid - chain.base_ws);
  const Vec3 to_end = end_target - placed.mid;
  const double end_distance = glm::length(to_end);
  if (end_distance < 1e-9) return reached;
  const Vec3 wanted = to_end / end_distance;
  const Flexion flexion = MeasureFlexion(chain, reached.mid);
  // The bound is zero where the twist changes sides; what it is multiplied by stays outside.
  const double twist =
      Trust(glm::length(Perpendicular(to_end, upper)), 0.05 * chain.Reach()) *
      BoundTwist(AngleAbout(upper, placed.end - placed.mid, wanted), flexion.angle);
  reached.base = TwistBase(chain, reached.base, upper, twist);

  const double now = glm::dot(upper, glm::normalize(placed.end - placed.mid));
  const double cosine = glm::dot(upper, wanted);
  const double near = 0.1 * chain.lower_length;
  const double trust = end_distance > near ? 1.0 : Smoothstep(end_distance / near);
  reached.mid = FlexTo(chain, reached.mid, flexion, glm::mix(now, cosine, trust));
  return reached;
}

LimbPosture BlendedIk(const LimbChain& chain, const LimbPosture& posture, const Vec3& mid_target,
                      const Vec3& end_target, double gamma) {
  const LimbPosture standard = StandardIk(chain, posture, mid_target, end_target);
  if (gamma <= 0.0) return standard;
  const LimbPosture reversed = ReversedIk(chain, posture, mid_target, end_target);
  return {Slerp(standard.base, reversed.base, gamma), Slerp(standard.mid, reversed.mid, gamma)};
}

}  // namespace ego
