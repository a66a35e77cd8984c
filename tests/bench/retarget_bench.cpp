// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/baselines/retarget_method.h"
#include "tests/support/bodies.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

const std::vector<Pose>& Frames() {
  static const std::vector<Pose> kFrames = [] {
    std::vector<Pose> all = Motion("hands_clasped").poses;
    all.insert(all.end(), Motion("walk").poses.begin(), Motion("walk").poses.end());
    return all;
  }();
  return kFrames;
}

/// One performer frame.
void Normalise(benchmark::State& state, const std::string& name) {
  const Body& performer = StudioPerformer();
  const auto method = MakeRetargetMethod(name);
  std::size_t frame = 0;
  for (auto _ : state) {
    method->SetPerformerPose(performer, Frames()[frame++ % Frames().size()]);
  }
}

/// One avatar frame in all: normalisation and adaptation.
void OneAvatar(benchmark::State& state, const std::string& name) {
  const Body& performer = StudioPerformer();
  const Body& avatar = StudioBody("Child");
  const auto method = MakeRetargetMethod(name);
  Pose out;
  std::size_t frame = 0;
  for (auto _ : state) {
    method->SetPerformerPose(performer, Frames()[frame++ % Frames().size()]);
    method->Adapt(avatar, out);
    benchmark::DoNotOptimize(out);
  }
}

/// A crowd: one normalisation, twelve avatars of all shapes. Items are avatar frames.
void Crowd(benchmark::State& state, const std::string& name) {
  constexpr std::size_t kAvatars = 12;
  const Body& performer = StudioPerformer();
  std::vector<Body> avatars = StudyBodies();
  avatars.push_back(PoorRig());
  const auto method = MakeRetargetMethod(name);
  std::array<Pose, kAvatars> out;
  std::size_t frame = 0;
  for (auto _ : state) {
    method->SetPerformerPose(performer, Frames()[frame++ % Frames().size()]);
    for (std::size_t k = 0; k < kAvatars; ++k) method->Adapt(avatars[k % avatars.size()], out[k]);
    benchmark::DoNotOptimize(out);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kAvatars) * state.iterations());
}

/// Forward kinematics alone: what the others are multiples of, on any machine.
void PlainForwardKinematics(benchmark::State& state) {
  const Body& performer = StudioPerformer();
  std::size_t frame = 0;
  for (auto _ : state) {
    const ModelPose posed =
        ForwardKinematics(performer.skeleton, Frames()[frame++ % Frames().size()]);
    benchmark::DoNotOptimize(posed);
  }
}

BENCHMARK(PlainForwardKinematics)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Crowd, mdb, "mdb")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Normalise, mdb, "mdb")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Normalise, paper, "paper")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, mdb, "mdb")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, paper, "paper")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, copy, "copy")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ego::test
