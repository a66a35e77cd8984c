// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "core/adapt/limb_ik.h"
#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// The points x with normal . x >= offset, world space, metres.
struct HalfSpace {
  Vec3 normal{0.0};
  double offset = 0.0;
  double Distance(const Vec3& p) const { return glm::dot(normal, p) - offset; }
  /// Of a capsule's skin.
  double Distance(const PosedCapsule& capsule) const {
    return std::min(Distance(capsule.start), Distance(capsule.end)) - capsule.radius;
  }
};

/// The egocentric plane of a segment on the avatar (section 5.3): the tangent plane of the other
/// capsule `other` at the mapped closest point, moved back by the performer's own slack.
inline HalfSpace MapPlane(const EgocentricPlane& plane, const PosedCapsule& other, double height) {
  const Vec3 normal = other.frame * plane.normal_ls;
  return {normal, glm::dot(normal, other.At(plane.axial)) + other.radius + plane.slack * height};
}

/// Relaxation of appendix B for segment `own` against `other`: `plane` (mapped, ep'_{i|j}) is
/// interpolated with ep+_{i|j}, the tangent plane of `other` that is parallel to the other
/// segment's own plane `reverse` (ep'_{j|i}), by how well each is satisfied. Distances are weighed
/// in centimetres at 1.78 m. Where both normals oppose each other the relaxed normal fades and
/// `strength` goes to zero with it.
///
/// Where `own` satisfies both planes it satisfies every plane between them: strength is then zero
/// and nothing more is computed.
struct RelaxedPlane {
  HalfSpace half_space;
  double strength = 0.0;  // in [0, 1]
};
/// Of both planes with the distances of `own` to them.
RelaxedPlane RelaxBetween(const HalfSpace& plane, double distance, const HalfSpace& projected,
                          double distance_projected, double height);
inline RelaxedPlane Relax(const HalfSpace& plane, const EgocentricPlane& reverse,
                          const PosedCapsule& own, const PosedCapsule& other, double height,
                          double slack) {
  const Vec3 opposite = -(own.frame * reverse.normal_ls);
  const double support = std::max(glm::dot(opposite, other.start), glm::dot(opposite, other.end));
  const HalfSpace projected{opposite, support + other.radius + slack * height};
  const double distance = plane.Distance(own);
  const double distance_projected = projected.Distance(own);
  if (distance >= 0.0 && distance_projected >= 0.0) return {};
  return RelaxBetween(plane, distance, projected, distance_projected, height);
}

/// Progressive activation (figure 14): the plane, held back by `retreat` metres at w = 0 and fully
/// in place at w = 1.
HalfSpace Activate(const HalfSpace& relaxed, double retreat, double w);

/// Brings a limb's upper segment into a half-space already deflated by the segment's radius
/// (section 6.3): turns the base joint until the mid joint lies on the plane, by no more than the
/// angle between upper bone and normal (the ill-conditioned case of figure 17i), where the bound
/// goes to zero with it. `ramp` metres of violation take hold smoothly. Nothing changes where the
/// mid joint is inside.
LimbPosture SatisfyUpper(const LimbChain& chain, const LimbPosture& posture,
                         const HalfSpace& deflated, double ramp, double strength);

/// The same for the lower segment: first the mid joint, then the end joint to its closest point on
/// the plane by analytic IK (figure 17d-f).
LimbPosture SatisfyLower(const LimbChain& chain, const LimbPosture& posture,
                         const HalfSpace& deflated, double ramp, double strength);

}  // namespace ego
