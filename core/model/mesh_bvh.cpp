// SPDX-License-Identifier: MIT
#include "core/model/mesh_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ego {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance at which a ray enters a box, or infinity when it misses it or starts beyond `limit`.
double EnterBox(const Vec3& low, const Vec3& high, const Vec3& origin, const Vec3& inverse,
                double limit) {
  double enter = 0.0;
  double leave = limit;
  for (int k = 0; k < 3; ++k) {
    double t0 = (low[k] - origin[k]) * inverse[k];
    double t1 = (high[k] - origin[k]) * inverse[k];
    if (t0 > t1) std::swap(t0, t1);
    // A ray inside a slab's plane gives NaN; comparisons that keep the old bound ignore it.
    if (t0 > enter) enter = t0;
    if (t1 < leave) leave = t1;
  }
  // Boxes of flat triangles must not be lost to rounding.
  return enter <= leave * (1.0 + 1e-12) + 1e-12 ? enter : kInfinity;
}

double DistanceToBox2(const Vec3& low, const Vec3& high, const Vec3& p) {
  const Vec3 d = glm::max(glm::max(low - p, p - high), Vec3{0.0});
  return glm::dot(d, d);
}

/// Weights of the point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 NearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return {1.0 - v, v, 0.0};
  }
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return {1.0 - w, 0.0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - w, w};
  }
  const double scale = 1.0 / (va + vb + vc);
  return {1.0 - vb * scale - vc * scale, vb * scale, vc * scale};
}

}  // namespace

MeshBvh::MeshBvh(const Character& character, const PosedMesh& mesh, const TriangleFilter& use) {
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const std::vector<std::uint32_t>& index = character.parts[p].triangles;
    const std::vector<Vec3>& position = mesh.position_ws[p];
    for (std::size_t t = 0; 3 * t + 2 < index.size(); ++t) {
      const auto triangle = static_cast<std::uint32_t>(t);
      if (use && !use(static_cast<int>(p), triangle)) continue;
      const Vec3& a = position[index[3 * t]];
      const Vec3& b = position[index[3 * t + 1]];
      const Vec3& c = position[index[3 * t + 2]];
      const Vec3 cross = glm::cross(b - a, c - a);
      const double area2 = glm::dot(cross, cross);
      if (!(area2 > 0.0) || !std::isfinite(area2)) continue;
      triangles_.push_back({a, b, c, static_cast<int>(p), triangle});
    }
  }
  nodes_.reserve(triangles_.size());
  if (!triangles_.empty()) Build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void MeshBvh::Build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Vec3 low{kInfinity};
  Vec3 high{-kInfinity};
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    low = glm::min(low, glm::min(t.a, glm::min(t.b, t.c)));
    high = glm::max(high, glm::max(t.a, glm::max(t.b, t.c)));
  }
  nodes_[self].low = low;
  nodes_[self].high = high;
  if (end - begin <= kLeafSize) {
    nodes_[self].first = begin;
    nodes_[self].count = end - begin;
    return;
  }
  const Vec3 size = high - low;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto key = [axis](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
  // The index breaks ties, so that the tree is the same everywhere.
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end, [&](const Triangle& a, const Triangle& b) {
                     const double ka = key(a);
                     const double kb = key(b);
                     if (ka != kb) return ka < kb;
                     return std::pair(a.part, a.index) < std::pair(b.part, b.index);
                   });
  Build(begin, middle);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  Build(middle, end);
}

void MeshBvh::FitLeaf(Node& node) const {
  node.low = Vec3{kInfinity};
  node.high = Vec3{-kInfinity};
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Triangle& t = triangles_[i];
    node.low = glm::min(node.low, glm::min(t.a, glm::min(t.b, t.c)));
    node.high = glm::max(node.high, glm::max(t.a, glm::max(t.b, t.c)));
  }
}

void MeshBvh::Refit(const Character& character, const PosedMesh& mesh) {
  for (Triangle& t : triangles_) {
    const auto p = static_cast<std::size_t>(t.part);
    const std::uint32_t* corner = &character.parts[p].triangles[3 * std::size_t{t.index}];
    const std::vector<Vec3>& position = mesh.position_ws[p];
    t.a = position[corner[0]];
    t.b = position[corner[1]];
    t.c = position[corner[2]];
  }
  // Children come after their parent.
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.count > 0) {
      FitLeaf(node);
      continue;
    }
    node.low = glm::min(nodes_[n + 1].low, nodes_[node.first].low);
    node.high = glm::max(nodes_[n + 1].high, nodes_[node.first].high);
  }
}

