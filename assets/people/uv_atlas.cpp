// SPDX-License-Identifier: MIT
#include "assets/people/uv_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace ego {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Ways to flatten a triangle of one piece: six directions of view, or unrolled from outside or
// inside.
constexpr std::uint32_t kDirections = 6;
constexpr std::uint32_t kOutside = 6;
constexpr std::uint32_t kWays = 8;  // the last: from inside

/// A piece with the frame that it is unrolled in.
struct Cylinder {
  UvPiece piece;
  Vec3 u{0.0};  // where the angle is zero: opposite the cut
  Vec3 v{0.0};
  double radius = 0.0;  // mean

  bool HasAxis() const { return piece.direction != Vec3(0.0); }
  Vec3 Radial(const Vec3& p) const {
    const Vec3 from = p - piece.origin;
    return from - piece.direction * glm::dot(from, piece.direction);
  }
  double Angle(const Vec3& p) const {
    const Vec3 from = p - piece.origin;
    return std::atan2(glm::dot(from, v), glm::dot(from, u));
  }
};

std::vector<Cylinder> Cylinders(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles,
                                std::span<const std::uint16_t> piece,
                                std::span<const UvPiece> pieces) {
  std::vector<Cylinder> cylinders;
  for (const UvPiece& of : pieces) {
    Cylinder cylinder;
    cylinder.piece = of;
    if (cylinder.HasAxis()) {
      // The front, or the back of the hand, is in the middle.
      const Vec3 front = std::abs(of.direction.y) > 0.7 ? Vec3{0.0, 0.0, 1.0} : kUp;
      cylinder.u = glm::normalize(front - of.direction * glm::dot(front, of.direction));
      cylinder.v = glm::cross(of.direction, cylinder.u);
    }
    cylinders.push_back(cylinder);
  }
  std::vector<double> count(cylinders.size(), 0.0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Cylinder& cylinder = cylinders[piece[t]];
    cylinder.radius += glm::length(cylinder.Radial(positions[triangles[t][0]]));
    count[piece[t]] += 1.0;
  }
  for (std::size_t i = 0; i < cylinders.size(); ++i) {
    cylinders[i].radius /= std::max(count[i], 1.0);
  }
  return cylinders;
}

/// How much of its area a triangle keeps when it is flattened this way; negative: seen from behind.
double Kept(const Vec3& normal, const Vec3& middle, const Cylinder& cylinder, std::uint32_t way) {
  if (way < kDirections) {
    const double part = normal[static_cast<int>(way / 2)];
    return way % 2 == 0 ? part : -part;
  }
  const Vec3 radial = cylinder.Radial(middle);
  const double distance = glm::length(radial);
  if (!cylinder.HasAxis() || distance < 0.25 * cylinder.radius) return -1.0;
  const double outward = glm::dot(normal, radial) / distance;
  return way == kOutside ? outward : -outward;
}

/// The corners of a triangle, flat, metres.
std::array<Vec2, 3> Flatten(const std::array<Vec3, 3>& p, const Cylinder& cylinder,
                            std::uint32_t way) {
  std::array<Vec2, 3> flat;
  if (way < kDirections) {
    const int axis = static_cast<int>(way / 2);
    const double sign = way % 2 == 0 ? 1.0 : -1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      flat[c] = axis == 0   ? Vec2{-sign * p[c].z, p[c].y}
                : axis == 1 ? Vec2{p[c].x, -sign * p[c].z}
                            : Vec2{sign * p[c].x, p[c].y};
    }
    return flat;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    flat[c] = {cylinder.Angle(p[c]),
               glm::dot(p[c] - cylinder.piece.origin, cylinder.piece.direction)};
  }
  // Across the cut the angle runs on.
  const auto [low, high] = std::minmax({flat[0].x, flat[1].x, flat[2].x});
  for (Vec2& corner : flat) {
    if (high - low > kPi && corner.x < 0.0) corner.x += 2.0 * kPi;
    corner.x *= way == kOutside ? cylinder.radius : -cylinder.radius;
  }
  return flat;
}

