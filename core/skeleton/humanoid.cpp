// SPDX-License-Identifier: MIT
#include "core/skeleton/humanoid.h"

namespace ego {
namespace {

constexpr std::array<std::string_view, kJointCount> kNames = {
    "hips",          "spine",         "chest",         "upperChest",    "neck",
    "head",          "leftShoulder",  "leftUpperArm",  "leftLowerArm",  "leftHand",
    "rightShoulder", "rightUpperArm", "rightLowerArm", "rightHand",     "leftUpperLeg",
    "leftLowerLeg",  "leftFoot",      "leftToes",      "rightUpperLeg", "rightLowerLeg",
    "rightFoot",     "rightToes"};

}  // namespace

std::string_view Name(HumanoidJoint joint) { return kNames[Index(joint)]; }

std::optional<HumanoidJoint> JointNamed(std::string_view vrm_name) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (kNames[i] == vrm_name) return static_cast<HumanoidJoint>(i);
  }
  return std::nullopt;
}

HumanoidJoint Mirror(HumanoidJoint joint) {
  constexpr std::size_t kArm = Index(HumanoidJoint::kLeftShoulder);
  constexpr std::size_t kLeg = Index(HumanoidJoint::kLeftUpperLeg);
  const std::size_t i = Index(joint);
  if (i < kArm) return joint;
  const std::size_t first = i < kLeg ? kArm : kLeg;
  const std::size_t offset = i - first;
  return static_cast<HumanoidJoint>(first + (offset + 4) % 8);
}

}  // namespace ego
