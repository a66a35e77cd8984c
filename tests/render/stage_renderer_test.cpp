// SPDX-License-Identifier: MIT
// Pictures drawn without a window. Where something must appear is computed with GLM's own camera
// functions, apart from the renderer's.
#include "render/stage_renderer.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/model/rig.h"
#include "render/gl/surface.h"
#include "render/offscreen.h"
#include "render/png.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

using J = HumanoidJoint;
constexpr int kWidth = 480;
constexpr int kHeight = 320;

glm::ivec3 PixelAt(const Image& image, int x, int y) {
  const std::size_t i = 4u * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}

glm::ivec2 Where(const Vec3& point, const Camera& camera, int width, int height) {
  const Mat4 view = glm::lookAt(camera.Position(), camera.target_ws, kUp);
  const Mat4 projection =
      glm::perspective(camera.fov_y, static_cast<double>(width) / height, 0.1, 100.0);
  const Vec3 window = glm::project(point, view, projection, Vec4{0, 0, width, height});
  return {static_cast<int>(std::floor(window.x)), static_cast<int>(std::floor(height - window.y))};
}
glm::ivec3 PixelAt(const Image& image, const Vec3& point, const Camera& camera) {
  const glm::ivec2 at = Where(point, camera, image.width, image.height);
  return PixelAt(image, at.x, at.y);
}

int Difference(const glm::ivec3& a, const glm::ivec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// Calls for every pixel that differs by more than `least`; returns how many.
int Differing(const Image& a, const Image& b, int least,
              const std::function<void(int, int)>& visit = {}) {
  int count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (Difference(PixelAt(a, x, y), PixelAt(b, x, y)) <= least) continue;
      ++count;
      if (visit) visit(x, y);
    }
  }
  return count;
}

class StageRendererTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<OffscreenContext> made = OffscreenContext::Create();
    if (!made) {
      reason_ = made.error();
      return;
    }
    context_ = std::make_unique<OffscreenContext>(std::move(*made));
    StageRenderer::Options options;
    options.shadow_map_size = 1024;
    Result<StageRenderer> renderer = StageRenderer::Create(options);
    ASSERT_TRUE(renderer) << renderer.error();
    renderer_ = std::make_unique<StageRenderer>(std::move(*renderer));
  }
  static void TearDownTestSuite() {
    renderer_.reset();
    context_.reset();
  }
  void SetUp() override {
    if (!context_) GTEST_SKIP() << reason_;
    body_ = TemplateBody();
    pose_ = ForwardKinematics(body_.skeleton, CanonicalPose(body_.skeleton));
    view_.camera.Look(StandardView::kFront);
    view_.camera.pitch = 0.15;
    view_.camera.distance = 4.0;
    renderer_->SetSamples(0);
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
  }

  Image Draw() {
    view_.figures = figures_;
    return renderer_->DrawImage(view_, kWidth, kHeight);
  }
  Figure& AddSurface(float opacity = 1.0f) {
    Figure& figure = figures_.emplace_back();
    figure.surface = SurfacePart{&body_, &pose_};
    figure.surface->opacity = opacity;
    return figure;
  }
  /// A character in one plain colour; `nodes_` holds its canonical pose.
  Character RedPerson() {
    Character person = test::MakeCapsulePerson();
    person.materials.push_back({});
    person.materials.back().base_color = {0.8f, 0.02f, 0.02f, 1.0f};
    for (MeshPart& part : person.parts) part.material = 0;
    nodes_.resize(person.nodes.joints.size());
    const Skeleton& skeleton = person.rig.skeleton;
    PoseNodes(person.rig, ForwardKinematics(skeleton, CanonicalPose(skeleton)), nodes_);
    return person;
  }

  static std::unique_ptr<OffscreenContext> context_;
  static std::unique_ptr<StageRenderer> renderer_;
  static std::string reason_;

  Body body_;
  ModelPose pose_;
  std::vector<Figure> figures_;
  std::vector<Mat4> nodes_;
  StageView view_;
};
std::unique_ptr<OffscreenContext> StageRendererTest::context_;
std::unique_ptr<StageRenderer> StageRendererTest::renderer_;
std::string StageRendererTest::reason_;