/// How each triangle is flattened: unrolled where that keeps enough of it, else as it is seen
/// best, where neighbours do not outvote it.
std::vector<std::uint32_t> Ways(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles,
                                std::span<const std::uint16_t> piece,
                                std::span<const Cylinder> cylinders) {
  constexpr double kEnough = 0.3;
  constexpr double kLeast = 0.2;  // that a vote may bring
  std::vector<Vec3> normal;
  std::vector<Vec3> middle;
  std::vector<std::uint32_t> way;
  std::unordered_map<std::uint64_t, std::uint32_t> owner;
  owner.reserve(4 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vec3 n = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    normal.push_back(glm::length(n) > 0.0 ? glm::normalize(n) : kUp);
    middle.push_back((positions[a] + positions[b] + positions[c]) / 3.0);
    const auto kept = [&](std::uint32_t w) {
      return Kept(normal[t], middle[t], cylinders[piece[t]], w);
    };
    std::uint32_t best = 0;
    for (std::uint32_t w = 1; w < kWays; ++w) {
      if (kept(w) > kept(best)) best = w;
    }
    if (kept(kOutside) > kEnough) best = kOutside;
    way.push_back(best);
    for (std::size_t k = 0; k < 3; ++k) {
      owner[std::uint64_t{triangles[t][k]} << 32 | triangles[t][(k + 1) % 3]] =
          static_cast<std::uint32_t>(t);
    }
  }
  for (int round = 0; round < 6; ++round) {
    const std::vector<std::uint32_t> before = way;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::array<int, kWays> votes{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto other =
            owner.find(std::uint64_t{triangles[t][(k + 1) % 3]} << 32 | triangles[t][k]);
        if (other != owner.end() && piece[other->second] == piece[t]) {
          ++votes[before[other->second]];
        }
      }
      for (std::uint32_t w = 0; w < kWays; ++w) {
        if (votes[w] >= 2 && Kept(normal[t], middle[t], cylinders[piece[t]], w) > kLeast) {
          way[t] = w;
        }
      }
    }
  }
  return way;
}

struct Chart {
  Vec2 low{1e300};
  Vec2 high{-1e300};
  Vec2 place{0.0};
  Vec2 Size() const { return high - low; }
};

/// Lays charts on shelves of this width, highest first; returns the height they take.
double Pack(std::vector<Chart>& charts, const std::vector<std::size_t>& order, double width,
            double gap) {
  Vec2 pen(gap);
  double shelf = 0.0;
  for (const std::size_t i : order) {
    const Vec2 size = charts[i].Size();
    if (pen.x > gap && pen.x + size.x + gap > width) {
      pen = {gap, pen.y + shelf + gap};
      shelf = 0.0;
    }
    charts[i].place = pen;
    pen.x += size.x + gap;
    shelf = std::max(shelf, size.y);
  }
  return pen.y + shelf + gap;
}

}  // namespace

UvAtlas MakeUvAtlas(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                    std::span<const std::uint16_t> piece, std::span<const UvPiece> pieces) {
  const std::vector<Cylinder> cylinders = Cylinders(positions, triangles, piece, pieces);
  const std::vector<std::uint32_t> way = Ways(positions, triangles, piece, cylinders);
  UvAtlas atlas;
  std::vector<Chart> charts(kWays * pieces.size());
  std::vector<std::array<Vec2, 3>> flat;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    flat.push_back(
        Flatten({positions[a], positions[b], positions[c]}, cylinders[piece[t]], way[t]));
    atlas.chart.push_back(kWays * piece[t] + way[t]);
    Chart& chart = charts[atlas.chart[t]];
    for (const Vec2& corner : flat[t]) {
      chart.low = glm::min(chart.low, corner);
      chart.high = glm::max(chart.high, corner);
    }
  }
  std::vector<std::size_t> order;
  double area = 0.0;
  double widest = 0.0;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].low.x > charts[i].high.x) continue;
    order.push_back(i);
    area += charts[i].Size().x * charts[i].Size().y;
    widest = std::max(widest, charts[i].Size().x);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return charts[a].Size().y > charts[b].Size().y;
  });
  const double gap = 0.003 * std::sqrt(area);
  double best_width = 0.0;
  double best_side = 1e300;
  for (double factor = 1.0; factor < 1.6; factor += 0.02) {
    const double width = std::max(widest + 2.0 * gap, factor * std::sqrt(area));
    const double side = std::max(width, Pack(charts, order, width, gap));
    if (side < best_side) {
      best_side = side;
      best_width = width;
    }
  }
  Pack(charts, order, best_width, gap);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Chart& chart = charts[atlas.chart[t]];
    std::array<glm::vec2, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec2 p = (flat[t][c] - chart.low + chart.place) / best_side;
      // glTF counts v from the top.
      corners[c] = glm::vec2(glm::clamp(Vec2{p.x, 1.0 - p.y}, 0.0, 1.0));
    }
    atlas.uv.push_back(corners);
  }
  return atlas;
}

}  // namespace ego
