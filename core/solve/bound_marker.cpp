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

constexpr bool IsFoot(J joint) { return joint == J::kLeftFoot || joint == J::kRightFoot; }

using SlideJointList = std::array<J, kSlideJoints>;

constexpr std::array<SlideJointList, kJointCount> MakeSlideJoints() {
  std::array<SlideJointList, kJointCount> all{};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    all[j].fill(J::kHips);
    std::size_t n = 0;
    all[j][n++] = static_cast<J>(j);
    for (std::size_t c = 1; c < kJointCount; ++c) {
      if (Index(kParent[c]) == j) all[j][n++] = static_cast<J>(c);
    }
  }
  return all;
}

constexpr std::array<SlideJointList, kJointCount> kSlidesWith = MakeSlideJoints();

/// Chains of a joint and of those among its children (bits, in the order of kSlidesWith) that its
/// marker follows, too.
struct Chains {
  static constexpr std::size_t kSubsets = std::size_t{1} << (kSlideJoints - 1);
  std::array<std::array<std::array<std::uint8_t, kPoseDof>, kSubsets>, kJointCount> dofs{};
  std::array<std::array<std::size_t, kSubsets>, kJointCount> count{};

  Chains() {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      for (std::size_t subset = 0; subset < kSubsets; ++subset) {
        std::array<bool, kPoseDof> moves{};
        for (const std::uint8_t d : ego::Chain(static_cast<J>(j))) moves[d] = true;
        for (std::size_t k = 1; k < kSlideJoints; ++k) {
          if ((subset >> (k - 1) & 1u) == 0) continue;
          for (const std::uint8_t d : ego::Chain(kSlidesWith[j][k])) moves[d] = true;
        }
        for (std::size_t d = 0; d < kPoseDof; ++d) {
          if (moves[d]) dofs[j][subset][count[j][subset]++] = static_cast<std::uint8_t>(d);
        }
      }
    }
  }
};

/// Whether the joint is not one of those that carry the marker's own bone.
bool IsChild(const BoundMarker& marker, J joint) {
  return joint != J::kHips && Parent(joint) == marker.joint;
}

/// d(joint's rotation, on the right) / d(dof of that joint).
Vec3 RightTurn(const Dof& dof, const ModelPose& pose, const Vec3& axis_ws) {
  if (dof.kind == DofKind::kTranslation) return Vec3{0.0};
  return glm::conjugate(pose.Rotation(dof.joint)) * axis_ws;
}

JointTurn TurnFrom(const Quat& rest, const Quat& rotation) {
  constexpr double kSoftness = 0.02;
  const Quat q = glm::conjugate(rest) * rotation;
  const Vec3 v{q.x, q.y, q.z};
  const double s = q.w * q.w + kSoftness;
  const double sign = q.w / std::sqrt(s);  // smooth: q and -q are one rotation
  const double d_sign = kSoftness / (s * std::sqrt(s));
  const Mat3 cross{0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0};  // columns of [v]
  return {2.0 * sign * v, sign * (q.w * Mat3{1.0} + cross) - d_sign * glm::outerProduct(v, v)};
}

JointTurn SlideTurn(const BoundMarker& marker, J joint, const ModelPose& pose) {
  const Quat rotation = LocalRotation(joint, pose);
  return IsFoot(joint) ? TurnFrom(marker.foot_rest_ls, rotation) : TurnOf(joint, rotation);
}

}  // namespace

JointTurn TurnOf(HumanoidJoint joint, const Quat& rotation_ls) {
  return TurnFrom(NeutralPosture().rotation_ls[Index(joint)], rotation_ls);
}

const std::array<HumanoidJoint, kSlideJoints>& SlideJoints(HumanoidJoint joint) {
  return kSlidesWith[Index(joint)];
}

