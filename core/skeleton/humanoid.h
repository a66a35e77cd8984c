// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/math.h"

namespace ego {

/// The joints every body has, parents before children; the names are those of VRM 1.0. A rig that
/// lacks one gets a zero-length virtual joint in its place (see Skeleton).
enum class HumanoidJoint : std::uint8_t {
  kHips,
  kSpine,
  kChest,
  kUpperChest,
  kNeck,
  kHead,
  kLeftShoulder,  // the clavicle
  kLeftUpperArm,
  kLeftLowerArm,
  kLeftHand,
  kRightShoulder,
  kRightUpperArm,
  kRightLowerArm,
  kRightHand,
  kLeftUpperLeg,
  kLeftLowerLeg,
  kLeftFoot,
  kLeftToes,
  kRightUpperLeg,
  kRightLowerLeg,
  kRightFoot,
  kRightToes,
};

inline constexpr std::size_t kJointCount = 22;

constexpr std::size_t Index(HumanoidJoint joint) { return static_cast<std::size_t>(joint); }

/// Parent of each joint; the hips are their own parent.
inline constexpr std::array<HumanoidJoint, kJointCount> kParent = {
    HumanoidJoint::kHips,          HumanoidJoint::kHips,          HumanoidJoint::kSpine,
    HumanoidJoint::kChest,         HumanoidJoint::kUpperChest,    HumanoidJoint::kNeck,
    HumanoidJoint::kUpperChest,    HumanoidJoint::kLeftShoulder,  HumanoidJoint::kLeftUpperArm,
    HumanoidJoint::kLeftLowerArm,  HumanoidJoint::kUpperChest,    HumanoidJoint::kRightShoulder,
    HumanoidJoint::kRightUpperArm, HumanoidJoint::kRightLowerArm, HumanoidJoint::kHips,
    HumanoidJoint::kLeftUpperLeg,  HumanoidJoint::kLeftLowerLeg,  HumanoidJoint::kLeftFoot,
    HumanoidJoint::kHips,          HumanoidJoint::kRightUpperLeg, HumanoidJoint::kRightLowerLeg,
    HumanoidJoint::kRightFoot,
};

constexpr HumanoidJoint Parent(HumanoidJoint joint) { return kParent[Index(joint)]; }

/// VRM 1.0 bone name ("leftUpperArm").
std::string_view Name(HumanoidJoint joint);
/// The joint of that VRM 1.0 bone name; nothing for fingers, eyes and unknown names.
std::optional<HumanoidJoint> JointNamed(std::string_view vrm_name);
/// The joint on the other side; joints of the middle are their own mirror.
HumanoidJoint Mirror(HumanoidJoint joint);

/// The four limbs, in the order they are stored everywhere.
enum class Limb : std::uint8_t { kLeftArm, kRightArm, kLeftLeg, kRightLeg };
inline constexpr std::size_t kLimbCount = 4;
inline constexpr std::array<Limb, kLimbCount> kLimbs = {Limb::kLeftArm, Limb::kRightArm,
                                                        Limb::kLeftLeg, Limb::kRightLeg};

constexpr std::size_t Index(Limb limb) { return static_cast<std::size_t>(limb); }
constexpr bool IsArm(Limb limb) { return limb == Limb::kLeftArm || limb == Limb::kRightArm; }
constexpr bool IsLeft(Limb limb) { return limb == Limb::kLeftArm || limb == Limb::kLeftLeg; }
constexpr Limb Mirror(Limb limb) { return static_cast<Limb>(static_cast<std::uint8_t>(limb) ^ 1u); }

/// Base (shoulder, hip), mid (elbow, knee) and end joint (wrist, ankle) of a limb, in the paper's
/// words (section 6.2).
struct LimbJoints {
  HumanoidJoint base;
  HumanoidJoint mid;
  HumanoidJoint end;
};
constexpr LimbJoints JointsOf(Limb limb) {
  using J = HumanoidJoint;
  switch (limb) {
    case Limb::kLeftArm:
      return {J::kLeftUpperArm, J::kLeftLowerArm, J::kLeftHand};
    case Limb::kRightArm:
      return {J::kRightUpperArm, J::kRightLowerArm, J::kRightHand};
    case Limb::kLeftLeg:
      return {J::kLeftUpperLeg, J::kLeftLowerLeg, J::kLeftFoot};
    case Limb::kRightLeg:
      break;
  }
  return {J::kRightUpperLeg, J::kRightLowerLeg, J::kRightFoot};
}

/// The eight limb segments, each a capsule: upper and lower of each limb, stored as 2 * limb +
/// part.
enum class LimbSegment : std::uint8_t {
  kLeftUpperArm,
  kLeftForearm,
  kRightUpperArm,
  kRightForearm,
  kLeftThigh,
  kLeftCalf,
  kRightThigh,
  kRightCalf,
};
inline constexpr std::size_t kSegmentCount = 8;
constexpr std::size_t Index(LimbSegment segment) { return static_cast<std::size_t>(segment); }
constexpr Limb LimbOf(LimbSegment segment) {
  return static_cast<Limb>(static_cast<std::uint8_t>(segment) / 2u);
}
constexpr bool IsLower(LimbSegment segment) {
  return (static_cast<std::uint8_t>(segment) & 1u) != 0u;
}
/// Joint at which the segment begins; it carries the segment.
constexpr HumanoidJoint StartJoint(LimbSegment segment) {
  const LimbJoints joints = JointsOf(LimbOf(segment));
  return IsLower(segment) ? joints.mid : joints.base;
}
/// Joint at which the segment ends.
constexpr HumanoidJoint EndJoint(LimbSegment segment) {
  const LimbJoints joints = JointsOf(LimbOf(segment));
  return IsLower(segment) ? joints.end : joints.mid;
}

/// Axis about which the mid joint flexes, in its own canonical frame (right-handed, positive angle
/// = flexion). In the canonical pose (T-pose, palms down) forearms flex forward (+Z) and shins
/// backward (-Z): left elbow -Y, right elbow +Y, knees +X.
constexpr Vec3 FlexionAxis(Limb limb) {
  if (limb == Limb::kLeftArm) return {0.0, -1.0, 0.0};
  if (limb == Limb::kRightArm) return {0.0, 1.0, 0.0};
  return {1.0, 0.0, 0.0};
}

/// The direction of a limb's bones in the canonical pose: arms sideways, legs down.
constexpr Vec3 CanonicalDirection(Limb limb) {
  if (limb == Limb::kLeftArm) return {1.0, 0.0, 0.0};
  if (limb == Limb::kRightArm) return {-1.0, 0.0, 0.0};
  return {0.0, -1.0, 0.0};
}

}  // namespace ego
