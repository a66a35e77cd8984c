// SPDX-License-Identifier: MIT
#include "core/solve/bound_marker.h"

#include <algorithm>

namespace ego {
namespace {

using J = HumanoidJoint;

/// Direction of a limb's bone in its joint's frame; zero for all other joints.
constexpr Vec3 LimbBone(J joint) {
  for (const Limb limb : kLimbs) {
    if (JointsOf(limb).base == joint || JointsOf(limb).mid == joint) {
      return CanonicalDirection(limb);
    }
  }
  return Vec3{0.0};
}

/// Below this share of untwisted rotation (a bone folded back by 145 degrees) twist means nothing.
constexpr double kLeastUnfolded = 0.1;

/// Sine of a rotation's twist about an axis (swing-twist decomposition). Unlike the angle it has no
/// jump at half a turn.
double TwistSine(const Quat& q, const Vec3& axis) {
  const double along = glm::dot(Vec3{q.x, q.y, q.z}, axis);
  return 2.0 * q.w * along / std::max(kLeastUnfolded, q.w * q.w + along * along);
}

/// d TwistSine(q exp(delta)) / d delta at delta = 0.
Vec3 TwistSineGradient(const Quat& q, const Vec3& axis) {
  const Vec3 v{q.x, q.y, q.z};
  const double along = glm::dot(v, axis);
  const Vec3 d_w = -0.5 * v;
  const Vec3 d_along = 0.5 * (q.w * axis + glm::cross(axis, v));
  const double s = q.w * q.w + along * along;
  const Vec3 d_numerator = 2.0 * (along * d_w + q.w * d_along);
  if (s < kLeastUnfolded) return d_numerator / kLeastUnfolded;
  const Vec3 d_s = 2.0 * (q.w * d_w + along * d_along);
  return (d_numerator - (2.0 * q.w * along / s) * d_s) / s;
}

Quat LocalRotation(J joint, const ModelPose& pose) {
  return glm::conjugate(pose.Rotation(Parent(joint))) * pose.Rotation(joint);
}

}  // namespace

CarriedMarker Carry(const BoundMarker& marker, const ModelPose& pose) {
  CarriedMarker placed;
  const Vec3& origin = pose.Position(marker.joint);
  const Quat& rotation = pose.Rotation(marker.joint);
  Vec3 offset = rotation * marker.offset_ls;
  const double parent = marker.Share(SkinShare::kWithParent);
  const double child = marker.Share(SkinShare::kWithChild);
  placed.child_ws = origin + offset;
  if (marker.child != J::kHips) {
    const Vec3& end = pose.Position(marker.child);
    placed.child_ws =
        end + pose.Rotation(marker.child) * (glm::conjugate(rotation) * (origin + offset - end));
  }
  const Vec3 bone = LimbBone(marker.joint);
  if (bone != Vec3{0.0}) {
    placed.bone_ws = rotation * bone;
    placed.twist = TwistSine(LocalRotation(marker.joint, pose), bone);
    const double share = marker.Share(SkinShare::kOffTwist);
    if (share != 0.0) offset = glm::angleAxis(-share * placed.twist, placed.bone_ws) * offset;
  }
  placed.own_ws = origin + offset;
  placed.parent_ws = marker.joint == J::kHips
                         ? placed.own_ws
                         : origin + pose.Rotation(Parent(marker.joint)) * marker.offset_ls;
  placed.point_ws =
      (1.0 - parent - child) * placed.own_ws + parent * placed.parent_ws + child * placed.child_ws;
  return placed;
}

Vec3 MarkerPosition(const BoundMarker& marker, const ModelPose& pose) {
  return Carry(marker, pose).point_ws;
}

std::span<const std::uint8_t> Chain(const BoundMarker& marker) {
  return Chain(marker.Share(SkinShare::kWithChild) != 0.0 ? marker.child : marker.joint);
}

void MarkerJacobian(const BoundMarker& marker, const CarriedMarker& placed, const ModelPose& pose,
                    const std::array<Vec3, kPoseDof>& axis_ws,
                    std::array<Vec3, kPoseDof>& column_ws) {
  const double parent = marker.Share(SkinShare::kWithParent);
  const double child = marker.Share(SkinShare::kWithChild);
  const double twist = marker.Share(SkinShare::kOffTwist);
  const Vec3& origin = pose.Position(marker.joint);
  const Vec3 own_arm = placed.own_ws - origin;
  const Vec3 moved = (1.0 - parent - child) * own_arm + child * (placed.child_ws - origin);
  Vec3 slip{0.0};  // per unit of twist
  Vec3 twist_gradient{0.0};
  if (twist != 0.0 && placed.bone_ws != Vec3{0.0}) {
    slip = -(1.0 - parent - child) * twist * glm::cross(placed.bone_ws, own_arm);
    twist_gradient = TwistSineGradient(LocalRotation(marker.joint, pose), LimbBone(marker.joint));
  }
  const std::span<const std::uint8_t> chain = Chain(marker);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Dof& dof = Dofs()[chain[i]];
    const Vec3& axis = axis_ws[chain[i]];
    if (dof.kind == DofKind::kTranslation) {
      column_ws[i] = axis;
    } else if (dof.joint == marker.joint) {
      column_ws[i] = glm::cross(axis, moved);
      if (twist == 0.0) continue;
      // A ball's step turns the joint's own axes; a hinge's axial angle is the twist itself.
      const double rate = dof.kind == DofKind::kBall ? twist_gradient[dof.axis]
                          : dof.kind == DofKind::kAxial
                              ? glm::dot(twist_gradient, LimbBone(marker.joint))
                              : 0.0;
      column_ws[i] += rate * slip;
    } else if (child != 0.0 && dof.joint == marker.child) {
      column_ws[i] = child * glm::cross(axis, placed.child_ws - pose.Position(marker.child));
    } else {
      column_ws[i] = glm::cross(axis, placed.point_ws - pose.Position(dof.joint));
    }
  }
}

Mat3 OffsetJacobian(const BoundMarker& marker, const CarriedMarker& placed, const ModelPose& pose) {
  const double parent = marker.Share(SkinShare::kWithParent);
  const double child = marker.Share(SkinShare::kWithChild);
  const double twist = marker.Share(SkinShare::kOffTwist);
  Quat own = pose.Rotation(marker.joint);
  if (twist != 0.0 && placed.bone_ws != Vec3{0.0}) {
    own = glm::angleAxis(-twist * placed.twist, placed.bone_ws) * own;
  }
  Mat3 sum = (1.0 - parent - child) * glm::mat3_cast(own);
  if (parent != 0.0) sum += parent * glm::mat3_cast(pose.Rotation(Parent(marker.joint)));
  if (child != 0.0) sum += child * glm::mat3_cast(pose.Rotation(marker.child));
  return sum;
}

std::array<Vec3, kSkinShareCount> ShareJacobian(const BoundMarker& marker,
                                                const CarriedMarker& placed,
                                                const ModelPose& pose) {
  const double own =
      1.0 - marker.Share(SkinShare::kWithParent) - marker.Share(SkinShare::kWithChild);
  return {placed.parent_ws - placed.own_ws, placed.child_ws - placed.own_ws,
          -own * placed.twist *
              glm::cross(placed.bone_ws, placed.own_ws - pose.Position(marker.joint))};
}

}  // namespace ego