bool IsRed(const glm::ivec3& p) { return p.x > 60 && p.x > 2 * p.y && p.x > 2 * p.z; }
bool IsAmber(const glm::ivec3& p) { return p.x > 70 && p.x > p.y + 10 && p.y > p.z + 15; }

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

TEST_F(StageRendererTest, ACharacterAppearsWhereTheCameraProjectsIt) {
  const CharacterId id = renderer_->Load(RedPerson());
  const Image empty = Draw();
  figures_.emplace_back().character = CharacterPart{id, nodes_};
  figures_[0].offset_ws = {0.5, 0.0, -0.3};
  const Image image = Draw();
  for (const J joint : {J::kSpine, J::kLeftLowerArm, J::kRightLowerLeg, J::kHead}) {
    const Vec3 at = Vec3(nodes_[Index(joint)][3]) + figures_[0].offset_ws;
    EXPECT_TRUE(IsRed(PixelAt(image, at, view_.camera))) << Name(joint);
  }
  // Nothing of it stands where nobody is.
  const Vec3 beside = figures_[0].offset_ws + Vec3{0.0, 2.2, 0.0};
  EXPECT_LE(Difference(PixelAt(image, beside, view_.camera), PixelAt(empty, beside, view_.camera)),
            2);
  const Box3 bounds = renderer_->Bounds(figures_);
  EXPECT_NEAR(bounds.Center().x, 0.5, 0.02);
  EXPECT_NEAR(bounds.max.y, 1.78, 0.12);
  renderer_->Unload(id);
}

TEST_F(StageRendererTest, SkinnedPositionsAreThoseOfThePose) {
  const Character person = RedPerson();
  const CharacterId id = renderer_->Load(person);
  figures_.emplace_back().character = CharacterPart{id, nodes_};
  figures_[0].offset_ws = {0.0, 0.0, 1.0};
  Draw();
  for (std::size_t p = 0; p < person.parts.size(); ++p) {
    const std::span<const glm::vec3> drawn = renderer_->SkinnedPositions(0, p);
    ASSERT_EQ(drawn.size(), person.parts[p].positions.size());
    for (std::size_t v = 0; v < drawn.size(); v += 13) {
      // The canonical pose is the bind pose of this character.
      const Vec3 expected = Vec3(person.parts[p].positions[v]) + figures_[0].offset_ws;
      EXPECT_NEAR(glm::distance(Vec3(drawn[v]), expected), 0.0, 1e-5);
    }
  }
  EXPECT_TRUE(renderer_->SkinnedPositions(1, 0).empty());
  renderer_->Unload(id);
}

TEST_F(StageRendererTest, UnknownCharactersAndWrongNodesDrawNothing) {
  const CharacterId id = renderer_->Load(RedPerson());
  const Image empty = Draw();
  figures_.emplace_back().character = CharacterPart{CharacterId{999}, nodes_};
  figures_.emplace_back().character = CharacterPart{id, std::span(nodes_).first(3)};
  EXPECT_EQ(Differing(empty, Draw(), 0), 0);
  renderer_->Unload(id);
  renderer_->Unload(CharacterId{999});
}

TEST_F(StageRendererTest, ACharacterWithWrongIndicesLosesThePartOnly) {
  Character person = RedPerson();
  MeshPart broken = person.parts[0];
  broken.triangles[0] = 1000000;
  person.parts.push_back(broken);
  broken = person.parts[0];
  broken.influences[0] = {};
  broken.influences[0].weight[0] = 1.0f;
  broken.influences[0].entry[0] = 5000;
  person.parts.push_back(broken);
  const CharacterId id = renderer_->Load(person);
  figures_.emplace_back().character = CharacterPart{id, nodes_};
  const Image image = Draw();
  EXPECT_TRUE(IsRed(PixelAt(image, Vec3(nodes_[Index(J::kSpine)][3]), view_.camera)));
  renderer_->Unload(id);
}

