// SPDX-License-Identifier: MIT
#include "core/solve/bound_marker.h"

#include <algorithm>
#include <cmath>

#include "core/solve/posture_cost.h"

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

bool FollowsChild(const BoundMarker& marker) {
  return marker.child != J::kHips && (marker.slides || marker.Share(SkinShare::kWithChild) != 0.0);
}

/// d(joint's rotation, on the right) / d(dof of that joint).
Vec3 RightTurn(const Dof& dof, const ModelPose& pose, const Vec3& axis_ws) {
  if (dof.kind == DofKind::kTranslation) return Vec3{0.0};
  return glm::conjugate(pose.Rotation(dof.joint)) * axis_ws;
}

}  // namespace

JointTurn TurnOf(HumanoidJoint joint, const Quat& rotation_ls) {
  constexpr double kSoftness = 0.02;
  const Quat q = glm::conjugate(NeutralPosture().rotation_ls[Index(joint)]) * rotation_ls;
  const Vec3 v{q.x, q.y, q.z};
  const double s = q.w * q.w + kSoftness;
  const double sign = q.w / std::sqrt(s);  // smooth: q and -q are one rotation
  const double d_sign = kSoftness / (s * std::sqrt(s));
  const Mat3 cross{0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0};  // columns of [v]
  return {2.0 * sign * v, sign * (q.w * Mat3{1.0} + cross) - d_sign * glm::outerProduct(v, v)};
}

std::array<double, kSlideCount> SlideTurns(const BoundMarker& marker, const ModelPose& pose) {
  std::array<double, kSlideCount> turns{};
  if (marker.joint != J::kHips) {
    const Vec3 own = TurnOf(marker.joint, LocalRotation(marker.joint, pose)).value;
    for (std::size_t i = 0; i < 3; ++i) turns[i] = own[static_cast<int>(i)];
  }
  if (marker.child != J::kHips) {
    const Vec3 next = TurnOf(marker.child, LocalRotation(marker.child, pose)).value;
    for (std::size_t i = 0; i < 3; ++i) turns[3 + i] = next[static_cast<int>(i)];
  }
  return turns;
}

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
  if (marker.slides) {
    const std::array<double, kSlideCount> turns = SlideTurns(marker, pose);
    Vec3 slid{0.0};
    for (std::size_t i = 0; i < kSlideCount; ++i) slid += turns[i] * marker.slide[i];
    placed.slid_ws = rotation * slid;
    placed.point_ws += placed.slid_ws;
  }
  return placed;
}

Vec3 MarkerPosition(const BoundMarker& marker, const ModelPose& pose) {
  return Carry(marker, pose).point_ws;
}

std::span<const std::uint8_t> Chain(const BoundMarker& marker) {
  return Chain(FollowsChild(marker) ? marker.child : marker.joint);
}

void MarkerJacobian(const BoundMarker& marker, const CarriedMarker& placed, const ModelPose& pose,
                    const std::array<Vec3, kPoseDof>& axis_ws,
                    std::array<Vec3, kPoseDof>& column_ws) {
  const double parent = marker.Share(SkinShare::kWithParent);
  const double child = marker.Share(SkinShare::kWithChild);
  const double twist = marker.Share(SkinShare::kOffTwist);
  const Vec3& origin = pose.Position(marker.joint);
  const Vec3 own_arm = placed.own_ws - origin;
  const Vec3 moved =
      (1.0 - parent - child) * own_arm + child * (placed.child_ws - origin) + placed.slid_ws;
  const bool follows_child = FollowsChild(marker);
  Mat3 own_slide{0.0};  // d(slid_ws) / d(turn on the right of the own joint)
  Mat3 child_slide{0.0};
  if (marker.slides) {
    const Mat3 frame = glm::mat3_cast(pose.Rotation(marker.joint));
    const auto& d = marker.slide;
    if (marker.joint != J::kHips) {
      own_slide = frame * Mat3{d[0], d[1], d[2]} *
                  TurnOf(marker.joint, LocalRotation(marker.joint, pose)).gradient;
    }
    if (follows_child) {
      child_slide = frame * Mat3{d[3], d[4], d[5]} *
                    TurnOf(marker.child, LocalRotation(marker.child, pose)).gradient;
    }
  }
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
      if (marker.slides) column_ws[i] += own_slide * RightTurn(dof, pose, axis);
      if (twist == 0.0) continue;
      // A ball's step turns the joint's own axes; a hinge's axial angle is the twist itself.
      const double rate = dof.kind == DofKind::kBall ? twist_gradient[dof.axis]
                          : dof.kind == DofKind::kAxial
                              ? glm::dot(twist_gradient, LimbBone(marker.joint))
                              : 0.0;
      column_ws[i] += rate * slip;
    } else if (follows_child && dof.joint == marker.child) {
      column_ws[i] = child * glm::cross(axis, placed.child_ws - pose.Position(marker.child));
      if (marker.slides) column_ws[i] += child_slide * RightTurn(dof, pose, axis);
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
