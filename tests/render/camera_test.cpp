// SPDX-License-Identifier: MIT
#include "render/camera.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace ego {
namespace {

constexpr ViewportSize kWide{1280, 720};
constexpr ViewportSize kTall{400, 900};

std::vector<Camera> SomeCameras() {
  std::vector<Camera> all;
  for (const double yaw : {-2.9, -0.6, 0.0, 0.42, 1.57}) {
    for (const double pitch : {-0.7, 0.0, 0.1, 1.2}) {
      Camera camera;
      camera.target_ws = {0.3, 1.1, -0.4};
      camera.yaw = yaw;
      camera.pitch = pitch;
      camera.distance = 3.7;
      all.push_back(camera);
    }
  }
  return all;
}

std::vector<Vec3> CornersOf(const Box3& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.min.x, box.max.x}) {
    for (const double y : {box.min.y, box.max.y}) {
      for (const double z : {box.min.z, box.max.z}) corners.push_back({x, y, z});
    }
  }
  return corners;
}

TEST(Camera, FrontViewStandsBeforeTheStageWithLeftOfTheBodyToTheRight) {
  Camera camera;
  camera.Look(StandardView::kFront);
  EXPECT_NEAR(camera.Position().z, camera.target_ws.z + camera.distance, 1e-12);
  const Vec3 left_hand = camera.target_ws + Vec3{0.5, 0.0, 0.0};  // a body that faces +Z
  const std::optional<Vec3> pixel = camera.Project(left_hand, kWide);
  ASSERT_TRUE(pixel);
  EXPECT_GT(pixel->x, 640.0);
  EXPECT_NEAR(pixel->y, 360.0, 1e-9);
}

TEST(Camera, SideAndTopViewsLookAlongTheAxes) {
  Camera camera;
  camera.Look(StandardView::kSide);
  EXPECT_NEAR(glm::distance(camera.Forward(), Vec3(-1, 0, 0)), 0.0, 1e-12);
  camera.Look(StandardView::kTop);
  EXPECT_NEAR(glm::distance(camera.Forward(), Vec3(0, -1, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(camera.Right(), Vec3(1, 0, 0)), 0.0, 1e-12);
}

TEST(Camera, MatricesAndProjectionAgreeWithGlm) {
  for (const Camera& camera : SomeCameras()) {
    const Mat4 look_at = glm::lookAt(camera.Position(), camera.target_ws, kUp);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(glm::distance(camera.View()[i], look_at[i]), 0.0, 1e-12);
    }
    const Vec3 point{0.7, 0.2, 0.5};
    const Vec4 viewport{0.0, 0.0, kWide.width, kWide.height};
    const Vec3 window = glm::project(point, look_at, camera.Projection(kWide), viewport);
    const std::optional<Vec3> pixel = camera.Project(point, kWide);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, window.x, 1e-8);
    EXPECT_NEAR(pixel->y, kWide.height - window.y, 1e-8);
  }
}

TEST(Camera, RayThroughAPixelMeetsWhatIsProjectedThere) {
  for (const Camera& camera : SomeCameras()) {
    const Vec3 point{-0.4, 1.6, 0.1};
    const std::optional<Vec3> pixel = camera.Project(point, kTall);
    ASSERT_TRUE(pixel);
    const Vec3 ray = camera.RayThrough(Vec2(*pixel), kTall);
    EXPECT_NEAR(glm::length(glm::cross(ray, point - camera.Position())), 0.0, 1e-9);
  }
}

TEST(Camera, NothingIsProjectedFromBehindOrIntoAnEmptyPicture) {
  const Camera camera;
  EXPECT_FALSE(camera.Project(camera.Position() - camera.Forward(), kWide));
  EXPECT_FALSE(camera.Project(camera.target_ws, {0, 0}));
}

