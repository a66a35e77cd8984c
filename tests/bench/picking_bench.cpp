// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <memory>
#include <utility>

#include "assets/mesh/surface_mesh.h"
#include "assets/motions/motions.h"
#include "core/model/mesh_picker.h"

namespace ego::test {
namespace {

/// Every triangle in four, its new corners half-way between the old ones.
void Subdivide(MeshPart& part) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
  std::vector<std::uint32_t> finer;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] = middle_of.try_emplace(
        {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(part.positions.size()));
    if (fresh) {
      part.positions.push_back(0.5f * (part.positions[a] + part.positions[b]));
      part.influences.push_back(part.influences[a]);
      if (!part.normals.empty()) part.normals.push_back(part.normals[a]);
      if (!part.uvs.empty()) part.uvs.push_back(part.uvs[a]);
    }
    return at->second;
  };
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const std::array<std::uint32_t, 3> v = {part.triangles[t], part.triangles[t + 1],
                                            part.triangles[t + 2]};
    const std::array<std::uint32_t, 3> m = {middle(v[0], v[1]), middle(v[1], v[2]),
                                            middle(v[2], v[0])};
    finer.insert(finer.end(),
                 {v[0], m[0], m[2], m[0], v[1], m[1], m[2], m[1], v[2], m[0], m[1], m[2]});
  }
  part.triangles = std::move(finer);
}

std::size_t TriangleCount(const Character& character) {
  std::size_t count = 0;
  for (const MeshPart& part : character.parts) count += part.triangles.size() / 3;
  return count;
}

/// The performer in at least 100 000 triangles.
const std::shared_ptr<const Character>& FinePerson() {
  static const auto kPerson = [] {
    Character person = ScriptedPerformer().character;
    while (TriangleCount(person) < 100000) {
      for (MeshPart& part : person.parts) Subdivide(part);
    }
    return std::make_shared<const Character>(std::move(person));
  }();
  return kPerson;
}

ModelPose Bent(double angle) {
  const Skeleton& skeleton = FinePerson()->rig.skeleton;
  Pose pose = CanonicalPose(skeleton);
  for (Quat& q : pose.rotation_ls) q = glm::angleAxis(angle, Vec3{0.6, 0.0, 0.8});
  return ForwardKinematics(skeleton, pose);
}

PickCone CursorAt(std::size_t i) {
  const double x = 0.1 * static_cast<double>(i % 7) - 0.3;
  const double y = 0.7 + 0.15 * static_cast<double>(i % 6);
  PickCone cone{{0.0, 1.2, 3.0}, {}, 0.0, 0.01};
  cone.direction = glm::normalize(Vec3{x, y, 0.0} - cone.origin_ws);
  return cone;
}

/// A frame of picking: the pose has changed, the cursor moved.
void PickFrame(benchmark::State& state) {
  MeshPicker picker(FinePerson());
  std::size_t i = 0;
  for (auto _ : state) {
    picker.SetPose(Bent(0.02 * static_cast<double>(i % 20)));
    benchmark::DoNotOptimize(picker.NearestVertex(CursorAt(i++)));
  }
  state.counters["triangles"] = static_cast<double>(TriangleCount(*FinePerson()));
}

/// The cursor moved, the pose stayed.
void PickVertex(benchmark::State& state) {
  MeshPicker picker(FinePerson());
  picker.SetPose(Bent(0.2));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(picker.NearestVertex(CursorAt(i++)));
}

void PickRay(benchmark::State& state) {
  MeshPicker picker(FinePerson());
  picker.SetPose(Bent(0.2));
  std::size_t i = 0;
  for (auto _ : state) {
    const PickCone cone = CursorAt(i++);
    benchmark::DoNotOptimize(picker.Pick(cone.origin_ws, cone.direction));
  }
}

/// One step of a drag, one look for a mirror vertex, one ring.
void SurfaceEdits(benchmark::State& state) {
  const SurfaceMesh surface(*FinePerson());
  const PosedMesh posed = CanonicalMesh(*FinePerson());
  MeshPoint place = surface.PlaceOf(*surface.Nearest({0.0, 1.1, 0.2}));
  for (auto _ : state) {
    place = surface.Walk(place, {0.001, 0.0, 0.0}, posed);
    benchmark::DoNotOptimize(surface.MirrorOf(surface.PlaceOf(*surface.VertexAt(place)), 0.01));
    benchmark::DoNotOptimize(surface.Ring(LimbSegment::kLeftThigh, 0.5));
  }
}

BENCHMARK(PickFrame)->Unit(benchmark::kMillisecond);
BENCHMARK(PickVertex)->Unit(benchmark::kMicrosecond);
BENCHMARK(PickRay)->Unit(benchmark::kMicrosecond);
BENCHMARK(SurfaceEdits)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ego::test
