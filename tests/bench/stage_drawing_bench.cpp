// SPDX-License-Identifier: MIT
// What a picture of the demo costs: performer, skeleton and five avatars, 1280 x 720, without a
// window. Where the driver draws on the processor, only CPU time over all threads tells.
#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "app/loading/load_avatar.h"
#include "app/loading/load_take.h"
#include "app/stage/frame_maker.h"
#include "app/view/stage_picture.h"
#include "render/gl/surface.h"
#include "render/offscreen.h"

namespace ego {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr std::size_t kAvatars = 5;

struct Demo {
  OffscreenContext context;
  StagePicture picture;
  FrameMaker maker;
  StageFrame frame;
  Camera camera;
  gl::ColorTarget target;

  explicit Demo(OffscreenContext made, StageRenderer renderer)
      : context(std::move(made)), picture(std::move(renderer)) {
    auto scene = std::make_shared<StageScene>();
    scene->motion = LoadMotion()->motion;
    std::vector<StageMember> members;
    for (std::size_t i = 0; i < kAvatars; ++i) {
      const LoadedAvatar avatar = LoadDemoAvatar(i);
      scene->avatars.push_back({i + 1, avatar.body});
      members.push_back({i + 1, avatar.name, look::AvatarColor(i), true, avatar.character});
    }
    picture.SetMembers(std::move(members));
    maker.SetScene(std::move(scene));
    maker.Make(maker.frame_count() / 2, frame);
    picture.Arrange(frame, {});
    camera.yaw += picture.heading();
    Box3 box = picture.Bounds();
    MakeRoomForNames(box);
    camera.Frame(box, {kWidth, kHeight}, 0.06);
    target.Resize(kWidth, kHeight, 0);
  }

  static Demo* Get() {
    static std::optional<Demo> demo;
    if (!demo) {
      Result<OffscreenContext> context = OffscreenContext::Create();
      if (!context) return nullptr;
      Result<StageRenderer> renderer = StageRenderer::Create({.font = {}, .coarseness = 0.5f});
      if (!renderer) return nullptr;
      demo.emplace(*std::move(context), *std::move(renderer));
    }
    return &*demo;
  }
};

enum class Without { kNothing, kShadows, kGrid, kNames, kBodies, kPerformer, kAll };

void DrawStage(benchmark::State& state, Without without, int samples) {
  Demo* demo = Demo::Get();
  if (demo == nullptr) {
    state.SkipWithError("no OpenGL context");
    return;
  }
  demo->picture.renderer().SetSamples(samples);
  Overlays overlays;
  StageView view;
  const bool all = without == Without::kAll;
  view.shadows = without != Without::kShadows;
  view.grid = without != Without::kGrid && !all;
  overlays.names = without != Without::kNames;
  if (without == Without::kPerformer) {
    overlays.surface = overlays.skeleton = overlays.markers = false;
  }
  std::size_t at = 0;
  for (auto _ : state) {
    at = (at + 7) % demo->maker.frame_count();
    demo->maker.Make(at, demo->frame);
    view.figures = demo->picture.Arrange(demo->frame, overlays);
    if (without == Without::kBodies || all) view.figures = {};
    view.camera = demo->camera;
    view.camera.target_ws += demo->picture.anchor();
    view.name_plates = overlays.names;
    demo->picture.renderer().Draw(view, {demo->target.Name(), 0, 0, kWidth, kHeight, 1.0f});
    glFinish();
  }
}

#define EGO_DRAWING(name, without, samples)            \
  BENCHMARK_CAPTURE(DrawStage, name, without, samples) \
      ->MeasureProcessCPUTime()                        \
      ->Unit(benchmark::kMillisecond)

EGO_DRAWING(everything, Without::kNothing, 0);
EGO_DRAWING(everything_multisampled, Without::kNothing, 4);
EGO_DRAWING(without_shadows, Without::kShadows, 0);
EGO_DRAWING(without_floor, Without::kGrid, 0);
EGO_DRAWING(without_names, Without::kNames, 0);
EGO_DRAWING(without_performer_and_skeleton, Without::kPerformer, 0);
EGO_DRAWING(without_figures, Without::kBodies, 0);
EGO_DRAWING(empty_room, Without::kAll, 0);

void AdaptStage(benchmark::State& state) {
  Demo* demo = Demo::Get();
  if (demo == nullptr) {
    state.SkipWithError("no OpenGL context");
    return;
  }
  std::size_t at = 0;
  for (auto _ : state) {
    at = (at + 7) % demo->maker.frame_count();
    demo->maker.Make(at, demo->frame);
    benchmark::DoNotOptimize(demo->picture.Arrange(demo->frame, {}));
  }
}
BENCHMARK(AdaptStage)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ego