TEST_F(StageRendererTest, AMirroredCharacterShowsItsOutside) {
  const Character person = RedPerson();
  const CharacterId id = renderer_->Load(person);
  view_.camera.Look(StandardView::kFront);
  view_.shadows = false;  // they fall to one side
  figures_.emplace_back().character = CharacterPart{id, nodes_};
  const Image plain = Draw();
  for (Mat4& node : nodes_) node = glm::scale(Mat4{1.0}, Vec3{-1.0, 1.0, 1.0}) * node;
  const Image mirrored = Draw();
  // A symmetric person covers the same pixels either way; seen from inside it would be lit
  // from behind.
  const Vec3 belly = Vec3(nodes_[Index(J::kSpine)][3]);
  EXPECT_LE(Difference(PixelAt(plain, belly, view_.camera), PixelAt(mirrored, belly, view_.camera)),
            6);
  renderer_->Unload(id);
}

TEST_F(StageRendererTest, TexturesColourTheCharacterAndMasksCutHoles) {
  Character person = RedPerson();
  person.images.push_back({2, 1, {20, 200, 30, 255, 20, 200, 30, 255}});
  person.materials[0].base_color = glm::vec4{1.0f};
  person.materials[0].base_color_image = 0;
  for (MeshPart& part : person.parts) part.uvs.assign(part.positions.size(), {0.5f, 0.5f});
  const CharacterId green = renderer_->Load(person);
  person.images[0].rgba[3] = person.images[0].rgba[7] = 10;
  person.materials[0].alpha_mask = true;
  const CharacterId cut = renderer_->Load(person);
  view_.grid = false;  // the floor's light follows the figures
  const Image empty = Draw();
  figures_.emplace_back().character = CharacterPart{green, nodes_};
  const glm::ivec3 p = PixelAt(Draw(), Vec3(nodes_[Index(J::kSpine)][3]), view_.camera);
  EXPECT_GT(p.y, 2 * p.x);
  EXPECT_GT(p.y, 2 * p.z);
  view_.shadows = false;
  figures_[0].character->character = cut;
  const Vec3 spine = Vec3(nodes_[Index(J::kSpine)][3]);
  EXPECT_LE(Difference(PixelAt(Draw(), spine, view_.camera), PixelAt(empty, spine, view_.camera)),
            0);
  renderer_->Unload(green);
  renderer_->Unload(cut);
}

TEST_F(StageRendererTest, MarkersAppearAndInvisibleOnesAreAbsent) {
  const std::array<Vec3, 2> at = {Vec3{0.5, 1.0, 0.0}, Vec3{-0.6, 1.2, 0.1}};
  std::array<std::uint8_t, 2> visible = {1, 0};
  Figure& figure = figures_.emplace_back();
  figure.markers = MarkerPart{MarkerFrame{0.0, at, visible}};
  figure.markers->radius = 0.03;
  const Image one = Draw();
  EXPECT_TRUE(IsAmber(PixelAt(one, at[0], view_.camera)));
  EXPECT_FALSE(IsAmber(PixelAt(one, at[1], view_.camera)));
  visible[1] = 1;
  EXPECT_TRUE(IsAmber(PixelAt(Draw(), at[1], view_.camera)));
}

