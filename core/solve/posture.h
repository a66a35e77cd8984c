// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/math.h"
#include "core/skeleton/pose.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// Degrees of freedom of a posture: root translation and rotation, ball joints, hinges (elbow,
/// knee) of one flexion and one axial rotation, and toes that bend.
inline constexpr std::size_t kPoseDof = 61;

/// What a degree of freedom does to what hangs on its joint.
enum class DofKind : std::uint8_t { kTranslation, kBall, kFlexion, kAxial };

struct Dof {
  HumanoidJoint joint = HumanoidJoint::kHips;
  DofKind kind = DofKind::kBall;
  int axis = 0;  // of a translation: world axis; of a ball: axis of the joint's own frame
};

/// In joint order, so that a joint's chain has ascending indices.
const std::array<Dof, kPoseDof>& Dofs();

/// Index of a joint's first degree of freedom of rotation, and how many it has.
struct DofRange {
  std::size_t first = 0;
  std::size_t count = 0;
};
DofRange DofsOf(HumanoidJoint joint);

/// The degrees of freedom that move points carried by a joint, ascending.
std::span<const std::uint8_t> Chain(HumanoidJoint joint);

/// The joints of toes, left first, and the axis they bend up about.
inline constexpr std::array<HumanoidJoint, 2> kToes = {HumanoidJoint::kLeftToes,
                                                       HumanoidJoint::kRightToes};
inline constexpr Vec3 kToeAxis{-1.0, 0.0, 0.0};

/// A pose on the solver's coordinates: mid joints of limbs are hinges,
/// rotation = flexion about FlexionAxis, then axial rotation about the bone.
struct Posture {
  Vec3 root_ws{0.0};
  std::array<Quat, kJointCount>
      rotation_ls{};                         // of mid joints and toes: made from the angles below
  std::array<double, kLimbCount> flexion{};  // radians
  std::array<double, kLimbCount> axial{};    // radians
  std::array<double, kToes.size()> toes{};   // radians, bent up
};

/// The posture nearest to a pose: a rotation off the hinge of a mid joint or of toes is dropped.
Posture PostureFromPose(const Pose& pose);
Pose PoseFromPosture(const Posture& posture);

/// The posture moved by a step of all degrees of freedom: root_ws + step, rotation * exp(step),
/// angle + step.
Posture Moved(const Posture& posture, std::span<const double, kPoseDof> step);

/// World axes of all degrees of freedom of a posed skeleton: the direction of a translation, the
/// axis of a rotation (a point x moves by axis x (x - joint) per radian).
void DofAxes(const ModelPose& model, std::array<Vec3, kPoseDof>& axis_ws);

/// Rotation vector of the shorter turn.
Vec3 RotationVector(const Quat& q);
Quat Exp(const Vec3& rotation_vector);
/// d RotationVector(q exp(delta)) / d delta at delta = 0, where v = RotationVector(q).
Mat3 RotationVectorJacobian(const Vec3& v);

}  // namespace ego
