// SPDX-License-Identifier: MIT
#include "assets/mesh/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "assets/mesh/surface_mesh_impl.h"

namespace ego {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Vertices closer than this share of the character's size are one.
constexpr double kWeld = 1e-5;

/// Numbers vertices, those at one place alike: each joins the first one within the tolerance.
std::vector<std::uint32_t> Weld(const std::vector<Vec3>& points, double tolerance,
                                std::vector<Vec3>& welded) {
  // Coordinates in cells four times the tolerance wide; a point near a border asks both cells.
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t point;
    bool operator<(const Entry& o) const {
      return std::tie(cell, point) < std::tie(o.cell, o.point);
    }
  };
  std::vector<Entry> cells;
  cells.reserve(points.size());
  const auto cell_of = [&](double c) {
    return std::isfinite(c) ? static_cast<std::int64_t>(std::floor(c / (4.0 * tolerance))) : 0;
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    cells.push_back({{cell_of(points[i].x), cell_of(points[i].y), cell_of(points[i].z)}, i});
  }
  std::sort(cells.begin(), cells.end());
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(points.size(), kNone);
  const auto join = [&](std::uint32_t i, const Cell& cell) {
    for (auto at = std::lower_bound(cells.begin(), cells.end(), Entry{cell, 0});
         at != cells.end() && at->cell == cell; ++at) {
      if (number[at->point] != kNone) continue;
      if (glm::distance(points[at->point], points[i]) <= tolerance) number[at->point] = number[i];
    }
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (number[i] != kNone) continue;
    number[i] = static_cast<std::uint32_t>(welded.size());
    welded.push_back(points[i]);
    std::array<std::array<std::int64_t, 2>, 3> range;
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = points[i][static_cast<int>(k)];
      range[k] = {cell_of(c - tolerance), cell_of(c + tolerance)};
    }
    for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x) {
      for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y) {
        for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z) join(i, {x, y, z});
      }
    }
  }
  return number;
}

int HeaviestCorner(const Vec3& weight) {
  if (weight.x >= weight.y && weight.x >= weight.z) return 0;
  return weight.y >= weight.z ? 1 : 2;
}

}  // namespace

SurfaceMesh::Impl::Impl(const Character& character) {
  const PosedMesh mesh = CanonicalMesh(character);
  std::vector<Vec3> points;
  std::vector<std::uint32_t> first_point;
  double size = 0.0;
  for (const std::vector<Vec3>& part : mesh.position_ws) {
    first_point.push_back(static_cast<std::uint32_t>(points.size()));
    points.insert(points.end(), part.begin(), part.end());
    for (const Vec3& p : part) {
      if (std::isfinite(glm::dot(p, p))) size = std::max(size, glm::length(p));
    }
  }
  const std::vector<std::uint32_t> number = Weld(points, kWeld * std::max(size, 1e-9), position);
  representative.resize(position.size());
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    first_face.push_back(static_cast<std::uint32_t>(triangle.size()));
    const std::vector<std::uint32_t>& index = character.parts[p].triangles;
    for (std::uint32_t t = 0; 3 * std::size_t{t} + 2 < index.size(); ++t) {
      triangle.push_back({static_cast<int>(p), t});
      auto& corners = vertex.emplace_back();
      auto& joined = welded.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = index[3 * std::size_t{t} + k];
        joined[k] = number[first_point[p] + corners[k]];
        MeshPoint& place = representative[joined[k]];
        if (place.part < 0) place = AtCorner(static_cast<int>(p), t, static_cast<int>(k));
      }
    }
  }
  edges.emplace(welded, position.size());
  bvh.emplace(character, mesh);
  joint = CanonicalPositions(character.rig.skeleton);
  using J = HumanoidJoint;
  const auto x = [&](J j) { return joint[Index(j)].x; };
  middle_x = 0.25 * (x(J::kLeftUpperArm) + x(J::kRightUpperArm) + x(J::kLeftUpperLeg) +
                     x(J::kRightUpperLeg));
}

