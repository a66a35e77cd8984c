// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/base/math.h"

namespace ego {

/// x_ws = rotation * x_ms + translation.
struct RigidTransform {
  Quat rotation = kIdentity;
  Vec3 translation{0.0};
};

/// The rotation and translation that carry `from` nearest to `to` in the least-squares sense (Horn
/// 1987, unit quaternions). Equal lengths. Collinear or coinciding points leave a turn open: some
/// valid one is returned. No points: identity.
RigidTransform FitRigid(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace ego
