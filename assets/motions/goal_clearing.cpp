// SPDX-License-Identifier: MIT
#include "assets/motions/goal_clearing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/motions/skin_measure.h"

namespace ego {
namespace {

using J = HumanoidJoint;

// Skin on skin: what lies less deep than this is left, metres. A search goes on below it, so that
// a body that is a little thicker is clear, too.
constexpr double kEnough = 0.0045;
constexpr double kGoal = 0.0015;
// Degrees by which a wrist bends and a forearm turns without strain; metres that a degree more
// counts for.
constexpr double kEasyWrist = 75.0;
constexpr double kEasyTwist = 100.0;
constexpr double kStrain = 0.0004;

constexpr std::array<double GoalTurn::*, 4> kTurns = {&GoalTurn::elbow, &GoalTurn::tilt,
                                                      &GoalTurn::lean, &GoalTurn::spin};
constexpr std::array<double, 4> kMost = {80.0, 30.0, 35.0, 50.0};   // degrees
constexpr std::array<double, 4> kPrice = {5e-5, 1e-4, 1e-4, 8e-5};  // metres a degree

constexpr std::array<GoalTurn, 8> kStarts = {{{0, 16, 0, 0},
                                              {0, -16, 0, 0},
                                              {0, 0, 18, 0},
                                              {0, 0, -18, 0},
                                              {40, 0, 0, 25},
                                              {40, 0, 0, -25},
                                              {-40, 0, 0, 25},
                                              {-40, 0, 0, -25}}};

Vec3 Sided(const Vec3& v, std::size_t side) { return side == 0 ? v : Vec3{-v.x, v.y, v.z}; }
Limb ArmOf(std::size_t side) { return side == 0 ? Limb::kLeftArm : Limb::kRightArm; }
J ShoulderOf(std::size_t side) { return side == 0 ? J::kLeftUpperArm : J::kRightUpperArm; }

double PriceOf(const GoalTurn& turn) {
  double price = 0.0;
  for (std::size_t i = 0; i < kTurns.size(); ++i) price += kPrice[i] * std::abs(turn.*kTurns[i]);
  return price;
}

}  // namespace

Vec3 GoalClearing::ArmAxis(const ArmTarget& target, std::size_t side, const ModelPose& model) {
  return glm::conjugate(model.Rotation(J::kUpperChest)) *
         glm::normalize(target.wrist - model.Position(ShoulderOf(side)));
}

EndGoal GoalClearing::Turned(const EndGoal& goal, const GoalTurn& turn, double share,
                             std::size_t side, const SkinPoint& skin,
                             const Vec3& shoulder_to_wrist_ls) {
  EndGoal turned = goal;
  const auto about = [&](double degrees, const Vec3& axis, const Vec3& v) {
    return Sided(glm::angleAxis(Radians(share * degrees), axis) * Sided(v, side), side);
  };
  if (turn.elbow != 0.0) turned.pole = about(turn.elbow, shoulder_to_wrist_ls, goal.pole);
  if (turn.spin != 0.0) turned.pointing = about(turn.spin, skin.normal_ms, goal.pointing);
  turned.tilt += share * turn.tilt;
  turned.lean += share * turn.lean;
  return turned;
}

void GoalClearing::Look(const EndGoal& goal, const SkinPoint& skin, const Pose& pose,
                        double share) {
  Instant instant{goal, skin,  pose, ForwardKinematics(figure_.body().skeleton, pose),
                  {},   share, {},   0.0};
  instant.axis = ArmAxis(solver_.TargetOf(goal, skin, side_, instant.model), side_, instant.model);
  if (goal.touches) instant.touched = LimbOf(MotionFigure::JointOf(goal.place, side_));
  if (instant.touched == ArmOf(side_)) instant.touched.reset();
  if (instant.touched && !absent_) {
    instant.touched_before = figure_.rigid_skin().Of(*instant.touched, pose, ArmOf(side_)).Cost();
  }
  instants_.push_back(std::move(instant));
}

double GoalClearing::CostOf(const GoalTurn& turn, double enough) const {
  const Skeleton& skeleton = figure_.body().skeleton;
  const double arm = BoneLength(skeleton, J::kLeftLowerArm) + BoneLength(skeleton, J::kLeftHand);
  double worst = 0.0;
  for (const Instant& now : instants_) {
    const EndGoal goal = Turned(now.goal, turn, now.share, side_, now.skin, now.axis);
    const ArmTarget target = solver_.TargetOf(goal, now.skin, side_, now.model);
    Pose pose = now.pose;
    solver_.PlaceArm(side_, target, now.model, pose);
    const RigidSkin::Depth depth = figure_.rigid_skin().Of(ArmOf(side_), pose, absent_);
    double cost = depth.deepest > enough ? depth.Cost() : 0.0;
    // What is touched may lie in what touches it.
    if (now.touched) {
      const RigidSkin::Depth other = figure_.rigid_skin().Of(*now.touched, pose, absent_);
      if (other.deepest > enough) cost += std::max(0.0, other.Cost() - now.touched_before);
    }
    const double wrist = Degrees(2.0 * std::acos(std::min(1.0, std::abs(target.swing.w))));
    if (cost > 0.0 || !(turn == GoalTurn{})) {
      cost += kStrain * (std::max(0.0, wrist - kEasyWrist) +
                         std::max(0.0, std::abs(Degrees(target.twist)) - kEasyTwist));
    }
    const Vec3& shoulder = now.model.Position(ShoulderOf(side_));
    cost += 2.0 * std::max(0.0, glm::distance(target.wrist, shoulder) - 0.998 * arm);
    worst = std::max(worst, cost);
  }
  return worst + PriceOf(turn);
}

GoalTurn GoalClearing::SearchFrom(GoalTurn best, double& best_cost) const {
  constexpr int kRounds = 3;
  const std::size_t ways = instants_.front().goal.touches ? 4 : 1;
  best_cost = CostOf(best, kGoal);
  for (const double step : {0.35, 0.15, 0.06}) {
    bool better = true;
    for (int round = 0; round < kRounds && better; ++round) {
      better = false;
      for (std::size_t w = 0; w < ways; ++w) {
        for (const double way : {step, -step}) {
          GoalTurn trial = best;
          double& angle = trial.*kTurns[w];
          angle = std::clamp(angle + way * kMost[w], -kMost[w], kMost[w]);
          const double cost = CostOf(trial, kGoal);
          if (cost > best_cost - 1e-4) continue;
          best = trial;
          best_cost = cost;
          if (cost - PriceOf(best) <= 0.0) return best;  // clear
          better = true;
          break;
        }
      }
    }
  }
  return best;
}

GoalTurn GoalClearing::Find() const {
  if (instants_.empty() || CostOf({}, kEnough) == 0.0) return {};
  double cost = 0.0;
  const GoalTurn best = SearchFrom({}, cost);
  if (!instants_.front().goal.touches || CostOf(best, kEnough) - PriceOf(best) < kEnough) {
    return best;
  }
  // From the most promising other side.
  const auto start = std::min_element(
      kStarts.begin(), kStarts.end(),
      [&](const GoalTurn& a, const GoalTurn& b) { return CostOf(a, kGoal) < CostOf(b, kGoal); });
  double other_cost = 0.0;
  const GoalTurn other = SearchFrom(*start, other_cost);
  return other_cost < cost ? other : best;
}

}  // namespace ego
