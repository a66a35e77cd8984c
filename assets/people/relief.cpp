// SPDX-License-Identifier: MIT
#include "assets/people/relief.h"

#include <algorithm>
#include <queue>
#include <unordered_map>
#include <utility>

#include "assets/people/field.h"
#include "assets/people/figure_builder.h"

namespace ego {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr double kNoStep = 2e-5;  // metres: lower steps are none

std::uint64_t Directed(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// How far each vertex of each region is lifted: zero except near borders.
class Lifts {
 public:
  Lifts(const ClosedMesh& mesh, std::span<const Region> regions, const LiftBeside& lift)
      : count_(mesh.positions.size()), value_(kRegionCount * count_, 0.0) {
    std::unordered_map<std::uint64_t, Region> owner;
    owner.reserve(4 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        owner[Directed(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3])] = regions[t];
      }
    }
    std::vector<std::vector<std::uint32_t>> neighbours(count_);
    std::vector<std::vector<Source>> sources(kRegionCount);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = mesh.triangles[t][c];
        const std::uint32_t b = mesh.triangles[t][(c + 1) % 3];
        neighbours[a].push_back(b);
        const auto other = owner.find(Directed(b, a));
        if (other == owner.end() || other->second == regions[t]) continue;
        const Lift step = lift(regions[t], other->second);
        if (step.height <= 0.0) continue;
        sources[static_cast<std::size_t>(regions[t])].push_back({a, step});
        sources[static_cast<std::size_t>(regions[t])].push_back({b, step});
      }
    }
    std::vector<std::vector<bool>> member(kRegionCount, std::vector<bool>(count_, false));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        member[static_cast<std::size_t>(regions[t])][v] = true;
      }
    }
    for (std::size_t r = 0; r < kRegionCount; ++r) {
      Spread(mesh, neighbours, sources[r], member[r], r);
    }
  }

  double operator()(Region region, std::uint32_t vertex) const {
    return value_[static_cast<std::size_t>(region) * count_ + vertex];
  }

 private:
  struct Source {
    std::uint32_t vertex;
    Lift lift;
  };

  /// Dijkstra's shortest ways from the borders through the region.
  void Spread(const ClosedMesh& mesh, const std::vector<std::vector<std::uint32_t>>& neighbours,
              const std::vector<Source>& sources, const std::vector<bool>& member, std::size_t r) {
    struct Front {
      double distance;
      std::uint32_t vertex;
      Lift lift;
      bool operator<(const Front& other) const {
        return distance != other.distance ? distance > other.distance : vertex > other.vertex;
      }
    };
    std::priority_queue<Front> queue;
    for (const Source& source : sources) queue.push({0.0, source.vertex, source.lift});
    std::vector<double> reached(count_, 1e9);
    while (!queue.empty()) {
      const Front front = queue.top();
      queue.pop();
      double& value = value_[r * count_ + front.vertex];
      const double here =
          front.lift.height * (front.lift.fade > 0.0
                                   ? 1.0 - field::SmoothStep(0.0, front.lift.fade, front.distance)
                                   : 1.0);
      value = std::max(value, here);
      if (front.distance >= reached[front.vertex]) continue;
      reached[front.vertex] = front.distance;
      if (front.lift.fade > 0.0 && front.distance > front.lift.fade) continue;
      for (const std::uint32_t next : neighbours[front.vertex]) {
        const double distance =
            front.distance + glm::distance(mesh.positions[front.vertex], mesh.positions[next]);
        if (member[next] && distance < reached[next]) queue.push({distance, next, front.lift});
      }
    }
  }

  std::size_t count_;
  std::vector<double> value_;
};

/// The copies of one vertex at different heights, lowest first.
struct Level {
  double height;
  std::uint32_t vertex;
};

Vec3 Direction(Region region, const Vec3& normal) {
  if (region != Region::kSoles) return normal;
  const Vec3 level{normal.x, 0.0, normal.z};
  return level * field::SmoothStep(0.2, 0.7, glm::length(level));
}

}  // namespace

ReliefMesh Relieve(const ClosedMesh& mesh, std::span<const Region> regions,
                   std::span<const Vec3> normals, const LiftBeside& lift) {
  const Lifts lifts(mesh, regions, lift);
  ReliefMesh relief;
  std::vector<std::vector<Level>> levels(mesh.positions.size());
  const auto copy_of = [&](std::uint32_t v, Region region) {
    const double height = lifts(region, v);
    std::vector<Level>& of = levels[v];
    for (const Level& level : of) {
      if (std::abs(level.height - height) < kNoStep) return level.vertex;
    }
    const auto index = static_cast<std::uint32_t>(relief.source.size());
    relief.mesh.positions.push_back(mesh.positions[v] + height * Direction(region, normals[v]));
    relief.source.push_back(v);
    const auto place = std::find_if(of.begin(), of.end(),
                                    [&](const Level& level) { return level.height > height; });
    of.insert(place, {height, index});
    return index;
  };

  std::unordered_map<std::uint64_t, std::size_t> owner;
  owner.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle copy{};
    for (std::size_t c = 0; c < 3; ++c) {
      copy[c] = copy_of(mesh.triangles[t][c], regions[t]);
      owner[Directed(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3])] = t;
    }
    relief.mesh.triangles.push_back(copy);
    relief.regions.push_back(regions[t]);
  }
  relief.step.assign(relief.mesh.triangles.size(), false);

  // Shading follows the plain surface; what the lift bends is added.
  const std::vector<Vec3> plain = VertexNormals(mesh);
  const std::vector<Vec3> lifted = VertexNormals(relief.mesh);
  for (std::size_t v = 0; v < relief.source.size(); ++v) {
    const std::uint32_t from = relief.source[v];
    const Vec3 n = normals[from] + lifted[v] - plain[from];
    relief.normals.push_back(glm::length(n) > 1e-6 ? glm::normalize(n) : normals[from]);
  }

  // The steps: from one side's height to the other's, through every height between.
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, Region region) {
    relief.mesh.triangles.push_back({a, b, c});
    relief.regions.push_back(region);
    relief.step.push_back(true);
  };
  const auto rungs = [&](std::uint32_t v, double from, double to) {
    std::vector<std::uint32_t> between;
    for (const Level& level : levels[v]) {
      if (level.height > std::min(from, to) - kNoStep &&
          level.height < std::max(from, to) + kNoStep) {
        between.push_back(level.vertex);
      }
    }
    if (from > to) std::reverse(between.begin(), between.end());
    return between;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.triangles[t][c];
      const std::uint32_t b = mesh.triangles[t][(c + 1) % 3];
      const Region here = regions[t];
      const auto across = owner.find(Directed(b, a));
      if (across == owner.end()) continue;
      const Region there = regions[across->second];
      if (here >= there) continue;  // each border edge once
      const auto at_a = rungs(a, lifts(here, a), lifts(there, a));
      const auto at_b = rungs(b, lifts(here, b), lifts(there, b));
      const bool higher = lifts(here, a) + lifts(here, b) > lifts(there, a) + lifts(there, b);
      const Region region = higher ? here : there;
      // Seen from outside, this side's edge runs from b to a.
      std::size_t i = 0;
      std::size_t k = 0;
      while (i + 1 < at_a.size() || k + 1 < at_b.size()) {
        const bool along_a = k + 1 >= at_b.size() || (i + 1 < at_a.size() && i <= k);
        if (along_a) {
          add(at_b[k], at_a[i], at_a[i + 1], region);
          ++i;
        } else {
          add(at_b[k], at_a[i], at_b[k + 1], region);
          ++k;
        }
      }
    }
  }
  return relief;
}

}  // namespace ego