TEST_F(StageRendererTest, SkeletonIsOffWhiteAtItsJoints) {
  figures_.emplace_back().skeleton = SkeletonPart{&body_.skeleton, &pose_};
  const Image image = Draw();
  for (const J joint : {J::kHips, J::kLeftLowerArm, J::kRightLowerLeg, J::kNeck}) {
    const glm::ivec3 p = PixelAt(image, pose_.Position(joint), view_.camera);
    EXPECT_GT(std::min({p.x, p.y, p.z}), 110) << Name(joint);
    EXPECT_LT(std::max({p.x, p.y, p.z}) - std::min({p.x, p.y, p.z}), 40) << Name(joint);
  }
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

TEST_F(StageRendererTest, SurfaceIsAmberAndHasAllItsLimbs) {
  AddSurface();
  const Image image = Draw();
  for (const J joint : {J::kChest, J::kLeftLowerArm, J::kRightHand, J::kLeftLowerLeg, J::kHead}) {
    EXPECT_TRUE(IsAmber(PixelAt(image, pose_.Position(joint), view_.camera))) << Name(joint);
  }
}

TEST_F(StageRendererTest, WhatIsInsideShowsThroughATranslucentSurface) {
  AddSurface(1.0f).skeleton = SkeletonPart{&body_.skeleton, &pose_};
  const glm::ivec3 hidden = PixelAt(Draw(), pose_.Position(J::kChest), view_.camera);
  figures_[0].surface->opacity = 0.4f;
  const glm::ivec3 seen = PixelAt(Draw(), pose_.Position(J::kChest), view_.camera);
  EXPECT_GT(seen.z, hidden.z + 30) << "white bone behind amber";
}

TEST_F(StageRendererTest, AnOverlayIsDrawnOverWhatHidesIt) {
  const CharacterId id = renderer_->Load(RedPerson());
  Body small = Scaled(body_, 0.9);  // inside the character
  figures_.emplace_back().character = CharacterPart{id, nodes_};
  figures_[0].surface = SurfacePart{&body_, &pose_};
  figures_[0].skeleton = SkeletonPart{&body_.skeleton, &pose_};
  figures_[0].surface.reset();
  const Vec3 hips = pose_.Position(J::kHips);
  EXPECT_TRUE(IsRed(PixelAt(Draw(), hips, view_.camera)));
  figures_[0].skeleton->through = true;
  EXPECT_FALSE(IsRed(PixelAt(Draw(), hips, view_.camera)));
  renderer_->Unload(id);
}

TEST_F(StageRendererTest, ContactsGlow) {
  AddSurface();
  const Image without = Draw();
  const ContactGlow glow{pose_.Position(J::kHips)};
  figures_[0].contacts = std::span(&glow, 1);
  const Image with = Draw();
  EXPECT_GT(PixelAt(with, glow.position_ws, view_.camera).y,
            PixelAt(without, glow.position_ws, view_.camera).y + 40);
}

TEST_F(StageRendererTest, NamePlateStandsAtTheFeet) {
  AddSurface();
  const Image without = Draw();
  figures_[0].name = "Child";
  int low_x = kWidth, high_x = 0, low_y = kHeight, high_y = 0;
  int bright = 0;
  const Image with = Draw();
  Differing(without, with, 2, [&](int x, int y) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
    if (PixelAt(with, x, y).y > 150) ++bright;
  });
  ASSERT_LT(low_x, high_x);
  const glm::ivec2 feet = Where({0.0, 0.0, 0.0}, view_.camera, kWidth, kHeight);
  EXPECT_NEAR(0.5 * (low_x + high_x), feet.x, 3.0);
  EXPECT_GE(low_y, feet.y);
  EXPECT_LE(high_y - low_y, 30);
  EXPECT_GT(bright, 20) << "letters";
  const int short_width = high_x - low_x;

  figures_[0].name = "Child with a long name";
  low_x = kWidth;
  high_x = 0;
  Differing(without, Draw(), 2, [&](int x, int) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
  });
  EXPECT_GT(high_x - low_x, short_width + 40);
  view_.name_plates = false;
  EXPECT_EQ(Differing(without, Draw(), 0), 0);
}

TEST_F(StageRendererTest, NamesOfNeighboursDoNotCoverEachOther) {
  AddSurface().name = "One whose name is long";
  AddSurface().name = "Another one whose name is long";
  figures_[1].offset_ws = {0.1, 0.0, 0.0};
  const Image both = Draw();
  int rows = 0;  // of pixels that hold bright letters
  for (int y = kHeight / 2; y < kHeight; ++y) {
    int bright = 0;
    for (int x = 0; x < kWidth; ++x) {
      const glm::ivec3 p = PixelAt(both, x, y);
      if (p.z > 150 && p.y > 150) ++bright;
    }
    if (bright > 4) ++rows;
  }
  EXPECT_GE(rows, 12) << "two lines of text";
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
}  // namespace ego
