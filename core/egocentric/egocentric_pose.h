// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/base/math.h"
#include "core/body/body_surface.h"
#include "core/egocentric/kinematic_path.h"
#include "core/egocentric/limb_point.h"
#include "core/geometry/lanes.h"

namespace ego {

/// How far the four points of a group are from a primitive each, without a metre: with q the
/// distance from the reference point (for a capsule: from its axis) and R what the surfaces
/// themselves fill of it (the point's own thickness, the capsule's radius),
///   inside = min(1, q / R),   gap = max(0, q - R) / tau.
/// On another body the distance is R' inside + tau' gap (equation 5): contact stays contact
/// whatever the thicknesses, and the point itself stays put where q passes through zero. tau is the
/// sum over the path's bones of length * (kLeastCosine + cosine).
struct CapsuleDistance {
  Quad inside{};
  Quad gap{};
  std::array<Quad, kMaxPathLength> cosine{};  // C: |cos alpha_i| along CapsulePaths::Path
};
/// By the capsules' slots.
using GroupDistances = std::array<CapsuleDistance, kOtherCapsuleCount>;

/// All tuples of equation 6 against the triangles of one crude mesh, summed, for the four points of
/// a group side by side. On another body every term lambda-hat (x + v) of equation 2 is linear in
/// that body's own samples, bone lengths and thickness, whatever triangle it belongs to; only their
/// coefficients are kept:
///   sum of lambda-hat (x + v) = sum over samples of weight * sample'
///                             + R_hips (thickness' * inside + sum over bones of length' * along).
struct MeshRelations {
  Quad importance{};   // sum of lambda-hat
  QuadVectors inside;  // of lambda-hat v-hat's direction, as far as the thickness fills it
  std::array<QuadVectors, kMaxPathLength> along;  // by column of MeshPaths; as many as it has
};
struct MeshCoordinates {
  std::array<Quad, kSampleCount> sample{};  // of lambda-hat x-hat, trunk's samples first
  MeshRelations trunk;
  MeshRelations head;
};

/// One tuple of equation 6 against a limb's capsule.
struct CapsuleRelation {
  double importance = 0.0;  // lambda-hat
  double axial = 0.0;       // x-hat: along the axis, 0 at the start joint, 1 at the end
  Vec3 direction_ls{0.0};   // x-hat's angle and v-hat's direction at once, in the bone frame
};

/// A foot against the ground (figure 6), in standing root heights.
struct GroundRelation {
  double importance = 0.0;  // lambda-hat
  /// (x, z) of the sole's middle from the root reference point g, less where it is in standing
  /// (`StandingPlace`): the width of the hips is the body's own.
  Vec2 offset{0.0};
  double gap = 0.0;      // height of the sole
  double on_ball = 0.5;  // 0: stands on the heel, 1: on the ball
};

/// Egocentric coordinates of one point: E_j of equation 6. Those against trunk and head stand in
/// `EgocentricPose::mesh`, the distances from capsules in `EgocentricPose::capsule_distance`.
struct PointCoordinates {
  double mesh_importance_max = 0.0;  // largest lambda-hat of a single triangle
  std::array<CapsuleRelation, kOtherSegmentCount> capsule;
  CapsuleRelation hand;   // points of an arm: the other hand as a capsule
  GroundRelation ground;  // ankles
  /// Sum and largest of the importances before normalisation, times the performer's height: these
  /// compare different points (appendix C, body folding) where lambda-hat cannot.
  double importance_sum = 0.0;
  double importance_max = 0.0;
  /// The largest importance with the saturation used for gamma of appendix C.
  double priority = 0.0;
};

/// The surface normal of a hand or foot against every primitive (equation 3). The deviation beta_i
/// is kept as the normal's components in the primitive's tangent frame (triangles), bone frame
/// (capsules) and the world (ground): the same information, without the singularity that the
/// smallest rotation between two normals has exactly where surfaces face each other. Those of the
/// triangles, four side by side, are multiplied by lambda-hat of `OrientingPoint`.
struct NormalCoordinates {
  std::array<QuadVectors, kTriangleCount / 4> triangle{};
  std::array<Vec3, kOtherSegmentCount> capsule{};
  Vec3 ground{0.0};
};

/// Plane of a segment against one segment of another limb (section 5.3): the tangent plane of that
/// other capsule at its closest point.
struct EgocentricPlane {
  double axial = 0.0;   // closest point on the other segment
  Vec3 normal_ls{0.0};  // unit, towards this segment, in the other segment's bone frame
  double slack = 0.0;   // <= 0: how deep the performer's own segment lies, in heights
};

/// Samples of an arm that are kept out of the body (upper arm .5 .75 1, forearm .2 .4 .6 .8 1),
/// then its points of contact: wrist, palm, fingertip.
inline constexpr std::size_t kClearanceSampleCount = 11;
inline constexpr std::size_t kFirstContactSample = 8;
inline constexpr std::size_t kContactCount = 3;
constexpr LimbPoint ContactPoint(Limb arm, std::size_t contact) {
  const std::array<LimbPoint, kContactCount> points = {EndPoint(arm), PalmPoint(arm),
                                                       FingertipPoint(arm)};
  return points[contact];
}
/// What they are kept clear of: trunk, head, the six capsules of the other limbs, the other hand.
inline constexpr std::size_t kObstacleCount = 9;

/// The performer's own clearance of one sample, in heights: positive is free. `known` is false
/// where the obstacle was too far to matter.
struct Clearance {
  double distance = 0.0;
  bool known = false;
  /// The way out: of trunk and head in the hips' frame, of a capsule from its axis in its bone
  /// frame.
  Vec3 direction_ls{0.0};
  double trust = 1.0;  // capsules: fades where the sample nears the axis, where no direction
                       // leads out
};

/// Which readings of the representation were used; `Adapt` follows them.
struct EgocentricForm {
  bool hand_points = true;
  bool own_thickness = true;
  bool sole_contact = true;
  bool legs_relate_to_arms = false;
  bool clearance = true;
};

/// Whether the points of a group relate to the capsule of a slot.
inline bool RelatesToCapsule(const EgocentricForm& form, std::size_t group, std::size_t slot) {
  const Limb limb = LimbOf(kPointGroups[group][0]);
  if (slot == kHandSlot) return IsArm(limb) && form.hand_points;
  return IsArm(limb) || !IsArm(LimbOf(OtherSegment(limb, slot))) || form.legs_relate_to_arms;
}

/// The egocentric representation of a posture (section 5). No metre in it: nothing of the
/// performer's size is left.
struct EgocentricPose {
  EgocentricForm form;
  std::array<Quat, kJointCount> rotation_ls{};          // 1) joint angles
  std::array<Quat, kJointCount> rotation_ws{};          //    the same, accumulated: no body enters
  Vec3 root{0.0};                                       // 2) (g-hat, h-hat_root) of equation 1
  std::array<PointCoordinates, kLimbPointCount> point;  // 3)
  std::array<MeshCoordinates, kPointGroupCount> mesh;   //    by kPointGroups
  std::array<GroupDistances, kPointGroupCount> capsule_distance;
  std::array<NormalCoordinates, kLimbCount> normal;  //    palms of the arms, soles of the legs
  std::array<std::array<EgocentricPlane, kOtherSegmentCount>, kSegmentCount> plane;  // 4)
  using ArmClearance = std::array<std::array<Clearance, kObstacleCount>, kClearanceSampleCount>;
  std::array<ArmClearance, 2> clearance;  //    remedy: arms kept out of the body
};

/// The point whose importances weigh a hand's or foot's normal: the palm where hands have points,
/// else the end joint.
inline LimbPoint OrientingPoint(const EgocentricPose& pose, Limb limb) {
  return IsArm(limb) && pose.form.hand_points ? PalmPoint(limb) : EndPoint(limb);
}

}  // namespace ego
