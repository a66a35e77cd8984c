// SPDX-License-Identifier: MIT
#include "app/stage/stage_thread.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

namespace ego {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const CapturedMotion> Swaying(std::size_t frames, double rate_hz) {
  auto motion = std::make_shared<CapturedMotion>();
  motion->name = "swaying";
  motion->performer = TemplateBody();
  motion->rate_hz = rate_hz;
  for (std::size_t i = 0; i < frames; ++i) {
    Pose pose = CanonicalPose(motion->performer.skeleton);
    const double a = 0.8 * std::sin(0.1 * static_cast<double>(i));
    pose.root_ws.x += 0.01 * static_cast<double>(i);
    pose.rotation_ls[Index(HumanoidJoint::kLeftUpperArm)] = glm::angleAxis(a, Vec3{0, 0, 1});
    pose.rotation_ls[Index(HumanoidJoint::kRightLowerArm)] = glm::angleAxis(1.0 + a, Vec3{0, 1, 0});
    motion->poses.push_back(pose);
  }
  return motion;
}

std::shared_ptr<const StageScene> SceneOf(std::shared_ptr<const CapturedMotion> motion) {
  auto scene = std::make_shared<StageScene>();
  scene->motion = std::move(motion);
  scene->avatars.push_back({7, std::make_shared<Body>(TemplateBody(1.2))});
  scene->avatars.push_back({9, std::make_shared<Body>(TemplateBody(2.3))});
  return scene;
}

// Waits for a frame that satisfies `wanted`; the limit only ends a test that would never end.
bool FetchUntil(StageThread& stage, const std::function<bool(const StageFrame&)>& wanted) {
  const auto limit = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < limit) {
    if (stage.Fetch() && wanted(stage.frame())) return true;
    std::this_thread::sleep_for(200us);
  }
  return false;
}

bool FetchAllDone(StageThread& stage) {
  return FetchUntil(stage,
                    [&](const StageFrame& f) { return f.commands_done == stage.commands_given(); });
}

bool BitEqual(const Pose& a, const Pose& b) {
  return std::memcmp(&a.root_ws, &b.root_ws, sizeof(a.root_ws)) == 0 &&
         std::memcmp(a.rotation_ls.data(), b.rotation_ls.data(), sizeof(a.rotation_ls)) == 0;
}

void ExpectAsAdaptedDirectly(const StageFrame& frame, std::string_view method_name) {
  const StageScene& scene = *frame.scene;
  const std::unique_ptr<RetargetMethod> method = MakeRetargetMethod(method_name);
  method->SetPerformerPose(scene.motion->performer, scene.motion->poses[frame.frame]);
  ASSERT_EQ(frame.avatars.size(), scene.avatars.size());
  for (std::size_t i = 0; i < scene.avatars.size(); ++i) {
    Pose expected;
    method->Adapt(*scene.avatars[i].body, expected);
    EXPECT_TRUE(BitEqual(frame.avatars[i].pose, expected)) << "avatar " << i;
  }
  EXPECT_TRUE(BitEqual(frame.performer_pose, scene.motion->poses[frame.frame]));
}

TEST(StageThread, SeekAndStepGiveExactlyThatFrame) {
  StageThread stage;
  stage.SetScene(SceneOf(Swaying(300, 120.0)));
  for (const std::size_t wanted : {0u, 17u, 299u, 5u}) {
    stage.Seek(wanted);
    ASSERT_TRUE(FetchAllDone(stage));
    EXPECT_EQ(stage.frame().frame, wanted);
    EXPECT_FALSE(stage.frame().playing);
    ExpectAsAdaptedDirectly(stage.frame(), "mdb");
  }
  stage.Step(1);
  stage.Step(1);
  stage.Step(-3);
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_EQ(stage.frame().frame, 4u);
  stage.Seek(100000);
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_EQ(stage.frame().frame, 299u);
}

