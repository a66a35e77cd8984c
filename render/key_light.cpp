// SPDX-License-Identifier: MIT
#include "render/key_light.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace ego {

const Vec3& KeyDirection() {
  static const Vec3 kDirection = glm::normalize(Vec3{0.46, 0.88, 0.62});
  return kDirection;
}

Mat4 LightMatrix(const Box3& box) {
  const Mat4 view = glm::lookAt(KeyDirection(), Vec3{0.0}, kUp);
  Box3 fit;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1u) != 0u ? box.max.x : box.min.x,
                      (i & 2u) != 0u ? box.max.y : box.min.y,
                      (i & 4u) != 0u ? box.max.z : box.min.z};
    fit.Add(Vec3(view * Vec4(corner, 1.0)));
  }
  constexpr double kEdge = 0.05;  // metres around, so that nothing touches the map's border
  return glm::ortho(fit.min.x - kEdge, fit.max.x + kEdge, fit.min.y - kEdge, fit.max.y + kEdge,
                    -fit.max.z - kEdge, -fit.min.z + kEdge) *
         view;
}

Box3 ShadowOnGround(const Box3& box) {
  Box3 shaded;
  for (const double y : {box.min.y, box.max.y}) {
    const Vec3 thrown = std::max(0.0, y) / KeyDirection().y * KeyDirection();
    shaded.Add(box.min - thrown);
    shaded.Add(box.max - thrown);
  }
  return shaded;
}

}  // namespace ego
