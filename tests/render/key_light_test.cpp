// SPDX-License-Identifier: MIT
#include "render/key_light.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ego {
namespace {

TEST(KeyLight, ItsViewHoldsTheBoxAndThrowsShadowsAlongTheLight) {
  Box3 box;
  box.Add(Vec3{-3.0, 0.0, -0.5});
  box.Add(Vec3{2.0, 1.9, 0.7});
  const Mat4 light = LightMatrix(box);
  const Box3 ground = ShadowOnGround(box);
  for (const double x : {box.min.x, -1.0, box.max.x}) {
    for (const double y : {box.min.y, 0.8, box.max.y}) {
      for (const double z : {box.min.z, 0.1, box.max.z}) {
        const Vec3 p{x, y, z};
        const Vec4 clip = light * Vec4(p, 1.0);
        for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(clip[i]), 1.0);
        // Its shadow lies on the ground, at the same place of the map and farther from the light.
        const Vec3 shadow = p - (p.y / KeyDirection().y) * KeyDirection();
        const Vec4 shadow_clip = light * Vec4(shadow, 1.0);
        EXPECT_NEAR(shadow_clip.x, clip.x, 1e-9);
        EXPECT_NEAR(shadow_clip.y, clip.y, 1e-9);
        EXPECT_GE(shadow_clip.z, clip.z - 1e-9);
        EXPECT_GE(shadow.x, ground.min.x - 1e-9);
        EXPECT_LE(shadow.x, ground.max.x + 1e-9);
        EXPECT_GE(shadow.z, ground.min.z - 1e-9);
        EXPECT_LE(shadow.z, ground.max.z + 1e-9);
      }
    }
  }
}

TEST(KeyLight, APointHasAViewToo) {
  Box3 point;
  point.Add(Vec3{0.1, 0.2, 0.3});
  const Vec4 clip = LightMatrix(point) * Vec4{0.1, 0.2, 0.3, 1.0};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(clip[i], 0.0, 1e-9);
}

}  // namespace
}  // namespace ego
