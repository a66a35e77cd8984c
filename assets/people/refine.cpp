// SPDX-License-Identifier: MIT
#include "assets/people/refine.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ego {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::uint64_t EdgeKey(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Splits long edges once. Returns whether there were any.
bool SplitOnce(const ImplicitSurface& surface,
               const std::function<double(const Vec3&)>& longest_edge, ClosedMesh& mesh,
               std::vector<bool>& fresh) {
  constexpr std::uint32_t kWhole = 0xffffffffu;
  std::unordered_map<std::uint64_t, std::uint32_t> middle;
  middle.reserve(2 * mesh.triangles.size());
  const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, unseen] = middle.try_emplace(EdgeKey(a, b), kWhole);
    if (!unseen) return it->second;
    const Vec3 p = 0.5 * (mesh.positions[a] + mesh.positions[b]);
    const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
    if (length <= longest_edge(p)) return kWhole;
    it->second = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(DrawOnto(surface, p, 0.3 * length, 2));
    fresh.push_back(true);
    fresh[a] = fresh[b] = true;
    return it->second;
  };
  const std::size_t before = mesh.positions.size();
  std::vector<Triangle> triangles;
  triangles.reserve(2 * mesh.triangles.size());
  for (Triangle t : mesh.triangles) {
    std::array<std::uint32_t, 3> m = {middle_of(t[0], t[1]), middle_of(t[1], t[2]),
                                      middle_of(t[2], t[0])};
    const auto splits = std::count_if(m.begin(), m.end(), [](auto v) { return v != kWhole; });
    if (splits == 0) {
      triangles.push_back(t);
    } else if (splits == 3) {
      triangles.push_back({t[0], m[0], m[2]});
      triangles.push_back({m[0], t[1], m[1]});
      triangles.push_back({m[2], m[1], t[2]});
      triangles.push_back({m[0], m[1], m[2]});
    } else {
      // Turned so that the first edge is split and, of two split edges, the last is whole.
      while (m[0] == kWhole || (splits == 2 && m[2] != kWhole)) {
        std::rotate(t.begin(), t.begin() + 1, t.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      }
      if (splits == 1) {
        triangles.push_back({t[0], m[0], t[2]});
        triangles.push_back({m[0], t[1], t[2]});
      } else {
        triangles.push_back({m[0], t[1], m[1]});
        const auto distance = [&](std::uint32_t a, std::uint32_t b) {
          return glm::distance(mesh.positions[a], mesh.positions[b]);
        };
        if (distance(m[0], t[2]) <= distance(t[0], m[1])) {
          triangles.push_back({t[0], m[0], t[2]});
          triangles.push_back({m[0], m[1], t[2]});
        } else {
          triangles.push_back({t[0], m[0], m[1]});
          triangles.push_back({t[0], m[1], t[2]});
        }
      }
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh.positions.size() > before;
}

/// Moves marked vertices along the surface towards the middle of their neighbours.
void EvenOut(const ImplicitSurface& surface, const std::vector<bool>& marked, ClosedMesh& mesh) {
  std::vector<Vec3> sum(mesh.positions.size(), Vec3(0.0));
  std::vector<double> count(mesh.positions.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      sum[t[c]] += mesh.positions[t[(c + 1) % 3]];
      count[t[c]] += 1.0;
    }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!marked[v]) continue;
    const Vec3 move = 0.5 * (sum[v] / count[v] - mesh.positions[v]);
    mesh.positions[v] = DrawOnto(surface, mesh.positions[v] + move, glm::length(move) + 1e-4, 2);
  }
}

}  // namespace

void Refine(const ImplicitSurface& surface, const std::function<double(const Vec3&)>& longest_edge,
            int rounds, ClosedMesh& mesh) {
  std::vector<bool> fresh(mesh.positions.size(), false);
  for (int round = 0; round < rounds; ++round) {
    if (!SplitOnce(surface, longest_edge, mesh, fresh)) break;
    EvenOut(surface, fresh, mesh);
  }
  EvenOut(surface, fresh, mesh);
}

}  // namespace ego
