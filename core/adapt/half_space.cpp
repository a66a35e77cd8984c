// SPDX-License-Identifier: MIT
#include "core/adapt/half_space.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// S-shaped weight of a signed distance (appendix B, figure 3), in centimetres.
double Safety(double centimetres) { return 1.0 / (1.0 + std::exp2(-centimetres)); }

double Depth(double violation, double ramp) {
  return ramp > 0.0 ? SoftRamp(violation, ramp) : std::max(0.0, violation);
}

}  // namespace

RelaxedPlane RelaxBetween(const HalfSpace& plane, double distance, const HalfSpace& projected,
                          double distance_projected, double height) {
  const double to_cm = 100.0 * 1.78 / height;
  const double safe = Safety(to_cm * distance);
  const double safe_projected = Safety(to_cm * distance_projected);
  const double sigma = safe / (safe + safe_projected);  // equation 3 of the appendix

  const Vec3 normal = glm::mix(projected.normal, plane.normal, sigma);
  const double length = glm::length(normal);
  RelaxedPlane relaxed;
  if (length < 1e-6) return relaxed;
  relaxed.half_space = {normal / length, glm::mix(projected.offset, plane.offset, sigma) / length};
  relaxed.strength = Smoothstep(2.0 * length);
  return relaxed;
}

HalfSpace Activate(const HalfSpace& relaxed, double retreat, double w) {
  return {relaxed.normal, relaxed.offset - (1.0 - w) * retreat};
}

LimbPosture SatisfyUpper(const LimbChain& chain, const LimbPosture& posture,
                         const HalfSpace& deflated, double ramp, double strength) {
  if (chain.base_locked) return posture;
  const LimbPlacement placed = Place(chain, posture);
  const double depth = strength * Depth(-deflated.Distance(placed.mid), ramp);
  if (!(depth > 0.0)) return posture;
  const Vec3 bone = placed.mid - chain.base_ws;
  const double length = glm::length(bone);
  if (length < 1e-9) return posture;
  const Vec3 upper = bone / length;
  const double sine_now = glm::dot(upper, deflated.normal);
  const Vec3 axis = glm::cross(upper, deflated.normal);
  const double across = glm::length(axis);
  if (across < 1e-9) return posture;  // along the normal: the bound below is zero
  // Elevation over the plane's own direction, from now to where the mid joint gains `depth`.
  const double sine = std::min(1.0, sine_now + depth / length);
  const double needed = std::asin(sine) - std::asin(std::clamp(sine_now, -1.0, 1.0));
  const double bound = std::atan2(across, std::abs(sine_now));
  const Quat turn = glm::angleAxis(std::min(needed, bound), axis / across);
  LimbPosture turned = posture;
  turned.base = glm::normalize(glm::conjugate(chain.frame_ws) * turn * placed.base_ws);
  return turned;
}

LimbPosture SatisfyLower(const LimbChain& chain, const LimbPosture& posture,
                         const HalfSpace& deflated, double ramp, double strength) {
  const LimbPosture turned = SatisfyUpper(chain, posture, deflated, ramp, strength);
  const LimbPlacement placed = Place(chain, turned);
  const double depth = strength * Depth(-deflated.Distance(placed.end), ramp);
  if (!(depth > 0.0)) return turned;
  return ReachEnd(chain, turned, placed.end + depth * deflated.normal);
}

}  // namespace ego
