// SPDX-License-Identifier: MIT
#include "core/solve/posture.h"

#include <cmath>

namespace ego {
namespace {

using J = HumanoidJoint;

/// The limb whose mid joint this is, or kLimbCount.
constexpr std::size_t HingeOf(J joint) {
  for (const Limb limb : kLimbs) {
    if (JointsOf(limb).mid == joint) return Index(limb);
  }
  return kLimbCount;
}

/// The foot whose toes these are, or kToes.size().
constexpr std::size_t ToesOf(J joint) {
  return joint == kToes[0] ? 0 : joint == kToes[1] ? 1 : kToes.size();
}

struct Layout {
  std::array<Dof, kPoseDof> dofs{};
  std::array<DofRange, kJointCount> range{};
  std::array<std::array<std::uint8_t, kPoseDof>, kJointCount> chain{};
  std::array<std::size_t, kJointCount> chain_length{};
};

constexpr Layout MakeLayout() {
  Layout layout;
  std::size_t n = 0;
  for (int axis = 0; axis < 3; ++axis) {
    layout.dofs[n++] = {J::kHips, DofKind::kTranslation, axis};
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    layout.range[j].first = n;
    if (ToesOf(joint) < kToes.size()) {
      layout.dofs[n++] = {joint, DofKind::kFlexion, 0};
    } else if (HingeOf(joint) < kLimbCount) {
      layout.dofs[n++] = {joint, DofKind::kFlexion, 0};
      layout.dofs[n++] = {joint, DofKind::kAxial, 0};
    } else {
      for (int axis = 0; axis < 3; ++axis) layout.dofs[n++] = {joint, DofKind::kBall, axis};
    }
    layout.range[j].count = n - layout.range[j].first;
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    std::array<bool, kJointCount> on_path{};
    for (std::size_t k = j;; k = Index(kParent[k])) {
      on_path[k] = true;
      if (k == 0) break;
    }
    for (std::size_t d = 0; d < kPoseDof; ++d) {
      if (!on_path[Index(layout.dofs[d].joint)]) continue;
      layout.chain[j][layout.chain_length[j]++] = static_cast<std::uint8_t>(d);
    }
  }
  return layout;
}

constexpr Layout kLayout = MakeLayout();
static_assert(kLayout.dofs[kPoseDof - 1].joint == J::kRightToes);

Quat HingeRotation(Limb limb, double flexion, double axial) {
  return glm::angleAxis(flexion, FlexionAxis(limb)) *
         glm::angleAxis(axial, CanonicalDirection(limb));
}

}  // namespace

const std::array<Dof, kPoseDof>& Dofs() { return kLayout.dofs; }
DofRange DofsOf(HumanoidJoint joint) { return kLayout.range[Index(joint)]; }

std::span<const std::uint8_t> Chain(HumanoidJoint joint) {
  const std::size_t j = Index(joint);
  return std::span(kLayout.chain[j]).first(kLayout.chain_length[j]);
}

Posture PostureFromPose(const Pose& pose) {
  Posture posture;
  posture.root_ws = pose.root_ws;
  posture.rotation_ls = pose.rotation_ls;
  for (std::size_t i = 0; i < kToes.size(); ++i) {
    Quat& q = posture.rotation_ls[Index(kToes[i])];
    const double half = std::atan2(glm::dot(Vec3{q.x, q.y, q.z}, kToeAxis), q.w);
    posture.toes[i] = std::remainder(2.0 * half, 2.0 * kPi);
    q = glm::angleAxis(posture.toes[i], kToeAxis);
  }
  for (const Limb limb : kLimbs) {
    const std::size_t i = Index(limb);
    Quat& q = posture.rotation_ls[Index(JointsOf(limb).mid)];
    const Vec3 bone = CanonicalDirection(limb);
    const Vec3 axis = FlexionAxis(limb);
    // q = swing * twist about the bone; the swing's part about the hinge is the flexion.
    const Vec3 v{q.x, q.y, q.z};
    const double half_twist = std::atan2(glm::dot(v, bone), q.w);
    posture.axial[i] = std::remainder(2.0 * half_twist, 2.0 * kPi);
    const Quat swing = q * glm::angleAxis(-posture.axial[i], bone);
    const double half_flexion =
        std::atan2(glm::dot(Vec3{swing.x, swing.y, swing.z}, axis), swing.w);
    posture.flexion[i] = std::remainder(2.0 * half_flexion, 2.0 * kPi);
    q = HingeRotation(limb, posture.flexion[i], posture.axial[i]);
  }
  return posture;
}

Pose PoseFromPosture(const Posture& posture) {
  Pose pose;
  pose.root_ws = posture.root_ws;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const Quat q = glm::normalize(posture.rotation_ls[j]);
    pose.rotation_ls[j] = q.w < 0.0 ? -q : q;
  }
  return pose;
}

