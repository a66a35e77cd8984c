// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "assets/motions/motion_script.h"
#include "assets/motions/rigid_skin.h"
#include "assets/people/person.h"
#include "assets/people/person_body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// The surface of a finished character, for placing touches.
FigureSurface SurfaceOf(const Character& character);

/// A person prepared for motion scripts: where the places that scripts name are on this body.
class MotionFigure {
 public:
  /// Keeps a reference: the person must outlive the figure.
  explicit MotionFigure(const Person& person);

  const Person& person() const { return person_; }
  const Body& body() const { return person_.body; }
  const std::array<Vec3, kJointCount>& canonical() const { return canonical_; }

  /// The skin at a place that a goal of this side names.
  SkinPoint At(const BodyPlace& place, std::size_t side) const;
  /// The joint that a place is counted to: kChest for all of the trunk, kHead, or the limb
  /// segment's start joint.
  static HumanoidJoint JointOf(const BodyPlace& place, std::size_t side);

  /// Where a posed point of the skin is, and its normal.
  SkinPoint Posed(const SkinPoint& skin, const ModelPose& pose) const;

  /// The middle of a face of a hand or foot, on the skin, and the way it faces: canonical pose.
  struct FacePoint {
    Vec3 position_ms{0.0};
    Vec3 normal_ms{0.0};
  };
  const FacePoint& FaceOf(TouchFace face, std::size_t side) const {
    return faces_[side][static_cast<std::size_t>(face)];
  }

  /// The height of the hips joint above the lowest skin of the seat when the hips are turned so.
  double SeatHeight(const Quat& hips) const;
  /// The height of the ankle above the lowest skin of foot and toes when they are turned so, the
  /// toes bent relative to the foot.
  double AnkleHeight(std::size_t side, const Quat& foot, const Quat& toes) const;

  /// Of the whole character, for keeping limbs out of it.
  const RigidSkin& rigid_skin() const { return rigid_skin_; }

  /// Lengths of this body relative to the one scripts are written for.
  double leg_scale() const { return leg_scale_; }
  double arm_scale() const { return arm_scale_; }

 private:
  struct Ray {
    Vec3 origin;
    Vec3 direction;
  };
  SkinPoint SampleSkin(SamplePoint sample) const;
  Ray RayTo(const BodyPlace& place, std::size_t side) const;

  const Person& person_;
  FigureSurface surface_;
  RigidSkin rigid_skin_;
  std::array<Vec3, kJointCount> canonical_;
  std::array<std::array<FacePoint, 7>, 2> faces_;
  std::vector<Vec3> seat_;                      // relative to the hips joint
  std::array<std::vector<Vec3>, 2> foot_skin_;  // relative to the ankle
  std::array<std::vector<Vec3>, 2> toe_skin_;   // relative to the toes joint
  double leg_scale_ = 1.0;
  double arm_scale_ = 1.0;
};

}  // namespace ego
