// SPDX-License-Identifier: MIT
#include "core/adapt/limb_chain.h"

#include <cmath>

#include "core/geometry/rotation.h"

namespace ego {

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

}  // namespace ego
