// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "assets/motions/goal_clearing.h"
#include "assets/motions/motion_figure.h"
#include "assets/motions/motion_script.h"
#include "assets/motions/posture_solver.h"
#include "assets/motions/true_contact.h"
#include "core/skeleton/pose.h"

namespace ego {

/// One figure doing one script: the pose at any instant, contacts held on the figure's own skin.
/// Between keys every channel moves on a quintic that is smooth in its second derivative; head,
/// spine and hips go a little before the hands; the performer breathes and sways.
///
/// Arms keep out of this figure's body: at keys the elbow turns aside about the line from shoulder
/// to wrist, a hand that touches turns about the point where it touches, and fingers are laid on
/// the skin; between keys hands swerve around what is in their way. Contacts stay where they are.
class MotionPlayer {
 public:
  /// Keeps references to both.
  MotionPlayer(const MotionFigure& figure, const MotionScript& script);

  /// 0 <= time <= the script's duration.
  Pose At(double time) const;

  /// In order of time.
  const std::vector<TrueContact>& contacts() const { return contacts_; }

 private:
  struct Key {
    double time = 0.0;
    BodyGoals posture;
    Vec3 root_ws{0.0};
    std::array<SkinPoint, 2> hand_skin;
    std::array<SkinPoint, 2> foot_skin;
    std::array<HandShape, 2> fingers{};
    /// By how much a hand swerves on its way here, and the elbow's direction with it: frame of
    /// the upper chest.
    std::array<Vec3, 2> swerve{};
    std::array<Vec3, 2> elbow_swerve{};
    /// How a hand that slides here is turned on its way.
    std::array<GoalTurn, 2> slide_turn{};
  };
  /// Four keys around an instant; equal neighbours where a channel comes to rest.
  struct Span {
    std::array<const Key*, 4> key;
    double time = 0.0;
  };
  Span SpanAt(double time) const;
  BodyGoals BodyAt(double time, Vec3& root_ws) const;
  LegTarget LegAt(const Span& span, std::size_t side, const ModelPose& model) const;
  ArmTarget ArmAt(const Span& span, std::size_t side, const ModelPose& model) const;
  /// The goal of a hand that slides, before its turn.
  EndGoal SlidingGoal(const Span& span, std::size_t side) const;
  HandShape FingersAt(const Span& span, std::size_t side) const;
  Pose BodyPose(const BodyGoals& body, const Vec3& root_ws) const;

  static bool SamePart(const EndGoal& a, const EndGoal& b);
  /// How much of a swerve is taken at a share of the way: all of it but near both ends.
  static double Swerving(double share);

  // motion_clearing.cpp
  /// Which of two limbs touches the other and so is placed after it.
  static std::size_t LastPlaced(const Span& span, bool foot) {
    return TouchesPartner(span, foot, 0) ? 0 : 1;
  }
  static bool TouchesPartner(const Span& span, bool foot, std::size_t side);
  void PlaceLegs(const Span& span, Pose& pose) const;
  Span SpanOf(const Key& key) const { return {{&key, &key, &key, &key}, key.time}; }
  /// Trunk, head and legs of a key; with the arm of a side, too.
  Pose KeyPose(const Key& key, std::optional<std::size_t> arm) const;
  void ClearKeys();
  void ClearGoal(std::span<Key> hold, std::size_t side, std::optional<std::size_t> other);
  void LayFingers(std::span<Key> hold, std::size_t side, std::optional<std::size_t> other);
  void ClearSlide(std::size_t to, std::size_t side);
  void ClearWays();
  void ClearWay(std::size_t to, std::size_t side, bool last);

  void FindContacts();

  const MotionFigure& figure_;
  const MotionScript& script_;
  PostureSolver solver_;
  std::vector<Key> keys_;
  std::vector<TrueContact> contacts_;
};

}  // namespace ego