std::optional<MeshBvh::Hit> MeshBvh::Cross(const Triangle& t, const Vec3& origin,
                                           const Vec3& direction, double max_distance) {
  // Moeller and Trumbore, with a hair's breadth of tolerance at the edges: a ray along the seam of
  // a symmetric mesh must not slip between its halves.
  constexpr double kEdge = 1e-9;
  const Vec3 ab = t.b - t.a;
  const Vec3 ac = t.c - t.a;
  const Vec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return std::nullopt;
  const Vec3 s = origin - t.a;
  const double u = glm::dot(s, p) / determinant;
  if (!(u >= -kEdge && u <= 1.0 + kEdge)) return std::nullopt;
  const Vec3 q = glm::cross(s, ab);
  const double v = glm::dot(direction, q) / determinant;
  if (!(v >= -kEdge && u + v <= 1.0 + kEdge)) return std::nullopt;
  const double distance = glm::dot(ac, q) / determinant;
  if (!(distance >= 0.0 && distance <= max_distance)) return std::nullopt;
  Hit hit;
  const double uc = std::clamp(u, 0.0, 1.0);
  const double vc = std::clamp(v, 0.0, 1.0 - uc);
  hit.place = {t.part, t.index, Vec3{1.0 - uc - vc, uc, vc}};
  hit.position_ws = t.a + uc * ab + vc * ac;
  hit.normal_ws = glm::normalize(glm::cross(ab, ac));
  hit.distance = distance;
  return hit;
}

std::vector<MeshBvh::Hit> MeshBvh::AllHits(const Vec3& origin_ws, const Vec3& direction,
                                           double max_distance) const {
  std::vector<Hit> hits;
  if (nodes_.empty()) return hits;
  const Vec3 inverse = 1.0 / direction;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (EnterBox(node.low, node.high, origin_ws, inverse, max_distance) == kInfinity) continue;
    if (node.count == 0) {
      stack[depth++] = at + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto hit = Cross(triangles_[i], origin_ws, direction, max_distance);
      if (hit) hits.push_back(*hit);
    }
  }
  std::sort(hits.begin(), hits.end(), Before);
  return hits;
}

bool MeshBvh::Before(const Hit& a, const Hit& b) {
  if (a.distance != b.distance) return a.distance < b.distance;
  return std::pair(a.place.part, a.place.triangle) < std::pair(b.place.part, b.place.triangle);
}

std::optional<MeshBvh::Hit> MeshBvh::FirstHit(const Vec3& origin_ws, const Vec3& direction,
                                              double max_distance) const {
  std::optional<Hit> first;
  if (nodes_.empty()) return first;
  const Vec3 inverse = 1.0 / direction;
  double limit = max_distance;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (EnterBox(node.low, node.high, origin_ws, inverse, limit) == kInfinity) continue;
    if (node.count == 0) {
      // The nearer child is looked at first: what it holds may hide all of the other.
      const Node& left = nodes_[at + 1];
      const Node& right = nodes_[node.first];
      const bool left_first = EnterBox(left.low, left.high, origin_ws, inverse, limit) <=
                              EnterBox(right.low, right.high, origin_ws, inverse, limit);
      stack[depth++] = left_first ? node.first : at + 1;
      stack[depth++] = left_first ? at + 1 : node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto hit = Cross(triangles_[i], origin_ws, direction, limit);
      if (!hit || (first && !Before(*hit, *first))) continue;
      first = hit;
      limit = hit->distance;
    }
  }
  return first;
}

void MeshBvh::VisitCone(const Vec3& origin_ws, const Vec3& direction, double radius, double slope,
                        const std::function<void(int part, std::uint32_t triangle)>& visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    // The box's ball against the cone, as wide as it is at the ball's far end.
    const Vec3 to_middle = 0.5 * (node.low + node.high) - origin_ws;
    const double ball = 0.5 * glm::length(node.high - node.low);
    const double along = glm::dot(to_middle, direction);
    if (along + ball < 0.0) continue;
    const double off = glm::length(to_middle - along * direction);
    if (off > ball + radius + slope * (along + ball)) continue;
    if (node.count == 0) {
      stack[depth++] = at + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      visit(triangles_[i].part, triangles_[i].index);
    }
  }
}

std::optional<MeshBvh::Hit> MeshBvh::Nearest(const Vec3& point_ws) const {
  if (nodes_.empty()) return std::nullopt;
  double best2 = kInfinity;
  Hit hit;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (DistanceToBox2(node.low, node.high, point_ws) > best2) continue;
    if (node.count == 0) {
      std::uint32_t near = at + 1;
      std::uint32_t far = node.first;
      if (DistanceToBox2(nodes_[far].low, nodes_[far].high, point_ws) <
          DistanceToBox2(nodes_[near].low, nodes_[near].high, point_ws)) {
        std::swap(near, far);
      }
      stack[depth++] = far;
      stack[depth++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[i];
      const Vec3 weight = NearestOnTriangle(point_ws, t.a, t.b, t.c);
      const Vec3 position = weight.x * t.a + weight.y * t.b + weight.z * t.c;
      const Vec3 d = position - point_ws;
      const double distance2 = glm::dot(d, d);
      const bool closer = distance2 < best2 ||
                          (distance2 == best2 && std::pair(t.part, t.index) <
                                                     std::pair(hit.place.part, hit.place.triangle));
      if (!closer) continue;
      best2 = distance2;
      hit.place = {t.part, t.index, weight};
      hit.position_ws = position;
      hit.normal_ws = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    }
  }
  if (hit.place.part < 0) return std::nullopt;
  hit.distance = std::sqrt(best2);
  return hit;
}

}  // namespace ego
