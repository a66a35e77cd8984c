// SPDX-License-Identifier: MIT
// Sizes, targets, samples, shadows: what holds for every picture.
#include "render/stage_renderer.h"

#include <array>

#include "render/gl/surface.h"
#include "render/png.h"
#include "tests/render/stage_picture_fixture.h"

namespace ego::test {
namespace {

using J = HumanoidJoint;
class StageRendererTest : public StagePictureTest {};

TEST_F(StageRendererTest, AnEmptyStageIsADarkRoom) {
  const Image image = Draw();
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  ASSERT_EQ(image.rgba.size(), 4u * kWidth * kHeight);
  const glm::ivec3 top = PixelAt(image, kWidth / 2, 4);
  EXPECT_LE(Difference(top, glm::ivec3{0x14, 0x16, 0x1A}), 8);
  for (int y = 0; y < kHeight; y += 7) {
    for (int x = 0; x < kWidth; x += 7) {
      const glm::ivec3 p = PixelAt(image, x, y);
      EXPECT_LT(std::max({p.x, p.y, p.z}), 140);
    }
  }
  EXPECT_TRUE(renderer_->Bounds({}).IsEmpty());
}

TEST_F(StageRendererTest, ShadowsDarkenTheFloorBesideTheBody) {
  AddSurface();
  view_.shadows = false;
  const Image without = Draw();
  view_.shadows = true;
  const Image with = Draw();
  const int feet = Where({0.0, 0.0, 0.0}, view_.camera, kWidth, kHeight).y;
  int darker = 0, brighter = 0;
  Differing(without, with, 3, [&](int x, int y) {
    const int change = PixelAt(with, x, y).y - PixelAt(without, x, y).y;
    if (change > 0) ++brighter;
    if (change < -8 && std::abs(y - feet) < kHeight / 4) ++darker;
  });
  EXPECT_GT(darker, 200);
  EXPECT_EQ(brighter, 0);
}

TEST_F(StageRendererTest, ResizingLeavesNoTrace) {
  AddSurface().name = "Same";
  const Image first = Draw();
  view_.figures = figures_;
  EXPECT_EQ(renderer_->DrawImage(view_, 97, 301).rgba.size(), 4u * 97 * 301);
  EXPECT_EQ(renderer_->DrawImage(view_, 640, 64, 2.0f).rgba.size(), 4u * 640 * 64);
  EXPECT_EQ(Draw().rgba, first.rgba);
}

TEST_F(StageRendererTest, EmptyAndAbsurdSizesDrawNothing) {
  AddSurface();
  view_.figures = figures_;
  EXPECT_TRUE(renderer_->DrawImage(view_, 0, 100).rgba.empty());
  EXPECT_TRUE(renderer_->DrawImage(view_, 100, -5).rgba.empty());
  EXPECT_TRUE(renderer_->DrawImage(view_, 1 << 24, 100).rgba.empty());
  renderer_->Draw(view_, DrawTarget{});
  EXPECT_EQ(renderer_->DrawImage(view_, 1, 1).rgba.size(), 4u);
}

TEST_F(StageRendererTest, OnlyTheTargetsRectangleIsTouched) {
  AddSurface();
  view_.figures = figures_;
  for (const int samples : {0, 4}) {
    renderer_->SetSamples(samples);
    gl::ColorTarget window;
    ASSERT_TRUE(window.Resize(300, 200, 0));
    glBindFramebuffer(GL_FRAMEBUFFER, window.Name());
    glClearColor(1.0f, 0.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    renderer_->Draw(view_, {window.Name(), 40, 30, 200, 120, 1.0f});
    Image all{300, 200, std::vector<std::uint8_t>(4u * 300 * 200)};
    glReadPixels(0, 0, 300, 200, GL_RGBA, GL_UNSIGNED_BYTE, all.rgba.data());
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 300; ++x) {
        const bool inside = x >= 40 && x < 240 && y >= 30 && y < 150;
        ASSERT_EQ(PixelAt(all, x, y) == glm::ivec3(255, 0, 255), !inside) << x << " " << y;
      }
    }
  }
}

TEST_F(StageRendererTest, MultisamplingSoftensEdgesAndKeepsThePicture) {
  AddSurface();
  const Image hard = Draw();
  renderer_->SetSamples(4);
  if (renderer_->Samples() < 2) GTEST_SKIP() << "the driver has no multisampling";
  const Image soft = Draw();
  const int changed = Differing(hard, soft, 12);
  EXPECT_GT(changed, 100);
  EXPECT_LT(changed, kWidth * kHeight / 20);
  renderer_->SetSamples(1 << 20);
  EXPECT_LE(renderer_->Samples(), 64);
}

TEST_F(StageRendererTest, TheSameViewGivesTheSamePicture) {
  AddSurface(0.6f).name = "Again";
  const Image first = Draw();
  figures_[0].offset_ws = {1.0, 0.0, 0.0};
  Draw();
  figures_[0].offset_ws = Vec3{0.0};
  EXPECT_EQ(Draw().rgba, first.rgba);
}

TEST_F(StageRendererTest, BoundsOfMarkersAndOffsetsAreExact) {
  const std::array<Vec3, 2> at = {Vec3{-1.0, 0.5, 0.0}, Vec3{1.0, 2.0, 0.25}};
  const std::array<std::uint8_t, 2> visible = {1, 1};
  Figure& figure = figures_.emplace_back();
  figure.markers = MarkerPart{MarkerFrame{0.0, at, visible}};
  figure.offset_ws = {2.0, 0.0, 0.0};
  const Box3 bounds = renderer_->Bounds(figures_);
  EXPECT_NEAR(bounds.min.x, 1.0 - figure.markers->radius, 1e-3);
  EXPECT_NEAR(bounds.max.x, 3.0 + figure.markers->radius, 1e-3);
  EXPECT_NEAR(bounds.max.y, 2.0 + figure.markers->radius, 1e-3);
}

TEST(Png, IsAPngOfThatSize) {
  Image image{3, 2, std::vector<std::uint8_t>(24, 200)};
  const std::vector<std::uint8_t> bytes = EncodePng(image);
  ASSERT_GT(bytes.size(), 24u);
  EXPECT_EQ(std::string(bytes.begin() + 1, bytes.begin() + 4), "PNG");
  EXPECT_EQ(bytes[19], 3);  // width, the last of its four bytes
  EXPECT_EQ(bytes[23], 2);
  image.rgba.pop_back();
  EXPECT_TRUE(EncodePng(image).empty());
  EXPECT_TRUE(EncodePng({}).empty());
}

}  // namespace
}  // namespace ego::test