TEST(Camera, OrbitKeepsTargetAndDistanceAndStopsAtThePoles) {
  Camera camera;
  const Vec3 target = camera.target_ws;
  camera.Orbit({100.0, 5000.0}, kWide);
  EXPECT_NEAR(camera.pitch, 0.5 * kPi, 1e-12);
  EXPECT_EQ(camera.target_ws, target);
  EXPECT_NEAR(glm::distance(camera.Position(), target), camera.distance, 1e-12);
  const double yaw = camera.yaw;
  camera.Orbit({720.0, 0.0}, kWide);  // the picture's height: half a turn
  EXPECT_NEAR(std::abs(std::remainder(camera.yaw - yaw, 2.0 * kPi)), kPi, 1e-9);
}

TEST(Camera, DraggingToTheRightTurnsTheBodyToTheRight) {
  Camera camera;
  camera.Look(StandardView::kFront);
  const Vec3 nose = camera.target_ws + Vec3{0.0, 0.0, 0.2};
  camera.Orbit({60.0, 0.0}, kWide);
  EXPECT_GT(camera.Project(nose, kWide)->x, 640.0);
}

TEST(Camera, PanKeepsThePointUnderThePointer) {
  for (Camera camera : SomeCameras()) {
    const Vec3 grabbed = camera.target_ws + 0.3 * camera.Right() - 0.2 * camera.Up();
    const Vec3 before = *camera.Project(grabbed, kWide);
    camera.Pan({37.0, -21.0}, kWide);
    const Vec3 after = *camera.Project(grabbed, kWide);
    EXPECT_NEAR(after.x - before.x, 37.0, 1e-8);
    EXPECT_NEAR(after.y - before.y, -21.0, 1e-8);
  }
}

TEST(Camera, ZoomKeepsThePointUnderTheCursor) {
  for (Camera camera : SomeCameras()) {
    const Vec3 under = camera.target_ws - 0.4 * camera.Right() + 0.5 * camera.Up();
    const Vec3 cursor = *camera.Project(under, kWide);
    const double before = camera.distance;
    for (const double steps : {1.0, 3.5, -2.0}) {
      camera.Zoom(steps, Vec2(cursor), kWide);
      const Vec3 now = *camera.Project(under, kWide);
      EXPECT_NEAR(glm::distance(Vec2(now), Vec2(cursor)), 0.0, 1e-7);
    }
    EXPECT_NEAR(camera.distance, before / std::pow(1.12, 2.5), 1e-9);
  }
}

TEST(Camera, FrameShowsTheWholeBoxAndNoMoreThanNeeded) {
  Box3 wide, high;
  wide.Add(Vec3{-3.0, 0.0, -0.4});
  wide.Add(Vec3{4.0, 1.9, 0.5});
  high.Add(Vec3{-0.2, 0.0, -0.2});
  high.Add(Vec3{0.3, 2.4, 0.2});
  for (const Box3& box : {wide, high}) {
    for (const ViewportSize size : {kWide, kTall}) {
      for (Camera camera : SomeCameras()) {
        const Vec3 forward = camera.Forward();
        const double margin = 0.08;
        camera.Frame(box, size, margin);
        EXPECT_EQ(camera.Forward(), forward);
        double closest = 1.0;  // of a corner to the picture's edge, as a share
        for (const Vec3& corner : CornersOf(box)) {
          const std::optional<Vec3> pixel = camera.Project(corner, size);
          ASSERT_TRUE(pixel);
          const double x = pixel->x / size.width, y = pixel->y / size.height;
          closest = std::min({closest, x, 1.0 - x, y, 1.0 - y});
        }
        EXPECT_GT(closest, margin - 0.012);
        EXPECT_LT(closest, margin + 0.012);
      }
    }
  }
}

TEST(Camera, FramingNothingChangesNothing) {
  Camera camera;
  camera.Frame(Box3{}, kWide);
  EXPECT_EQ(camera.target_ws, Camera{}.target_ws);
  EXPECT_EQ(camera.distance, Camera{}.distance);
  Box3 point;
  point.Add(Vec3{1.0, 2.0, 3.0});
  camera.Frame(point, {0, 0});
  EXPECT_TRUE(std::isfinite(camera.distance));
  EXPECT_GT(camera.distance, 0.0);
}

}  // namespace
}  // namespace ego