Posture Moved(const Posture& posture, std::span<const double, kPoseDof> step) {
  Posture moved = posture;
  moved.root_ws += Vec3{step[0], step[1], step[2]};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    const DofRange range = kLayout.range[j];
    if (range.count == 3) {
      const Vec3 turn{step[range.first], step[range.first + 1], step[range.first + 2]};
      moved.rotation_ls[j] = glm::normalize(posture.rotation_ls[j] * Exp(turn));
    } else if (range.count == 2) {
      const std::size_t limb = HingeOf(joint);
      moved.flexion[limb] += step[range.first];
      moved.axial[limb] += step[range.first + 1];
      moved.rotation_ls[j] =
          HingeRotation(static_cast<Limb>(limb), moved.flexion[limb], moved.axial[limb]);
    } else {
      const std::size_t toes = ToesOf(joint);
      moved.toes[toes] += step[range.first];
      moved.rotation_ls[j] = glm::angleAxis(moved.toes[toes], kToeAxis);
    }
  }
  return moved;
}

void DofAxes(const ModelPose& model, std::array<Vec3, kPoseDof>& axis_ws) {
  for (std::size_t d = 0; d < 3; ++d) {
    axis_ws[d] = Vec3{0.0};
    axis_ws[d][static_cast<int>(d)] = 1.0;
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    const DofRange range = kLayout.range[j];
    if (range.count == 3) {
      const Mat3 frame = glm::mat3_cast(model.rotation_ws[j]);
      for (std::size_t k = 0; k < 3; ++k) axis_ws[range.first + k] = frame[static_cast<int>(k)];
    } else if (range.count == 2) {
      const auto limb = static_cast<Limb>(HingeOf(joint));
      axis_ws[range.first] = model.rotation_ws[Index(kParent[j])] * FlexionAxis(limb);
      axis_ws[range.first + 1] = model.rotation_ws[j] * CanonicalDirection(limb);
    } else {
      axis_ws[range.first] = model.rotation_ws[j] * kToeAxis;
    }
  }
}

Vec3 RotationVector(const Quat& q) {
  const double sign = q.w < 0.0 ? -1.0 : 1.0;
  const Vec3 v = sign * Vec3{q.x, q.y, q.z};
  const double s = glm::length(v);
  if (s < 1e-9) return 2.0 * v;
  return (2.0 * std::atan2(s, sign * q.w) / s) * v;
}

Quat Exp(const Vec3& rotation_vector) {
  const double angle = glm::length(rotation_vector);
  const double scale = angle < 1e-8 ? 0.5 : std::sin(0.5 * angle) / angle;
  const Vec3 v = scale * rotation_vector;
  return {std::cos(0.5 * angle), v.x, v.y, v.z};
}

Mat3 RotationVectorJacobian(const Vec3& v) {
  // Inverse of the right Jacobian of SO(3): I + [v]/2 + c [v]^2.
  const double angle = glm::length(v);
  const double c = angle < 1e-4
                       ? 1.0 / 12.0
                       : 1.0 / (angle * angle) - 1.0 / (2.0 * angle * std::tan(0.5 * angle));
  const Mat3 cross{0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0};  // columns of [v]
  return Mat3{1.0} + 0.5 * cross + c * (cross * cross);
}

}  // namespace ego
