// SPDX-License-Identifier: MIT
#include "core/adapt/arm_solve.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"

namespace ego {
namespace {

constexpr double kArmDamping = 2.0;    // weight of a point at the arm's length
constexpr double kElbowDamping = 4.0;  // likewise; nearly straight arms flex fast
constexpr double kHandDamping = 2.0;   // likewise at the hand's length
constexpr double kArmStep = 0.15;      // radians a step can hardly exceed
constexpr double kHandStep = 0.30;

}  // namespace

ArmSolve::Lever::Lever(const AdaptState& state, Limb arm)
    : chain(&state.chain[Index(arm)]),
      posture(state.limb[Index(arm)]),
      placed(Place(*chain, posture)),
      axis_ls(MeasureFlexion(*chain, posture.mid).axis_ls),
      hinge(placed.base_ws * axis_ls),
      hand_ws(state.extremity_ws[Index(arm)]),
      hand_can_turn(!state.avatar.skeleton.locked[Index(JointsOf(arm).end)]),
      hand_length(std::max(0.05 * state.scale,
                           state.constants.bone_length[HandBone(FingertipPoint(arm))])) {}

ArmSolve::Gradient ArmSolve::Lever::Along(Part part, const Vec3& point,
                                          const Vec3& direction) const {
  Gradient gradient{};
  // The hand keeps its direction in the world while the arm moves.
  const Vec3& carried = part == Part::kHand ? placed.end : point;
  if (!chain->base_locked) {
    const Vec3 turn = glm::cross(carried - chain->base_ws, direction);
    gradient[0] = turn.x;
    gradient[1] = turn.y;
    gradient[2] = turn.z;
  }
  if (part != Part::kUpperArm && !chain->mid_locked) {
    gradient[3] = glm::dot(hinge, glm::cross(carried - placed.mid, direction));
  }
  if (part == Part::kHand && hand_can_turn) {
    const Vec3 turn = glm::cross(point - placed.end, direction);
    gradient[4] = turn.x;
    gradient[5] = turn.y;
    gradient[6] = turn.z;
  }
  return gradient;
}

ArmSolve::ArmSolve(const AdaptState& state)
    : lever_{Lever(state, Limb::kLeftArm), Lever(state, Limb::kRightArm)} {
  for (std::size_t a = 0; a < lever_.size(); ++a) {
    const double reach = lever_[a].chain->Reach();
    const double hand = lever_[a].hand_length;
    for (std::size_t k = 0; k < 3; ++k) {
      own_[a].Damp(k, kArmDamping * reach * reach + 1e-12);
      own_[a].Damp(4 + k, kHandDamping * hand * hand);
    }
    own_[a].Damp(3, kElbowDamping * reach * reach + 1e-12);
  }
}

void ArmSolve::Ask(const Point& point, const Vec3& direction, double value, double weight) {
  const std::size_t a = Index(point.arm);
  own_[a].Add(lever_[a].Along(point.part, point.at_ws, direction), value, weight);
  empty_ = false;
}

void ArmSolve::AskApart(const Point& point, const Point& other, const Vec3& direction, double value,
                        double weight) {
  const std::size_t a = Index(point.arm);
  const std::size_t b = Index(other.arm);
  const Gradient own = lever_[a].Along(point.part, point.at_ws, direction);
  const Gradient away = lever_[b].Along(other.part, other.at_ws, -direction);
  own_[a].Add(own, value, weight);
  own_[b].Add(away, value, weight);
  const Gradient& left = a == 0 ? own : away;
  const Gradient& right = a == 0 ? away : own;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t j = 0; j < kUnknowns; ++j) cross_[i][j] += weight * left[i] * right[j];
  }
  coupled_ = true;
  empty_ = false;
}

void ArmSolve::HoldWrist(Limb arm, double weight) {
  const Lever& lever = lever_[Index(arm)];
  for (int k = 0; k < 3; ++k) {
    Vec3 axis{0.0};
    axis[k] = 1.0;
    own_[Index(arm)].Add(lever.Along(Part::kForearm, lever.placed.end, axis), 0.0, weight);
  }
}

ArmSolve::Move ArmSolve::Moved(const Lever& lever, const double* x) const {
  const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
  const double shrink = 1.0 / std::sqrt(1.0 + square / (kArmStep * kArmStep));
  const Quat turn = FromRotationVector(shrink * Vec3{x[0], x[1], x[2]});
  Vec3 hand{x[4], x[5], x[6]};
  hand /= std::sqrt(1.0 + glm::dot(hand, hand) / (kHandStep * kHandStep));
  Move move;
  move.posture.base =
      glm::normalize(glm::conjugate(lever.chain->frame_ws) * turn * lever.placed.base_ws);
  move.posture.mid =
      glm::normalize(FromRotationVector(shrink * x[3] * lever.axis_ls) * lever.posture.mid);
  move.hand_ws = glm::normalize(FromRotationVector(hand) * lever.hand_ws);
  return move;
}

std::array<ArmSolve::Move, 2> ArmSolve::Solve() const {
  if (!coupled_) {
    return {Moved(lever_[0], own_[0].Solve().data()), Moved(lever_[1], own_[1].Solve().data())};
  }
  NormalEquations<2 * kUnknowns> both;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t j = 0; j < kUnknowns; ++j) {
      both.matrix[i][j] = own_[0].matrix[i][j];
      both.matrix[kUnknowns + i][kUnknowns + j] = own_[1].matrix[i][j];
      both.matrix[kUnknowns + i][j] = cross_[j][i];
    }
    both.right[i] = own_[0].right[i];
    both.right[kUnknowns + i] = own_[1].right[i];
  }
  const std::array<double, 2 * kUnknowns> x = both.Solve();
  return {Moved(lever_[0], x.data()), Moved(lever_[1], x.data() + kUnknowns)};
}

}  // namespace ego