bool SurfaceMesh::Impl::Has(const MeshPoint& place) const {
  if (place.part < 0 || static_cast<std::size_t>(place.part) >= first_face.size()) return false;
  const auto p = static_cast<std::size_t>(place.part);
  const std::size_t end = p + 1 < first_face.size() ? first_face[p + 1] : triangle.size();
  return first_face[p] + std::size_t{place.triangle} < end;
}

Vec3 SurfaceMesh::Impl::PositionOf(const MeshPoint& place) const {
  const std::uint32_t face = FaceOf(place);
  Vec3 sum{0.0};
  for (int k = 0; k < 3; ++k) sum += place.barycentric[k] * At(face, k);
  return sum;
}

Vec3 SurfaceMesh::Impl::Posed(const PosedMesh& posed, std::uint32_t face, int corner) const {
  return posed.position_ws[static_cast<std::size_t>(triangle[face].part)]
                          [vertex[face][static_cast<std::size_t>(corner)]];
}

SurfaceMesh::SurfaceMesh(const Character& character) : impl_(std::make_unique<Impl>(character)) {}
SurfaceMesh::~SurfaceMesh() = default;
SurfaceMesh::SurfaceMesh(SurfaceMesh&&) noexcept = default;
SurfaceMesh& SurfaceMesh::operator=(SurfaceMesh&&) noexcept = default;

std::size_t SurfaceMesh::VertexCount() const { return impl_->position.size(); }
std::size_t SurfaceMesh::TriangleCount() const { return impl_->triangle.size(); }
const Vec3& SurfaceMesh::Position(Vertex vertex) const { return impl_->position[vertex]; }
MeshPoint SurfaceMesh::PlaceOf(Vertex vertex) const { return impl_->representative[vertex]; }
bool SurfaceMesh::OnBoundary(Vertex vertex) const { return impl_->edges->OnBoundary(vertex); }
double SurfaceMesh::MiddleX() const { return impl_->middle_x; }

std::vector<SurfaceMesh::Vertex> SurfaceMesh::Neighbours(Vertex vertex) const {
  return impl_->edges->Neighbours(vertex);
}

Vec3 SurfaceMesh::Normal(Vertex vertex) const {
  Vec3 sum{0.0};
  for (const std::uint32_t f : impl_->edges->FacesAround(vertex)) {
    sum += glm::cross(impl_->At(f, 1) - impl_->At(f, 0), impl_->At(f, 2) - impl_->At(f, 0));
  }
  const double length = glm::length(sum);
  return length > 0.0 ? sum / length : Vec3{0.0};
}

std::optional<SurfaceMesh::Vertex> SurfaceMesh::VertexAt(const MeshPoint& place) const {
  if (!impl_->Has(place)) return std::nullopt;
  const std::uint32_t face = impl_->FaceOf(place);
  const Vec3 at = impl_->PositionOf(place);
  int best = HeaviestCorner(place.barycentric);
  for (int k = 0; k < 3; ++k) {
    if (glm::distance(impl_->At(face, k), at) < glm::distance(impl_->At(face, best), at)) best = k;
  }
  return impl_->welded[face][static_cast<std::size_t>(best)];
}

std::optional<SurfaceMesh::Vertex> SurfaceMesh::Nearest(const Vec3& point_ms) const {
  std::optional<Vertex> best;
  double least = kInfinity;
  for (Vertex v = 0; v < impl_->position.size(); ++v) {
    if (impl_->representative[v].part < 0) continue;
    const Vec3 d = impl_->position[v] - point_ms;
    const double distance2 = glm::dot(d, d);
    if (distance2 < least) {
      least = distance2;
      best = v;
    }
  }
  return best;
}

