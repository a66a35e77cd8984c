// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/math.h"
#include "render/camera.h"

namespace ego {

/// Towards the key light, unit: from the front, the bodies' left and above.
const Vec3& KeyDirection();

/// World to clip space of the smallest orthographic view along the key light that holds the box.
Mat4 LightMatrix(const Box3& box);

/// The part of the ground y = 0 that lies under the box or in its shadow, as the x and z of a box.
Box3 ShadowOnGround(const Box3& box);

}  // namespace ego