void TurnFootFrame(HumanoidJoint foot, const Quat& level, BoundMarker& marker) {
  const J toes = foot == J::kLeftFoot ? J::kLeftToes : J::kRightToes;
  const bool on_foot = marker.joint == foot || marker.joint == toes;
  if (on_foot) marker.offset_ls = level * marker.offset_ls;
  for (std::size_t k = 0; k < kSlideJoints; ++k) {
    const J joint = SlideJoints(marker.joint)[k];
    if (joint != foot && joint != toes) continue;
    if (joint == foot) marker.foot_rest_ls = marker.foot_rest_ls * glm::conjugate(level);
    Vec3* d = marker.slide.data() + kSlidesPerJoint * k;
    const Mat3 turned = Mat3{d[0], d[1], d[2]} * glm::mat3_cast(glm::conjugate(level));
    for (int axis = 0; axis < 3; ++axis) d[axis] = turned[axis];
    if (!on_foot) continue;
    for (std::size_t i = 0; i < kSlidesPerJoint; ++i) d[i] = level * d[i];
  }
}

std::array<double, kSlideCount> SlideTurns(const BoundMarker& marker, const ModelPose& pose) {
  std::array<double, kSlideCount> turns{};
  for (std::size_t k = 0; k < kSlideJoints; ++k) {
    const J joint = SlideJoints(marker.joint)[k];
    if (joint == J::kHips) continue;
    const Vec3 turn = SlideTurn(marker, joint, pose).value;
    double* of_joint = turns.data() + kSlidesPerJoint * k;
    for (int axis = 0; axis < 3; ++axis) of_joint[axis] = turn[axis];
    of_joint[3] = glm::dot(turn, turn);
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
  static const Chains kChains;
  std::size_t subset = 0;
  for (std::size_t k = 1; k < kSlideJoints; ++k) {
    const J child = SlideJoints(marker.joint)[k];
    if (child == J::kHips) continue;
    const bool carried = marker.child == child && marker.Share(SkinShare::kWithChild) != 0.0;
    if (carried || marker.slides) subset |= std::size_t{1} << (k - 1);
  }
  const std::size_t j = Index(marker.joint);
  return std::span(kChains.dofs[j][subset]).first(kChains.count[j][subset]);
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
  std::array<Mat3, kSlideJoints> slide{};  // d(slid_ws) / d(turn on the right of the joint)
  if (marker.slides) {
    const Mat3 frame = glm::mat3_cast(pose.Rotation(marker.joint));
    for (std::size_t k = 0; k < kSlideJoints; ++k) {
      const J joint = SlideJoints(marker.joint)[k];
      if (joint == J::kHips) continue;
      const Vec3* d = marker.slide.data() + kSlidesPerJoint * k;
      const JointTurn turn = SlideTurn(marker, joint, pose);
      const Mat3 by_turn = Mat3{d[0], d[1], d[2]} + 2.0 * glm::outerProduct(d[3], turn.value);
      slide[k] = frame * by_turn * turn.gradient;
    }
  }
  const auto slid = [&](const Dof& dof, const Vec3& axis) {
    for (std::size_t k = 0; k < kSlideJoints; ++k) {
      if (SlideJoints(marker.joint)[k] == dof.joint) return slide[k] * RightTurn(dof, pose, axis);
    }
    return Vec3{0.0};
  };
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
      if (marker.slides) column_ws[i] += slid(dof, axis);
      if (twist == 0.0) continue;
      // A ball's step turns the joint's own axes; a hinge's axial angle is the twist itself.
      const double rate = dof.kind == DofKind::kBall ? twist_gradient[dof.axis]
                          : dof.kind == DofKind::kAxial
                              ? glm::dot(twist_gradient, LimbBone(marker.joint))
                              : 0.0;
      column_ws[i] += rate * slip;
    } else if (IsChild(marker, dof.joint)) {
      column_ws[i] = Vec3{0.0};
      if (dof.joint == marker.child) {
        column_ws[i] = child * glm::cross(axis, placed.child_ws - pose.Position(marker.child));
      }
      if (marker.slides) column_ws[i] += slid(dof, axis);
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
