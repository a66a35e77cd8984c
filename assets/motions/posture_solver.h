// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "assets/motions/motion_figure.h"
#include "assets/motions/motion_script.h"
#include "core/skeleton/pose.h"

namespace ego {

/// An arm's goal on a body whose trunk is in place: what moves smoothly from one goal to the next.
struct ArmTarget {
  Vec3 wrist{0.0};         // world
  Vec3 elbow{0.0};         // where it points: world, unit
  double twist = 0.0;      // of the hand about the forearm, radians
  Quat swing = kIdentity;  // of the hand from the twisted forearm
  Vec3 away{0.0};          // world: unit normal of the skin that is touched, zero for free goals
};

/// A leg's goal on a body whose hips are in place.
struct LegTarget {
  Vec3 ankle{0.0};        // world
  Vec3 knee{0.0};         // where it points: world, unit
  Quat foot = kIdentity;  // world
  Quat toes = kIdentity;  // relative to the foot
};

/// Turns goals into joint rotations of one figure: two-bone inverse kinematics, elbows and knees
/// hinged, half of the hand's turn about the forearm given to the forearm.
class PostureSolver {
 public:
  explicit PostureSolver(const MotionFigure& figure) : figure_(figure) {}

  /// The goal on a posed body. A touch needs the touched part in place already. `skin`: the place
  /// that is touched.
  ArmTarget TargetOf(const EndGoal& goal, const SkinPoint& skin, std::size_t side,
                     const ModelPose& model) const;
  LegTarget FootOnSkin(const EndGoal& goal, const SkinPoint& skin, std::size_t side,
                       const ModelPose& model) const;
  /// A free foot, relative to where it stands.
  LegTarget FreeFoot(const EndGoal& goal, std::size_t side) const;

  /// Where the elbow is when the wrist is there and the elbow points so, world.
  Vec3 ElbowOf(std::size_t side, const Vec3& wrist, const Vec3& elbow,
               const ModelPose& model) const;

  void PlaceArm(std::size_t side, const ArmTarget& target, const ModelPose& model,
                Pose& pose) const;
  void PlaceLeg(std::size_t side, const LegTarget& target, const ModelPose& model,
                Pose& pose) const;

 private:
  /// A free hand's wrist, drawn in so that the elbow never straightens abruptly.
  Vec3 WithinReach(const Vec3& from_shoulder) const;
  struct ArmFrames {
    Quat upper;  // world
    Quat lower;  // world, without the forearm's twist
  };
  ArmFrames FramesOf(std::size_t side, const Vec3& wrist, const Vec3& elbow,
                     const ModelPose& model) const;
  /// The rotation that lays a face on the skin, fingers or toes along `pointing`.
  Quat LaidOn(const EndGoal& goal, const SkinPoint& posed, const SkinPoint& skin, std::size_t side,
              const Vec3& canonical_pointing, const ModelPose& model) const;

  const MotionFigure& figure_;
};

/// Shares of a bend as a joint rotation.
Quat RotationOf(const Bend& bend, double share);

}  // namespace ego
