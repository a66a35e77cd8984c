// SPDX-License-Identifier: MIT
#include "app/remembered.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "app/view/contact_glows.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

class RememberedFile : public testing::Test {
 protected:
  void SetUp() override {
    // Tests run side by side: each has a folder of its own.
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("ego-remembered-") + test->name());
    fs::remove_all(folder_);
    path_ = folder_ / "deep" / "window.json";
  }
  void TearDown() override { fs::remove_all(folder_); }
  void Write(const char* text) {
    fs::create_directories(path_.parent_path());
    std::ofstream(path_) << text;
  }
  fs::path folder_, path_;
};

TEST_F(RememberedFile, ComesBackAsItWasWritten) {
  Remembered was;
  was.window_width = 1234;
  was.window_height = 777;
  was.layout.left = 301.5f;
  was.layout.show_right = false;
  was.overlays.crude = true;
  was.overlays.contacts = false;
  was.overlays.true_sizes = true;
  ASSERT_TRUE(WriteRemembered(path_, was));
  const Result<Remembered> is = ReadRemembered(path_);
  ASSERT_TRUE(is) << is.error();
  EXPECT_EQ(is->window_width, 1234);
  EXPECT_EQ(is->window_height, 777);
  EXPECT_EQ(is->layout.left, 301.5f);
  EXPECT_TRUE(is->layout.show_left);
  EXPECT_FALSE(is->layout.show_right);
  EXPECT_TRUE(is->overlays.crude);
  EXPECT_FALSE(is->overlays.contacts);
  EXPECT_TRUE(is->overlays.true_sizes);
}

TEST_F(RememberedFile, NoneGivesTheDefaultsAndADamagedOneASentence) {
  const Result<Remembered> none = ReadRemembered(path_);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->window_width, Remembered{}.window_width);
  for (const char* damaged : {"", "{\"width\": 12", "[1, 2]", "\xff\xfe"}) {
    Write(damaged);
    const Result<Remembered> read = ReadRemembered(path_);
    ASSERT_FALSE(read) << damaged;
    EXPECT_NE(read.error().find("window.json"), std::string::npos);
  }
}

TEST_F(RememberedFile, ValuesOfOtherKindsAndBeyondSenseDoNoHarm) {
  Write("{\"width\": 1e300, \"height\": -5, \"left\": \"wide\", \"right\": -1e300, \"names\": 3}");
  const Result<Remembered> read = ReadRemembered(path_);
  ASSERT_TRUE(read) << read.error();
  EXPECT_LE(read->window_width, 16384);
  EXPECT_GE(read->window_height, 400);
  EXPECT_EQ(read->layout.left, Remembered{}.layout.left);
  EXPECT_GE(read->layout.right, 0.0f);
  EXPECT_TRUE(read->overlays.names);
}

TEST(ContactGlows, GlowWhereTheHandTouchesAndNowhereElse) {
  EXPECT_EQ(GlowStrength(-0.01, 1.8), 1.0);
  EXPECT_EQ(GlowStrength(0.05, 1.8), 0.0);
  const double half = GlowStrength(0.018, 1.8);
  EXPECT_GT(half, 0.0);
  EXPECT_LT(half, 1.0);

  const Body body = TemplateBody();
  std::vector<ContactGlow> glows;
  Pose pose = CanonicalPose(body.skeleton);
  AppendContactGlows(body, pose, 1.0, glows);
  EXPECT_TRUE(glows.empty());
  // Both arms swung to the front until the palms are where the other's are.
  pose.rotation_ls[Index(HumanoidJoint::kLeftUpperArm)] =
      glm::angleAxis(-kPi / 2.0 - 0.32, Vec3{0.0, 1.0, 0.0});
  pose.rotation_ls[Index(HumanoidJoint::kRightUpperArm)] =
      glm::angleAxis(kPi / 2.0 + 0.32, Vec3{0.0, 1.0, 0.0});
  AppendContactGlows(body, pose, 2.0, glows);
  ASSERT_FALSE(glows.empty());
  for (const ContactGlow& glow : glows) {
    EXPECT_LT(std::abs(glow.position_ws.x), 0.2 * body.height);
    EXPECT_GT(glow.position_ws.z, 0.5 * body.height);  // shown at twice its size
    EXPECT_GT(glow.strength, 0.0f);
  }
}

}  // namespace
}  // namespace ego
