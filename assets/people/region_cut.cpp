// SPDX-License-Identifier: MIT
#include "assets/people/region_cut.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ego {

std::vector<Region> CutByRegion(ClosedMesh& mesh,
                                const std::function<Region(const Vec3&)>& region) {
  std::vector<Region> label(mesh.positions.size());
  for (std::size_t v = 0; v < label.size(); ++v) label[v] = region(mesh.positions[v]);

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> border;
  const auto border_vertex = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] =
        border.try_emplace({a, b}, static_cast<std::uint32_t>(mesh.positions.size()));
    if (fresh) {
      const Vec3 pa = mesh.positions[a];
      const Vec3 pb = mesh.positions[b];
      double low = 0.0;
      double high = 1.0;
      for (int i = 0; i < 14; ++i) {
        const double t = 0.5 * (low + high);
        (region(pa + t * (pb - pa)) == label[a] ? low : high) = t;
      }
      // Kept off the ends: a sliver would have no area to speak of.
      mesh.positions.push_back(pa + std::clamp(low, 0.1, 0.9) * (pb - pa));
    }
    return it->second;
  };

  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Region> regions;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, Region r) {
    triangles.push_back({a, b, c});
    regions.push_back(r);
  };
  for (std::array<std::uint32_t, 3> t : mesh.triangles) {
    const std::array<Region, 3> r = {label[t[0]], label[t[1]], label[t[2]]};
    if (r[0] == r[1] && r[1] == r[2]) {
      add(t[0], t[1], t[2], r[0]);
      continue;
    }
    if (r[0] != r[1] && r[1] != r[2] && r[2] != r[0]) {
      const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(
          (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t next = border_vertex(t[c], t[(c + 1) % 3]);
        const std::uint32_t last = border_vertex(t[c], t[(c + 2) % 3]);
        add(t[c], next, middle, r[c]);
        add(t[c], middle, last, r[c]);
      }
      continue;
    }
    // One corner differs from the other two: turn it to the front.
    const std::size_t odd = r[1] == r[2] ? 0 : r[0] == r[2] ? 1 : 2;
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(odd), t.end());
    const std::uint32_t ab = border_vertex(t[0], t[1]);
    const std::uint32_t ac = border_vertex(t[0], t[2]);
    const Region rest = label[t[1]];
    add(t[0], ab, ac, label[t[0]]);
    const auto length = [&](std::uint32_t a, std::uint32_t b) {
      return glm::distance(mesh.positions[a], mesh.positions[b]);
    };
    if (length(ab, t[2]) <= length(t[1], ac)) {
      add(ab, t[1], t[2], rest);
      add(ab, t[2], ac, rest);
    } else {
      add(ab, t[1], ac, rest);
      add(t[1], t[2], ac, rest);
    }
  }
  mesh.triangles = std::move(triangles);
  return regions;
}

}  // namespace ego
