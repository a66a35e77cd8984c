// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/adapt/adapt_settings.h"
#include "core/adapt/body_sum.h"
#include "core/adapt/joint_target.h"
#include "core/adapt/limb_ik.h"
#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// An avatar's posture while it is adapted: what the steps of Algorithm 1 hand on. Lives for one
/// call of `Adapt` and refers to its inputs.
struct AdaptState {
  AdaptState(const Body& avatar, const EgocentricPose& egocentric, const AdaptSettings& settings);

  const Body& avatar;
  const EgocentricPose& egocentric;
  const AdaptSettings& settings;
  const BodyConstants constants;
  const double scale;  // height over 1.78 m, for the settings' lengths
  Pose pose;
  PosedBody posed;
  std::array<LimbChain, kLimbCount> chain;
  std::array<LimbPosture, kLimbCount> limb;
  std::array<BodySum, kPointGroupCount> body_sum;  // by kPointGroups
  /// Length of every displacement from a capsule on this body (equation 5 reversed): the six of
  /// the other limbs by slot, then the other hand.
  std::array<std::array<double, kOtherCapsuleCount>, kLimbPointCount> capsule_reach{};
  /// Equation 2 of every limb's mid and end joint.
  std::array<std::array<JointTarget, 2>, kLimbCount> joint_target;
  /// Where the middle of each sole is from the root's ground point in standing (`StandingPlace`).
  std::array<Vec2, 2> standing_place{};
  /// Equation 3: what trunk and head ask of the normals of hands and feet.
  std::array<Vec3, kLimbCount> normal_sum{};
  /// World rotations that hands and feet are to end with.
  std::array<Quat, kLimbCount> extremity_ws;
  std::array<double, kLimbCount> gamma{};

  /// Chains and limb postures from `pose`, whose forward kinematics is in `posed`.
  void ReadLimbs();
  /// Moves everything that is placed.
  void MoveRoot(const Vec3& by);
  /// Takes a posture for a limb and places its joints, capsules, hand.
  void Apply(Limb limb, const LimbPosture& posture);
  /// Takes a world rotation for a hand or foot; the limb stays.
  void TurnExtremity(Limb limb, const Quat& rotation_ws);
};

}  // namespace ego
