// SPDX-License-Identifier: MIT
#include "core/solve/skin_prior.h"

#include <cmath>

#include "core/body/body.h"
#include "core/solve/body_parameters.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kHipsSigma = 0.02;
constexpr double kTrunkSigma = 0.08;
constexpr double kShoulderSigma = 0.10;
constexpr double kLimbSigma = 0.05;
constexpr double kTwistSigma = 0.05;
// Farther from the middle than this, upper chest markers lie on the shoulder girdle, not the neck.
constexpr double kGirdle = 0.05;

}  // namespace

SkinPrior SkinPriorOf(const SetMarker& place) {
  static const std::array<Vec3, kJointCount> kCanonical =
      CanonicalPositions(TemplateSkeleton(1.78));
  const Vec3& at = place.position_ms;
  const bool left = at.x > 0.0;
  const double along = AlongBone(place.joint, at - kCanonical[Index(place.joint)]);
  switch (place.joint) {
    case J::kHips:
      if (at.z < 0.0) return {J::kSpine, {0.0, kHipsSigma, 0.0}};
      return {left ? J::kLeftUpperLeg : J::kRightUpperLeg, {0.0, kHipsSigma, 0.0}};
    case J::kSpine:
    case J::kChest:
      return {BoneEnd(place.joint), {kTrunkSigma, kTrunkSigma, 0.0}};
    case J::kUpperChest:
      if (std::abs(at.x) < kGirdle) return {J::kNeck, {kTrunkSigma, kTrunkSigma, 0.0}};
      return {left ? J::kLeftShoulder : J::kRightShoulder, {kTrunkSigma, kTrunkSigma, 0.0}};
    case J::kLeftShoulder:
    case J::kRightShoulder:
      return {BoneEnd(place.joint), {kShoulderSigma, kShoulderSigma, 0.0}};
    case J::kLeftUpperArm:
    case J::kRightUpperArm:
    case J::kLeftLowerArm:
    case J::kRightLowerArm:
    case J::kLeftUpperLeg:
    case J::kRightUpperLeg:
      return {BoneEnd(place.joint), {kLimbSigma * (1.0 - along), kLimbSigma * along, kTwistSigma}};
    case J::kLeftLowerLeg:
    case J::kRightLowerLeg:
      // No share of the foot: ankles are bone under skin, and the feet's frames are levelled later.
      return {J::kHips, {kLimbSigma * (1.0 - along), 0.0, kTwistSigma}};
    default:
      return {};
  }
}

}  // namespace ego
