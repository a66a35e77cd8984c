// SPDX-License-Identifier: MIT
#include "core/model/rig.h"

#include "core/base/check.h"

namespace ego {

void PoseNodes(const Rig& rig, const ModelPose& pose, std::span<Mat4> node_global) {
  EGO_CHECK(node_global.size() == rig.driver.size());
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(rig.skeleton);
  std::array<Mat4, kJointCount> motion;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    motion[j] = glm::mat4_cast(pose.rotation_ws[j]);
    motion[j][3] = Vec4(pose.position_ws[j] - pose.rotation_ws[j] * canonical[j], 1.0);
  }
  for (std::size_t n = 0; n < node_global.size(); ++n) {
    node_global[n] = motion[Index(rig.driver[n])] * rig.canonical_global[n];
  }
}

}  // namespace ego
