// SPDX-License-Identifier: MIT
// What stands on the stage appears where and as it should.
#include <array>
#include <optional>

#include "tests/render/stage_picture_fixture.h"

namespace ego::test {
namespace {

using J = HumanoidJoint;
class StageFiguresTest : public StagePictureTest {};

TEST_F(StageFiguresTest, ACharacterAppearsWhereTheCameraProjectsIt) {
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

TEST_F(StageFiguresTest, UnknownCharactersAndWrongNodesDrawNothing) {
  const CharacterId id = renderer_->Load(RedPerson());
  const Image empty = Draw();
  figures_.emplace_back().character = CharacterPart{CharacterId{999}, nodes_};
  figures_.emplace_back().character = CharacterPart{id, std::span(nodes_).first(3)};
  EXPECT_EQ(Differing(empty, Draw(), 0), 0);
  renderer_->Unload(id);
  renderer_->Unload(CharacterId{999});
}

TEST_F(StageFiguresTest, ACharacterWithWrongIndicesLosesThePartOnly) {
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

TEST_F(StageFiguresTest, AMirroredCharacterShowsItsOutside) {
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

TEST_F(StageFiguresTest, TexturesColourTheCharacterAndMasksCutHoles) {
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

TEST_F(StageFiguresTest, MarkersAppearAndInvisibleOnesAreAbsent) {
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

TEST_F(StageFiguresTest, SkeletonIsOffWhiteAtItsJoints) {
  figures_.emplace_back().skeleton = SkeletonPart{&body_.skeleton, &pose_};
  const Image image = Draw();
  for (const J joint : {J::kHips, J::kLeftLowerArm, J::kRightLowerLeg, J::kNeck}) {
    const glm::ivec3 p = PixelAt(image, pose_.Position(joint), view_.camera);
    EXPECT_GT(std::min({p.x, p.y, p.z}), 110) << Name(joint);
    EXPECT_LT(std::max({p.x, p.y, p.z}) - std::min({p.x, p.y, p.z}), 40) << Name(joint);
  }
}

TEST_F(StageFiguresTest, SurfaceIsAmberAndHasAllItsLimbs) {
  AddSurface();
  const Image image = Draw();
  for (const J joint : {J::kChest, J::kLeftLowerArm, J::kRightHand, J::kLeftLowerLeg, J::kHead}) {
    EXPECT_TRUE(IsAmber(PixelAt(image, pose_.Position(joint), view_.camera))) << Name(joint);
  }
}

TEST_F(StageFiguresTest, WhatIsInsideShowsThroughATranslucentSurface) {
  AddSurface(1.0f).skeleton = SkeletonPart{&body_.skeleton, &pose_};
  const glm::ivec3 hidden = PixelAt(Draw(), pose_.Position(J::kChest), view_.camera);
  figures_[0].surface->opacity = 0.4f;
  const glm::ivec3 seen = PixelAt(Draw(), pose_.Position(J::kChest), view_.camera);
  EXPECT_GT(seen.z, hidden.z + 30) << "white bone behind amber";
}

TEST_F(StageFiguresTest, AnOverlayIsDrawnOverWhatHidesIt) {
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

TEST_F(StageFiguresTest, ContactsGlow) {
  AddSurface();
  const Image without = Draw();
  const ContactGlow glow{pose_.Position(J::kHips)};
  figures_[0].contacts = std::span(&glow, 1);
  const Image with = Draw();
  EXPECT_GT(PixelAt(with, glow.position_ws, view_.camera).y,
            PixelAt(without, glow.position_ws, view_.camera).y + 40);
}

TEST_F(StageFiguresTest, NamePlateStandsAtTheFeet) {
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

TEST_F(StageFiguresTest, NamesOfNeighboursDoNotCoverEachOther) {
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

}  // namespace
}  // namespace ego::test
