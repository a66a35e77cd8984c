// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/mesh/surface_mesh_impl.h"

namespace ego {
namespace {

constexpr double kOnEdge = 1e-9;

/// One triangle laid out for a walk over it.
struct Patch {
  std::array<Vec3, 3> p;
  Vec3 normal{0.0};  // unit; zero for a degenerate triangle

  explicit Patch(const std::array<Vec3, 3>& corners) : p(corners) {
    const Vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(cross);
    if (length > 0.0) normal = cross / length;
  }
  bool Flat() const { return normal == Vec3{0.0}; }
  Vec3 Along(const Vec3& way) const { return way - glm::dot(way, normal) * normal; }
  /// How fast the barycentric weights change along a vector in the plane.
  Vec3 Rate(const Vec3& way) const {
    const Vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double area2 = glm::dot(cross, cross);
    Vec3 rate;
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = p[std::size_t(k + 2) % 3] - p[std::size_t(k + 1) % 3];
      rate[k] = glm::dot(glm::cross(cross, edge), way) / area2;
    }
    return rate;
  }
};

Vec3 Clean(Vec3 weight) {
  weight = glm::max(weight, Vec3{0.0});
  return weight / (weight.x + weight.y + weight.z);
}

}  // namespace

MeshPoint SurfaceMesh::Walk(const MeshPoint& place, const Vec3& way, const PosedMesh& posed) const {
  if (!impl_->Has(place)) return place;
  const auto patch_of = [&](std::uint32_t face) {
    return Patch(
        {impl_->Posed(posed, face, 0), impl_->Posed(posed, face, 1), impl_->Posed(posed, face, 2)});
  };
  std::uint32_t face = impl_->FaceOf(place);
  Vec3 at = Clean(place.barycentric);

  // From a corner or an edge the way may begin in any of the triangles there: take the one that it
  // leaves last.
  const int heaviest = at.x >= at.y && at.x >= at.z ? 0 : at.y >= at.z ? 1 : 2;
  const auto stays = [&](std::uint32_t f, const Vec3& weight) {
    const Patch patch = patch_of(f);
    if (patch.Flat()) return -std::numeric_limits<double>::infinity();
    const Vec3 rate = patch.Rate(patch.Along(way));
    double leaving = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (weight[k] <= kOnEdge) leaving = std::min(leaving, rate[k]);
    }
    return leaving;
  };
  if (at[heaviest] >= 1.0 - kOnEdge) {
    const std::uint32_t corner = impl_->welded[face][static_cast<std::size_t>(heaviest)];
    double best = stays(face, at);
    for (const std::uint32_t f : impl_->edges->FacesAround(corner)) {
      Vec3 weight{0.0};
      for (int k = 0; k < 3; ++k) {
        if (impl_->welded[f][static_cast<std::size_t>(k)] == corner) weight[k] = 1.0;
      }
      const double s = stays(f, weight);
      if (s <= best) continue;
      best = s;
      face = f;
      at = weight;
    }
  }

  Patch patch = patch_of(face);
  if (patch.Flat()) return place;
  Vec3 left = patch.Along(way);
  constexpr int kMostTriangles = 10000;
  int came_from = -1;
  for (int step = 0; step < kMostTriangles && glm::length(left) > 0.0; ++step) {
    const Vec3 rate = patch.Rate(left);
    double reach = 1.0;
    int out = -1;  // the corner whose weight runs out
    for (int k = 0; k < 3; ++k) {
      if (!(rate[k] < 0.0) || k == came_from) continue;
      const double t = std::max(0.0, at[k]) / -rate[k];
      if (t < reach) {
        reach = t;
        out = k;
      }
    }
    at = Clean(at + reach * rate);
    if (out < 0) return impl_->PlaceOn(face, at);
    at[out] = 0.0;
    at = Clean(at);
    left *= 1.0 - reach;
    const auto next = impl_->edges->Across({face, (out + 1) % 3});
    if (!next) break;
    // Unfold the next triangle about the edge: along it the way stays, across it turns over.
    const int a = (out + 1) % 3;
    const int b = (out + 2) % 3;
    const Vec3 edge = patch.p[std::size_t(b)] - patch.p[std::size_t(a)];
    const double edge_length = glm::length(edge);
    const Patch beyond = patch_of(next->face);
    if (beyond.Flat() || !(edge_length > 0.0)) break;
    const int apex = (next->edge + 2) % 3;
    const Vec3 unit = edge / edge_length;
    const auto across = [&](const Vec3& way_to) {
      const Vec3 v = way_to - glm::dot(way_to, unit) * unit;
      const double length = glm::length(v);
      return length > 0.0 ? v / length : Vec3{0.0};
    };
    const Vec3 outward = across(patch.p[std::size_t(a)] - patch.p[std::size_t(out)]);
    const Vec3 inward = across(beyond.p[std::size_t(apex)] - patch.p[std::size_t(a)]);
    left = glm::dot(left, unit) * unit + glm::dot(left, outward) * inward;
    // The same point by the weights of the next triangle.
    const std::uint32_t vertex_a = impl_->welded[face][static_cast<std::size_t>(a)];
    const int a_there = impl_->welded[next->face][static_cast<std::size_t>(next->edge)] == vertex_a
                            ? next->edge
                            : (next->edge + 1) % 3;
    const int b_there = a_there == next->edge ? (next->edge + 1) % 3 : next->edge;
    Vec3 weight{0.0};
    weight[a_there] = at[a];
    weight[b_there] = at[b];
    face = next->face;
    at = weight;
    patch = beyond;
    came_from = apex;
  }
  return impl_->PlaceOn(face, at);
}

}  // namespace ego
