// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "assets/people/person.h"
#include "assets/people/person_body.h"
#include "assets/people/person_skin.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Where a hand is and how it is turned. Directions and free positions are written for a left hand
/// (x outward); for a right hand they are reflected.
struct HandGoal {
  /// Free: the palm is at `position`, metres from the shoulder joint, in the frame of the upper
  /// chest, its normal along `palm`. Touch: the palm lies on `skin`, facing it.
  bool touches = false;
  SkinPoint skin;
  Vec3 position{0.0};
  Vec3 palm{-1.0, 0.0, 0.0};
  /// Direction of the fingers: in the frame of the chest, or carried along with the skin.
  Vec3 fingers{0.0, -1.0, 0.0};
  /// Where the elbow points, seen from the line between shoulder and wrist, frame of the chest.
  Vec3 elbow{0.3, -0.2, -1.0};
  double lift = 0.0;         // metres off the skin
  double tilt = 0.0;         // degrees by which the fingers leave the skin
  bool fingertip = false;    // the fingertip is placed instead of the palm
  bool after_other = false;  // touches the other arm, which is therefore placed first
};

/// Angles are degrees: pitch bends forward, yaw turns to the left, roll leans to the right.
struct Bend {
  double pitch = 0.0;
  double yaw = 0.0;
  double roll = 0.0;
};

/// A foot relative to where it stands: moved, and its heel raised.
struct FootGoal {
  Vec3 offset{0.0};
  double heel_up = 0.0;  // degrees about the toes
};

/// Goals for a whole body: a key of a scripted motion.
struct Posture {
  Vec3 root{0.0, -0.005, 0.0};  // metres from the standing place
  Bend pelvis;
  Bend spine;                     // shared by spine, chest and upper chest
  Bend head;                      // shared by neck and head
  std::array<double, 2> shrug{};  // degrees by which the clavicles are raised; left, right
  std::array<HandGoal, 2> hand;
  std::array<FootGoal, 2> foot;
};

/// Turns goals into poses of one person: legs and arms by two-bone inverse kinematics, elbows and
/// knees hinged, half of the hand's turn about the forearm given to the forearm.
class PostureSolver {
 public:
  explicit PostureSolver(const Body& body);

  /// The pose between two postures, 0 <= share <= 1. A hand that has the same goal in both keeps it
  /// exactly; otherwise it moves on an arc around the body.
  Pose Solve(const Posture& from, const Posture& to, double share) const;

  /// Where a point of the skin is, and its normal.
  SkinPoint Posed(const SkinPoint& skin, const ModelPose& pose) const;

 private:
  struct ArmGoal {
    Vec3 wrist;          // world
    Vec3 elbow;          // world, where it points
    double twist = 0.0;  // of the hand about the forearm, radians
    Quat swing = kIdentity;
    Vec3 away{0.0};  // world, unit: off the skin that is touched
  };
  ArmGoal GoalOf(const HandGoal& goal, std::size_t side, const ModelPose& pose) const;
  struct ArmFrames {
    Quat upper;  // world; lower without the forearm's twist
    Quat lower;
  };
  ArmFrames FramesOf(std::size_t side, const Vec3& wrist, const Vec3& elbow,
                     const ModelPose& pose) const;
  void PlaceLeg(std::size_t side, const FootGoal& goal, Pose& pose) const;
  void PlaceArm(std::size_t side, const ArmGoal& goal, const ModelPose& model, Pose& pose) const;

  const Body& body_;
  std::array<Vec3, kJointCount> canonical_;
};

/// The surface of a finished character, for placing touches and markers.
FigureSurface SurfaceOf(const Character& character);

}  // namespace ego