TEST(StageThread, PausedMeansNothingNewIsMade) {
  StageThread stage;
  stage.SetScene(SceneOf(Swaying(300, 240.0)));
  stage.Play(true);
  ASSERT_TRUE(FetchUntil(stage, [](const StageFrame& f) { return f.frame > 3; }));
  stage.Play(false);
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_FALSE(stage.frame().playing);
  const std::uint64_t sequence = stage.frame().sequence;
  std::this_thread::sleep_for(30ms);
  EXPECT_FALSE(stage.Fetch());
  EXPECT_EQ(stage.frame().sequence, sequence);
}

TEST(StageThread, EveryFrameShownWhilePlayingIsTheDirectResult) {
  StageThread stage;
  stage.SetScene(SceneOf(Swaying(40, 500.0)));
  stage.SetSpeed(4.0);
  stage.Play(true);
  std::uint64_t last = 0;
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(
        FetchUntil(stage, [&](const StageFrame& f) { return f.scene && f.sequence > last; }));
    last = stage.frame().sequence;
    ExpectAsAdaptedDirectly(stage.frame(), "mdb");
  }
}

TEST(StageThread, WithoutALoopItStopsOnTheLastFrame) {
  StageThread stage;
  stage.SetLoop(false);
  stage.SetScene(SceneOf(Swaying(20, 200.0)));
  stage.Play(true);
  ASSERT_TRUE(FetchUntil(stage, [](const StageFrame& f) { return f.frame == 19 && !f.playing; }));
}

TEST(StageThread, AnotherMethodTakesEffectOnTheFrameShown) {
  StageThread stage;
  stage.SetScene(SceneOf(Swaying(300, 120.0)));
  stage.Seek(40);
  stage.SetMethod("copy");
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_EQ(stage.frame().frame, 40u);
  ExpectAsAdaptedDirectly(stage.frame(), "copy");
}

TEST(StageThread, OtherAvatarsKeepThePlaceAndAnotherTakeBeginsAnew) {
  StageThread stage;
  const auto motion = Swaying(300, 120.0);
  stage.SetScene(SceneOf(motion));
  stage.Seek(123);
  auto fewer = std::make_shared<StageScene>(*SceneOf(motion));
  fewer->avatars.pop_back();
  stage.SetScene(fewer);
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_EQ(stage.frame().frame, 123u);
  EXPECT_EQ(stage.frame().scene, fewer);
  EXPECT_EQ(stage.frame().avatars.size(), 1u);
  stage.SetScene(SceneOf(Swaying(30, 60.0)));
  ASSERT_TRUE(FetchAllDone(stage));
  EXPECT_EQ(stage.frame().frame, 0u);
  EXPECT_EQ(stage.frame().avatars.size(), 2u);
}

TEST(StageThread, EndsAtOnceWhateverItDoes) {
  for (int i = 0; i < 20; ++i) {
    StageThread stage;
    if (i % 2) stage.SetScene(SceneOf(Swaying(1000, 1000.0)));
    if (i % 3) stage.Play(true);
  }
}

TEST(FrameMaker, MarkersCarryTheFloorOffset) {
  auto motion = std::make_shared<CapturedMotion>(*Swaying(2, 100.0));
  auto take = std::make_shared<MarkerTake>();
  take->labels = {"A", "B"};
  take->rate_hz = 100.0;
  take->frame_count = 2;
  take->position_ws = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 1, 2}};
  take->visible = {1, 0, 1, 1};
  motion->markers = take;
  motion->floor_offset = 0.25;
  auto scene = std::make_shared<StageScene>();
  scene->motion = motion;
  FrameMaker maker;
  maker.SetScene(scene);
  StageFrame frame;
  maker.Make(1, frame);
  ASSERT_EQ(frame.marker_ws.size(), 2u);
  EXPECT_EQ(frame.marker_ws[0], Vec3(7, 8.25, 9));
  EXPECT_EQ(frame.marker_ws[1], Vec3(0, 1.25, 2));
  maker.Make(0, frame);
  EXPECT_EQ(frame.marker_visible[1], 0);
}

TEST(FrameMaker, AnUnknownMethodChangesNothing) {
  FrameMaker maker;
  EXPECT_FALSE(maker.SetMethod("guess"));
  EXPECT_EQ(maker.method_name(), RetargetMethodNames().front());
}

}  // namespace
}  // namespace ego
