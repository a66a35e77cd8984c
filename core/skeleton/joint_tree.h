// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/skeleton/humanoid.h"

namespace ego {

/// Any joint hierarchy from a file: a rig's nodes or a motion's joints, before anyone knows which
/// of them is the left elbow. Parents come before children.
struct JointTree {
  struct Joint {
    std::string name;
    int parent = -1;
    Mat4 rest_local{1.0};  // file units
  };
  std::vector<Joint> joints;

  /// Rest transforms in the file's own space.
  std::vector<Mat4> RestGlobal() const;
};

/// A motion on a joint tree, as BVH and glTF animations hold it.
struct JointMotion {
  std::string name;
  JointTree tree;
  double rate_hz = 0.0;
  std::size_t frame_count = 0;
  std::vector<Quat> rotation_ls;     // frame_count * joints, sign-continuous
  std::vector<Vec3> translation_ls;  // same shape; file units, relative to the parent
  std::vector<std::string> warnings;
};

}  // namespace ego
