// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "assets/motions/motion_figure.h"
#include "assets/motions/motion_script.h"
#include "assets/motions/posture_solver.h"
#include "core/skeleton/pose.h"

namespace ego {

/// By what a hand's goal is changed so that the arm keeps out of the body, degrees: the elbow about
/// the line from shoulder to wrist; a hand that touches about the point that touches, which stays
/// where it is.
struct GoalTurn {
  double elbow = 0.0;
  double tilt = 0.0;
  double lean = 0.0;
  double spin = 0.0;  // about the skin's normal

  friend bool operator==(const GoalTurn&, const GoalTurn&) = default;
};

/// Finds the smallest turn of one arm's goal with which it is out of the body at some instants.
class GoalClearing {
 public:
  /// `absent`: an arm that is not placed yet and in nobody's way.
  GoalClearing(const MotionFigure& figure, const PostureSolver& solver, std::size_t side,
               std::optional<Limb> absent)
      : figure_(figure), solver_(solver), side_(side), absent_(absent) {}

  /// Adds an instant: everything of `pose` but this arm is in place; the turn acts by this share.
  void Look(const EndGoal& goal, const SkinPoint& skin, const Pose& pose, double share);

  /// The turn; all zero where nothing is to be done.
  GoalTurn Find() const;

  /// A goal with a share of a turn.
  static EndGoal Turned(const EndGoal& goal, const GoalTurn& turn, double share, std::size_t side,
                        const SkinPoint& skin, const Vec3& shoulder_to_wrist_ls);
  /// From shoulder to wrist, frame of the upper chest, unit.
  static Vec3 ArmAxis(const ArmTarget& target, std::size_t side, const ModelPose& model);

 private:
  struct Instant {
    EndGoal goal;
    SkinPoint skin;
    Pose pose;
    ModelPose model;
    Vec3 axis;
    double share;
    std::optional<Limb> touched;
    double touched_before;  // how deep what is touched lies elsewhere, as RigidSkin::Depth::Cost
  };
  /// Metres: how deep skin lies where deeper than `enough`, strain, and the price of the turn.
  double CostOf(const GoalTurn& turn, double enough) const;
  GoalTurn SearchFrom(GoalTurn best, double& best_cost) const;

  const MotionFigure& figure_;
  const PostureSolver& solver_;
  std::size_t side_;
  std::optional<Limb> absent_;
  std::vector<Instant> instants_;
};

}  // namespace ego