std::optional<MeshPoint> SurfaceMesh::Step(const MeshPoint& place, const Vec3& direction,
                                           const PosedMesh& posed) const {
  const auto from = VertexAt(place);
  const double length = glm::length(direction);
  if (!from || !(length > 0.0)) return std::nullopt;
  const auto at = [&](Vertex v) {
    const MeshPoint& p = impl_->representative[v];
    return impl_->Posed(posed, impl_->FaceOf(p), HeaviestCorner(p.barycentric));
  };
  Vec3 normal{0.0};
  for (const std::uint32_t f : impl_->edges->FacesAround(*from)) {
    const Vec3 a = impl_->Posed(posed, f, 0);
    normal += glm::cross(impl_->Posed(posed, f, 1) - a, impl_->Posed(posed, f, 2) - a);
  }
  const double normal_length = glm::length(normal);
  Vec3 wanted = direction / length;
  if (normal_length > 0.0) {
    normal /= normal_length;
    const Vec3 flat = wanted - glm::dot(wanted, normal) * normal;
    // Straight into the surface there is no way to prefer.
    if (glm::length(flat) > 1e-6) wanted = glm::normalize(flat);
  }
  const double least = std::cos(Radians(75.0));
  double best = least;
  std::optional<MeshPoint> next;
  const Vec3 here = at(*from);
  for (const Vertex v : Neighbours(*from)) {
    Vec3 way = at(v) - here;
    if (normal_length > 0.0) way -= glm::dot(way, normal) * normal;
    const double way_length = glm::length(way);
    if (!(way_length > 0.0)) continue;
    const double along = glm::dot(way, wanted) / way_length;
    if (along <= best) continue;
    best = along;
    next = impl_->representative[v];
  }
  return next;
}

std::optional<MeshPoint> SurfaceMesh::MirrorOf(const MeshPoint& place, double tolerance) const {
  if (!impl_->Has(place)) return std::nullopt;
  const auto mirror = [&](const Vec3& p) { return Vec3{2.0 * impl_->middle_x - p.x, p.y, p.z}; };
  const Vec3 wanted = mirror(impl_->PositionOf(place));
  const bool at_vertex = place.barycentric[HeaviestCorner(place.barycentric)] > 1.0 - 1e-6;
  if (!at_vertex) {
    const auto hit = impl_->bvh->Nearest(wanted);
    if (!hit || hit->distance > tolerance) return std::nullopt;
    return hit->place;
  }
  Vec3 facing = Normal(*VertexAt(place));
  facing.x = -facing.x;
  std::optional<Vertex> best;
  std::pair<bool, double> least{true, kInfinity};  // looks the wrong way, distance
  for (Vertex v = 0; v < impl_->position.size(); ++v) {
    if (impl_->representative[v].part < 0) continue;
    const double distance = glm::distance(impl_->position[v], wanted);
    if (distance > tolerance || distance > least.second + tolerance) continue;
    const std::pair<bool, double> cost{glm::dot(Normal(v), facing) < 0.0, distance};
    if (cost < least) {
      least = cost;
      best = v;
    }
  }
  if (!best) return std::nullopt;
  return impl_->representative[*best];
}

std::vector<double> SurfaceMesh::GeodesicDistances(Vertex from, double limit) const {
  std::vector<double> distance(VertexCount(), kInfinity);
  using Entry = std::pair<double, Vertex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[from] = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    for (const Vertex next : Neighbours(v)) {
      const double there = d + glm::distance(impl_->position[v], impl_->position[next]);
      if (there >= distance[next] || there > limit) continue;
      distance[next] = there;
      open.emplace(there, next);
    }
  }
  return distance;
}

double SurfaceMesh::GeodesicDistance(const MeshPoint& from, const MeshPoint& to,
                                     double limit) const {
  if (!impl_->Has(from) || !impl_->Has(to)) return kInfinity;
  const Vec3 a = impl_->PositionOf(from);
  const Vec3 b = impl_->PositionOf(to);
  const std::uint32_t start = impl_->FaceOf(from);
  const std::uint32_t end = impl_->FaceOf(to);
  if (start == end) return glm::distance(a, b);
  double best = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> distance =
        GeodesicDistances(impl_->welded[start][static_cast<std::size_t>(k)], limit);
    const double first = glm::distance(a, impl_->At(start, k));
    for (int m = 0; m < 3; ++m) {
      best = std::min(best, first + distance[impl_->welded[end][static_cast<std::size_t>(m)]] +
                                glm::distance(impl_->At(end, m), b));
    }
  }
  return best <= limit ? best : kInfinity;
}

}  // namespace ego
