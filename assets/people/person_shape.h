// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "assets/people/field.h"
#include "assets/people/person.h"
#include "core/base/math.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// The materials a person's surface is divided into.
enum class Region : std::uint8_t { kSkin, kShirt, kTrousers, kShoes, kHair };
inline constexpr std::size_t kRegionCount = 5;

/// The skeleton that these measurements give; arm and leg lengths and heights are exact.
Skeleton PersonSkeleton(const PersonParameters& parameters);

/// A person's body as an implicit surface in the T-pose, model space, metres: the smooth union of
/// a trunk of superelliptic sections, limbs of varying radius, head, hands and feet. Symmetric in
/// x = 0.
class PersonShape {
 public:
  explicit PersonShape(const PersonParameters& parameters);

  /// Approximate signed distance to the skin, negative inside.
  double operator()(const Vec3& p_ms) const;
  /// Unit outward direction.
  Vec3 Normal(const Vec3& p_ms) const;
  /// Which material a point of the surface has.
  Region RegionAt(const Vec3& p_ms) const;

  /// The pieces, for points anywhere (mirrored to the left side inside).
  double Trunk(const Vec3& p_ms) const;
  double Arm(const Vec3& p_ms) const;
  double Leg(const Vec3& p_ms) const;
  double Head(const Vec3& p_ms) const;  // without hair and neck
  double Neck(const Vec3& p_ms) const;

  const PersonParameters& parameters() const { return parameters_; }
  const Skeleton& skeleton() const { return skeleton_; }
  const Vec3& Joint(HumanoidJoint joint) const { return joint_[Index(joint)]; }
  double HipHeight() const { return Joint(HumanoidJoint::kLeftUpperLeg).y; }
  /// From the hip joints up to the neck joint.
  double TrunkLength() const { return Joint(HumanoidJoint::kNeck).y - HipHeight(); }
  double NavelHeight() const { return HipHeight() + 0.27 * TrunkLength(); }
  double ChinHeight() const { return parameters_.height - parameters_.head_height; }
  /// Depth of the middle of the head.
  double HeadDepth() const { return head_z_; }
  double HeadCrown() const { return crown_; }

 private:
  double Hair(const Vec3& p) const;
  double Hand(const Vec3& p) const;
  double Foot(const Vec3& p) const;

  PersonParameters parameters_;
  Skeleton skeleton_;
  std::array<Vec3, kJointCount> joint_{};
  double head_z_ = 0.0;
  double crown_ = 0.0;  // of the skull, below the hair
  field::Profile trunk_width_;
  field::Profile trunk_front_;
  field::Profile trunk_back_;
  field::Profile upper_arm_;
  field::Profile lower_arm_;
  field::Profile upper_leg_;
  field::Profile lower_leg_;
};

}  // namespace ego
