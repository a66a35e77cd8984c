// SPDX-License-Identifier: MIT
#include "core/skeleton/joint_tree.h"

namespace ego {

std::vector<Mat4> JointTree::RestGlobal() const {
  std::vector<Mat4> global(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    global[i] = joint.parent < 0
                    ? joint.rest_local
                    : global[static_cast<std::size_t>(joint.parent)] * joint.rest_local;
  }
  return global;
}

}  // namespace ego
