// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/mesh/surface_mesh_impl.h"

namespace ego {
namespace {

/// How much farther a layer may lie than the one below it and still be worn close.
constexpr double kLoose = 1.5;

/// Distances of the corners from the plane; never exactly zero, so that a plane through a vertex
/// cuts edges only.
double Side(const Vec3& p, const Vec3& origin, const Vec3& axis) {
  const double d = glm::dot(p - origin, axis);
  return d == 0.0 ? 1e-30 : d;
}

}  // namespace

std::vector<MeshPoint> SurfaceRing::Even(std::size_t count) const {
  std::vector<double> at{0.0};
  const std::size_t pieces = closed ? place.size() : place.size() - 1;
  for (std::size_t i = 0; i < pieces; ++i) {
    at.push_back(at.back() +
                 glm::distance(position_ms[i], position_ms[(i + 1) % position_ms.size()]));
  }
  std::vector<MeshPoint> even;
  // An open chain has a place at either end.
  const double parts = static_cast<double>(closed ? count : std::max<std::size_t>(count, 2) - 1);
  std::size_t i = 0;
  for (std::size_t k = 0; k < count && pieces > 0; ++k) {
    const double wanted = at.back() * static_cast<double>(k) / parts;
    while (i + 1 < pieces && at[i + 1] < wanted) ++i;
    const double length = at[i + 1] - at[i];
    const double share = length > 0.0 ? std::clamp((wanted - at[i]) / length, 0.0, 1.0) : 0.0;
    MeshPoint point = place[i];
    point.barycentric = glm::mix(place[i].barycentric, leave[i].barycentric, share);
    even.push_back(point);
  }
  return even;
}

std::optional<SurfaceRing> SurfaceMesh::Ring(LimbSegment segment, double t,
                                             double thickness) const {
  const Vec3& start = impl_->joint[Index(StartJoint(segment))];
  const Vec3& end = impl_->joint[Index(EndJoint(segment))];
  return Ring(start, end, t, std::max(0.5 * glm::distance(start, end), thickness));
}

std::optional<SurfaceRing> SurfaceMesh::Ring(const Vec3& start_ms, const Vec3& end_ms, double t,
                                             double farthest) const {
  const Vec3 bone = end_ms - start_ms;
  const double length = glm::length(bone);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 axis = bone / length;
  const Vec3 origin = start_ms + t * bone;

  const auto side = [&](std::uint32_t face, int k) {
    return Side(impl_->At(face, k), origin, axis);
  };
  /// Where the plane cuts edge k of a triangle, by the triangle's weights.
  const auto cut = [&](std::uint32_t face, int k) {
    const double a = side(face, k);
    const double b = side(face, (k + 1) % 3);
    Vec3 weight{0.0};
    weight[(k + 1) % 3] = a / (a - b);
    weight[k] = 1.0 - weight[(k + 1) % 3];
    return impl_->PlaceOn(face, weight);
  };
  const auto is_cut = [&](std::uint32_t face, int k) {
    return (side(face, k) > 0.0) != (side(face, (k + 1) % 3) > 0.0);
  };

  std::vector<bool> seen(impl_->triangle.size(), false);
  std::vector<SurfaceRing> rings;
  const auto follow = [&](std::uint32_t first, int enter) {
    SurfaceRing ring;
    HalfEdges::FaceEdge at{first, enter};
    while (true) {
      seen[at.face] = true;
      int out = at.edge;
      for (int k = 0; k < 3; ++k) {
        if (k != at.edge && is_cut(at.face, k)) out = k;
      }
      ring.place.push_back(cut(at.face, at.edge));
      ring.leave.push_back(cut(at.face, out));
      const auto next = impl_->edges->Across({at.face, out});
      if (next && next->face == first) {
        ring.closed = true;
        break;
      }
      if (!next || seen[next->face]) break;
      at = *next;
    }
    if (!ring.closed) {
      ring.place.push_back(ring.leave.back());
      ring.leave.push_back(ring.leave.back());
    }
    for (const MeshPoint& p : ring.place) ring.position_ms.push_back(impl_->PositionOf(p));
    rings.push_back(std::move(ring));
  };
  // Open chains are followed from their ends, or they would come in two.
  for (const bool from_ends : {true, false}) {
    for (std::uint32_t f = 0; f < impl_->triangle.size(); ++f) {
      if (seen[f]) continue;
      for (int k = 0; k < 3 && !seen[f]; ++k) {
        if (!is_cut(f, k)) continue;
        if (from_ends && impl_->edges->Across({f, k})) continue;
        follow(f, k);
      }
    }
  }

  // A frame across the axis, for the angle around it.
  const Vec3 helper = std::abs(axis.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 u = glm::normalize(glm::cross(axis, helper));
  const Vec3 v = glm::cross(axis, u);
  std::vector<SurfaceRing*> around;
  for (SurfaceRing& ring : rings) {
    const std::size_t count = ring.position_ms.size();
    double turned = 0.0;
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i + (ring.closed ? 0 : 1) < count; ++i) {
      const Vec3 p = ring.position_ms[i] - origin;
      const Vec3 q = ring.position_ms[(i + 1) % count] - origin;
      const double px = glm::dot(p, u), py = glm::dot(p, v);
      const double qx = glm::dot(q, u), qy = glm::dot(q, v);
      turned += std::atan2(px * qy - py * qx, px * qx + py * qy);
      const double piece = glm::distance(p, q);
      sum += piece * 0.5 * (glm::length(p) + glm::length(q));
      total += piece;
    }
    if (!(total > 0.0)) continue;
    ring.radius = sum / total;
    ring.covered = std::min(1.0, std::abs(turned) / (2.0 * std::numbers::pi));
    if (ring.covered > 0.5 && ring.radius <= farthest) around.push_back(&ring);
  }
  if (around.empty()) return std::nullopt;
  std::sort(around.begin(), around.end(),
            [](const SurfaceRing* a, const SurfaceRing* b) { return a->radius < b->radius; });
  std::size_t chosen = 0;
  while (chosen + 1 < around.size() &&
         around[chosen + 1]->radius <= kLoose * around[chosen]->radius) {
    ++chosen;
  }
  return std::move(*around[chosen]);
}

}  // namespace ego
