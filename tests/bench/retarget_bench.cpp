// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <string>

#include "core/baselines/retarget_method.h"
#include "tests/support/bodies.h"
#include "tests/support/postures.h"

namespace ego::test {
namespace {

const std::vector<Pose>& Frames() {
  static const std::vector<Pose> kFrames = [] {
    std::vector<Pose> all = Motion(TemplateBody(), "hands on belly");
    for (const Pose& pose : Motion(TemplateBody(), "walk")) all.push_back(pose);
    return all;
  }();
  return kFrames;
}

/// One performer frame.
void Normalise(benchmark::State& state, const std::string& name) {
  const Body performer = TemplateBody();
  const auto method = MakeRetargetMethod(name);
  std::size_t frame = 0;
  for (auto _ : state) {
    method->SetPerformerPose(performer, Frames()[frame++ % Frames().size()]);
  }
}

/// One avatar frame in all: normalisation and adaptation.
void OneAvatar(benchmark::State& state, const std::string& name) {
  const Body performer = TemplateBody();
  const Body avatar = Child();
  const auto method = MakeRetargetMethod(name);
  Pose out;
  std::size_t frame = 0;
  for (auto _ : state) {
    method->SetPerformerPose(performer, Frames()[frame++ % Frames().size()]);
    method->Adapt(avatar, out);
    benchmark::DoNotOptimize(out);
  }
}

BENCHMARK_CAPTURE(Normalise, mdb, "mdb")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Normalise, paper, "paper")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, mdb, "mdb")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, paper, "paper")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(OneAvatar, copy, "copy")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ego::test
