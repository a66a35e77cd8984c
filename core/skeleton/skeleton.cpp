// SPDX-License-Identifier: MIT
#include "core/skeleton/skeleton.h"

namespace ego {

std::array<Vec3, kJointCount> CanonicalPositions(const Skeleton& skeleton) {
  std::array<Vec3, kJointCount> position;
  position[0] = skeleton.offset[0];
  for (std::size_t i = 1; i < kJointCount; ++i) {
    position[i] = position[Index(kParent[i])] + skeleton.offset[i];
  }
  return position;
}

double BoneLength(const Skeleton& skeleton, HumanoidJoint joint) {
  return glm::length(skeleton.offset[Index(joint)]);
}

Skeleton Scaled(const Skeleton& skeleton, double factor) {
  Skeleton scaled = skeleton;
  for (Vec3& offset : scaled.offset) offset *= factor;
  return scaled;
}

}  // namespace ego
