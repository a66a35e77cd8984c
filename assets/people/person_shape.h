// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "assets/people/field.h"
#include "assets/people/person.h"
#include "assets/people/person_head.h"
#include "assets/people/region.h"
#include "core/base/math.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// The skeleton that these measurements give; arm and leg lengths and heights are exact.
Skeleton PersonSkeleton(const PersonParameters& parameters);

/// A person's body as an implicit surface in the T-pose, model space, metres: the smooth union of
/// a trunk of superelliptic sections, limbs of varying radius, head, hands and feet. Symmetric in
/// x = 0.
class PersonShape {
 public:
  explicit PersonShape(const PersonParameters& parameters);

  /// Approximate signed distance to the skin, negative inside.
  double operator()(const Vec3& p_ms) const { return Distance(p_ms, 0.0); }
  /// The same with lean fingers and plain ears, which a coarse lattice tells apart and catches.
  double Coarse(const Vec3& p_ms) const { return Distance(p_ms, 0.008); }
  /// Unit outward direction.
  Vec3 Normal(const Vec3& p_ms) const;
  /// Which material a point of the surface has.
  Region RegionAt(const Vec3& p_ms) const;

  /// The pieces, for points anywhere (mirrored to the left side inside).
  double Trunk(const Vec3& p_ms) const;
  double Arm(const Vec3& p_ms) const { return ArmWith(p_ms, 0.0); }
  double Leg(const Vec3& p_ms) const;
  double Head(const Vec3& p_ms) const { return head_.Skin(p_ms); }  // without hair and neck
  double Neck(const Vec3& p_ms) const;

  /// How long an edge of the mesh may be at a place, so that what is small there shows.
  double LongestEdge(const Vec3& p_ms) const;

  const PersonHead& head() const { return head_; }
  const PersonParameters& parameters() const { return parameters_; }
  const Skeleton& skeleton() const { return skeleton_; }
  const Vec3& Joint(HumanoidJoint joint) const { return joint_[Index(joint)]; }
  double HipHeight() const { return Joint(HumanoidJoint::kLeftUpperLeg).y; }
  /// From the hip joints up to the neck joint.
  double TrunkLength() const { return Joint(HumanoidJoint::kNeck).y - HipHeight(); }
  double NavelHeight() const { return HipHeight() + 0.27 * TrunkLength(); }
  double ChinHeight() const { return parameters_.height - parameters_.head_height; }
  /// How far out the sleeves end, and how broad the trim of sleeves and collar is.
  double CuffReach() const;
  double TrimWidth() const;
  /// Depth of the middle of the head.
  double HeadDepth() const { return head_.middle_z(); }

 private:
  double Distance(const Vec3& p, double leaner) const;
  double ArmWith(const Vec3& p, double leaner) const;
  double Hand(const Vec3& p, double leaner) const;
  double Foot(const Vec3& p) const;
  Region LegRegion(const Vec3& p, double arm, double trunk, double leg) const;

  PersonParameters parameters_;
  Skeleton skeleton_;
  std::array<Vec3, kJointCount> joint_{};
  PersonHead head_;
  field::Profile trunk_width_;
  field::Profile trunk_front_;
  field::Profile trunk_back_;
  field::Profile upper_arm_;
  field::Profile lower_arm_;
  field::Profile upper_leg_;
  field::Profile lower_leg_;
};

}  // namespace ego
