// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/skeleton/humanoid.h"

namespace ego {

/// The points that have egocentric coordinates: mid and end joint of each limb (section 5.1), then
/// palm and fingertip of each hand (section 8 names them as the way to contact at finger level).
enum class LimbPoint : std::uint8_t {
  kLeftElbow,
  kLeftWrist,
  kRightElbow,
  kRightWrist,
  kLeftKnee,
  kLeftAnkle,
  kRightKnee,
  kRightAnkle,
  kLeftPalm,
  kLeftFingertip,
  kRightPalm,
  kRightFingertip,
};
inline constexpr std::size_t kLimbJointCount = 8;
inline constexpr std::size_t kLimbPointCount = 12;

constexpr std::size_t Index(LimbPoint point) { return static_cast<std::size_t>(point); }
constexpr LimbPoint MidPoint(Limb limb) { return static_cast<LimbPoint>(2 * Index(limb)); }
constexpr LimbPoint EndPoint(Limb limb) { return static_cast<LimbPoint>(2 * Index(limb) + 1); }
/// Palm and fingertip of the hand of an arm.
constexpr LimbPoint PalmPoint(Limb arm) { return static_cast<LimbPoint>(8 + 2 * Index(arm)); }
constexpr LimbPoint FingertipPoint(Limb arm) { return static_cast<LimbPoint>(9 + 2 * Index(arm)); }
constexpr bool IsHandPoint(LimbPoint point) { return Index(point) >= kLimbJointCount; }
constexpr Limb LimbOf(LimbPoint point) {
  return static_cast<Limb>((Index(point) - (IsHandPoint(point) ? kLimbJointCount : 0)) / 2);
}
/// The joint that the point is, or that carries it.
constexpr HumanoidJoint JointOf(LimbPoint point) {
  const LimbJoints joints = JointsOf(LimbOf(point));
  return IsHandPoint(point) || Index(point) % 2 == 1 ? joints.end : joints.mid;
}

/// The points in fours that are treated side by side: their paths from anywhere run along the same
/// bones, or mirrored ones. Each arm's, then both legs'.
inline constexpr std::size_t kPointGroupSize = 4;
inline constexpr std::size_t kPointGroupCount = kLimbPointCount / kPointGroupSize;
using PointGroup = std::array<LimbPoint, kPointGroupSize>;
inline constexpr std::array<PointGroup, kPointGroupCount> kPointGroups = {
    {{LimbPoint::kLeftElbow, LimbPoint::kLeftWrist, LimbPoint::kLeftPalm,
      LimbPoint::kLeftFingertip},
     {LimbPoint::kRightElbow, LimbPoint::kRightWrist, LimbPoint::kRightPalm,
      LimbPoint::kRightFingertip},
     {LimbPoint::kLeftKnee, LimbPoint::kRightKnee, LimbPoint::kLeftAnkle, LimbPoint::kRightAnkle}}};
/// The limbs of a group's points take turns: its even ones are one's, its odd ones another's.
constexpr std::array<Limb, 2> LimbsOf(std::size_t group) {
  return {LimbOf(kPointGroups[group][0]), LimbOf(kPointGroups[group][1])};
}
static_assert(LimbOf(kPointGroups[0][2]) == LimbsOf(0)[0] &&
              LimbOf(kPointGroups[1][2]) == LimbsOf(1)[0] &&
              LimbOf(kPointGroups[2][2]) == LimbsOf(2)[0] &&
              LimbOf(kPointGroups[0][3]) == LimbsOf(0)[1] &&
              LimbOf(kPointGroups[1][3]) == LimbsOf(1)[1] &&
              LimbOf(kPointGroups[2][3]) == LimbsOf(2)[1]);
/// Where a point is in its group.
constexpr std::size_t GroupOf(LimbPoint point) {
  return IsArm(LimbOf(point)) ? Index(LimbOf(point)) : 2;
}
constexpr std::size_t LaneOf(LimbPoint point) {
  std::size_t lane = 0;
  while (kPointGroups[GroupOf(point)][lane] != point) ++lane;
  return lane;
}

/// The six capsules of the other limbs, in an order that mirroring the body keeps: upper and lower
/// of the partner, of the other limb on this side, of the other limb on the other side.
inline constexpr std::size_t kOtherSegmentCount = 6;
constexpr LimbSegment OtherSegment(Limb limb, std::size_t slot) {
  return static_cast<LimbSegment>(2 * (Index(limb) ^ (slot / 2 + 1)) + slot % 2);
}
/// The slot at which `of` is found among the other segments of `limb`; they must be of two limbs.
constexpr std::size_t SlotOf(Limb limb, LimbSegment of) {
  const std::size_t difference = Index(limb) ^ Index(LimbOf(of));
  return 2 * (difference - 1) + (IsLower(of) ? 1 : 0);
}

/// With the other hand after them, which only arms relate to.
inline constexpr std::size_t kHandSlot = kOtherSegmentCount;
inline constexpr std::size_t kOtherCapsuleCount = kOtherSegmentCount + 1;

}  // namespace ego
