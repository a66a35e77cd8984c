// SPDX-License-Identifier: MIT
#include "assets/calibration/closed_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace ego {
namespace {

/// Numbers for vertices, equal where the positions are (to a hundred-thousandth of the size).
std::vector<std::vector<std::uint32_t>> Weld(const PosedMesh& mesh) {
  double size = 0.0;
  for (const auto& part : mesh.position_ws) {
    for (const Vec3& p : part) {
      const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (std::isfinite(reach)) size = std::max(size, reach);
    }
  }
  const double step = 1e-5 * std::max(size, 1e-9);
  using Cell = std::array<std::int64_t, 3>;
  std::vector<std::tuple<Cell, std::uint32_t, std::uint32_t>> order;
  std::vector<std::vector<std::uint32_t>> number(mesh.position_ws.size());
  for (std::uint32_t part = 0; part < mesh.position_ws.size(); ++part) {
    const auto& positions = mesh.position_ws[part];
    number[part].resize(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      Cell cell{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = positions[v][static_cast<int>(k)] / step;
        cell[k] = std::isfinite(c) ? std::llround(c) : 0;
      }
      order.emplace_back(cell, part, v);
    }
  }
  std::sort(order.begin(), order.end());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && std::get<0>(order[i]) != std::get<0>(order[i - 1])) ++next;
    number[std::get<1>(order[i])][std::get<2>(order[i])] = next;
  }
  return number;
}

class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t Find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::uint32_t a, std::uint32_t b) { parent_[Find(a)] = Find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> ClosedPieces(const Character& character,
                                                    const PosedMesh& mesh) {
  const std::vector<std::vector<std::uint32_t>> number = Weld(mesh);
  std::size_t vertices = 0;
  for (const auto& part : number) {
    for (const std::uint32_t n : part) vertices = std::max<std::size_t>(vertices, n + 1u);
  }
  Union pieces(vertices);
  struct Edge {
    std::uint32_t low, high;
    int direction;  // 1 when walked from low to high
    bool operator<(const Edge& o) const { return std::tie(low, high) < std::tie(o.low, o.high); }
  };
  std::vector<Edge> edges;
  std::vector<double> volume(vertices, 0.0);
  std::vector<std::vector<std::int32_t>> piece_of(character.parts.size());
  const auto corner = [&](std::size_t p, std::size_t i) {
    return number[p][character.parts[p].triangles[i]];
  };
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const std::size_t count = character.parts[p].triangles.size() / 3;
    piece_of[p].assign(count, 0);
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corner(p, 3 * t + k);
        const std::uint32_t b = corner(p, 3 * t + (k + 1) % 3);
        if (a == b) continue;
        pieces.Join(a, b);
        edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
      }
    }
  }
  // A piece is open as soon as one edge is not walked equally often both ways.
  std::sort(edges.begin(), edges.end());
  std::vector<bool> open(vertices, false);
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    const std::size_t first = i;
    for (; i < edges.size() && !(edges[first] < edges[i]); ++i) balance += edges[i].direction;
    if (balance != 0) open[pieces.Find(edges[first].low)] = true;
  }
  const auto each_triangle = [&](const auto& visit) {
    for (std::size_t p = 0; p < character.parts.size(); ++p) {
      for (std::size_t t = 0; t < piece_of[p].size(); ++t)
        visit(p, t, pieces.Find(corner(p, 3 * t)));
    }
  };
  each_triangle([&](std::size_t p, std::size_t t, std::uint32_t piece) {
    const auto& index = character.parts[p].triangles;
    const auto& position = mesh.position_ws[p];
    volume[piece] += glm::dot(position[index[3 * t]],
                              glm::cross(position[index[3 * t + 1]], position[index[3 * t + 2]]));
  });
  each_triangle([&](std::size_t p, std::size_t t, std::uint32_t piece) {
    if (open[piece]) return;
    const auto id = static_cast<std::int32_t>(piece) + 1;
    piece_of[p][t] = volume[piece] >= 0.0 ? id : -id;
  });
  return piece_of;
}

}  // namespace ego
