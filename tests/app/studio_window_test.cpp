// SPDX-License-Identifier: MIT
// The real window on a virtual display, driven by real key and mouse events.
#include "app/studio.h"

#include <GLFW/glfw3.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "assets/gltf/character_file.h"
#include "assets/takes/bvh.h"
#include "tests/app/virtual_display.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

using test::Do;
using test::Installed;
using test::RunUntil;
using test::VirtualDisplay;

// All that was commanded has been done and fetched.
bool Settled(Studio& studio) {
  for (int i = 0; i < 3 || studio.window().has_waiting_input(); ++i) studio.RunFrame();
  return RunUntil(studio,
                  [&] { return studio.frame().commands_done == studio.stage().commands_given(); });
}

std::size_t ColoursOnScreen(const fs::path& folder) {
  const fs::path raw = folder / "screen.rgb";
  const std::string command = "import -window root -depth 8 rgb:'" + raw.string() + "'";
  if (std::system(command.c_str()) != 0) return 0;
  std::ifstream in(raw, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::set<std::string> colours;
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3 * 17) colours.insert(bytes.substr(i, 3));
  return colours.size();
}

void WriteTake(const fs::path& path, std::size_t frames) {
  const Body body = TemplateBody(1.7);
  std::vector<Pose> poses(frames, CanonicalPose(body.skeleton));
  for (std::size_t i = 0; i < frames; ++i) {
    poses[i].rotation_ls[Index(HumanoidJoint::kLeftUpperArm)] =
        glm::angleAxis(std::sin(0.02 * static_cast<double>(i)), Vec3{0, 0, 1});
  }
  ASSERT_TRUE(WriteBvh(path, body, poses, 30.0));
}

TEST(StudioWindow, PlaysStepsScrubsAndSurvivesBadFiles) {
  for (const char* program : {"Xvfb", "xdotool", "import"}) {
    if (!Installed(program)) GTEST_SKIP() << program << " is not installed";
  }
  const VirtualDisplay display(1280, 720);
  ASSERT_TRUE(display.ready());
  const fs::path folder = fs::temp_directory_path() / "ego-studio-window-test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  constexpr std::size_t kFrames = 3001;
  WriteTake(folder / "sway.bvh", kFrames);
  ASSERT_TRUE(WriteCharacter(folder / "child.glb", *LoadDemoAvatar(0).character));
  std::ofstream(folder / "broken.glb") << "no avatar";

  Result<std::unique_ptr<Window>> window = Window::Open("Egostudio test", 1280, 720);
  ASSERT_TRUE(window) << window.error();
  Result<StageRenderer> renderer = StageRenderer::Create({});
  ASSERT_TRUE(renderer) << renderer.error();
  Studio studio(*std::move(window), *std::move(renderer));
  studio.OpenFiles({folder / "sway.bvh", folder / "child.glb"});
  ASSERT_TRUE(RunUntil(studio, [&] { return studio.frame().avatars.size() == 1; }));
  ASSERT_EQ(studio.takes().size(), 1u);
  EXPECT_TRUE(studio.frame().playing);

  // Down and up again before the window looks: neither may be lost.
  Do("key space");
  ASSERT_TRUE(Settled(studio));
  EXPECT_FALSE(studio.frame().playing);
  Do("key space key space");
  ASSERT_TRUE(Settled(studio));
  EXPECT_FALSE(studio.frame().playing);
  Do("key Home");
  Do("key Right key Right key Right key Left");
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.frame().frame, 2u);
  Do("key shift+Right");
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.frame().frame, 12u);
  Do("key End");
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.frame().frame, kFrames - 1);

  // The middle of the scrubber is the middle of the take.
  const Rect& timeline = studio.layout().timeline_panel;
  const int x = static_cast<int>(timeline.x + 0.5f * timeline.width);
  const int y = static_cast<int>(timeline.y + 0.75f * timeline.height);
  Do("mousemove " + std::to_string(x) + " " + std::to_string(y));
  ASSERT_TRUE(Settled(studio));
  Do("mousedown 1");
  ASSERT_TRUE(Settled(studio));
  Do("mouseup 1");
  ASSERT_TRUE(Settled(studio));
  EXPECT_NEAR(static_cast<double>(studio.frame().frame), 0.5 * (kFrames - 1), 10.0);

  // Orbiting turns the camera and nothing else.
  const Rect view = studio.layout().viewport;
  const double yaw = studio.camera().yaw;
  Do("mousemove " + std::to_string(static_cast<int>(view.x + 0.5f * view.width)) + " " +
     std::to_string(static_cast<int>(view.y + 0.3f * view.height)));
  ASSERT_TRUE(Settled(studio));
  Do("mousedown 1");
  ASSERT_TRUE(Settled(studio));
  Do("mousemove_relative 80 0");
  ASSERT_TRUE(Settled(studio));
  Do("mouseup 1");
  ASSERT_TRUE(Settled(studio));
  EXPECT_GT(std::abs(studio.camera().yaw - yaw), 0.05);
  EXPECT_GT(ColoursOnScreen(folder), 200u);

  // A bad file that is dropped: one sentence, everything else as it was.
  const std::string broken = (folder / "broken.glb").string();
  const char* paths[] = {broken.c_str()};
  const GLFWdropfun dropped = glfwSetDropCallback(studio.window().handle(), nullptr);
  ASSERT_NE(dropped, nullptr);
  glfwSetDropCallback(studio.window().handle(), dropped);
  const std::size_t frame_before = studio.frame().frame;
  dropped(studio.window().handle(), 1, paths);
  studio.OpenFiles(studio.window().dropped());
  ASSERT_TRUE(RunUntil(studio, [&] { return !studio.errors().empty(); }));
  EXPECT_NE(studio.errors().front().find("broken.glb"), std::string::npos);

  // A second one stands beside the first, and neither goes when something is done well.
  studio.OpenFiles({folder / "absent.c3d"});
  ASSERT_TRUE(RunUntil(studio, [&] { return studio.errors().size() == 2; }));
  studio.Say(Message::Kind::kInfo, "Opened something.");
  ASSERT_TRUE(Settled(studio));
  EXPECT_NE(studio.errors().front().find("broken.glb"), std::string::npos);
  EXPECT_NE(studio.errors().back().find("absent.c3d"), std::string::npos);
  EXPECT_EQ(studio.takes().size(), 1u);
  EXPECT_EQ(studio.avatars().size(), 1u);
  EXPECT_EQ(studio.frame().frame, frame_before);

  // Removing is undone.
  studio.RemoveAvatar(studio.avatars().front().id);
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.frame().avatars.size(), 0u);
  Do("key ctrl+z");
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.frame().avatars.size(), 1u);

  Do("key Tab");
  ASSERT_TRUE(Settled(studio));
  EXPECT_EQ(studio.layout().viewport.width, 1280.0f);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ego
