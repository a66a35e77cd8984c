// SPDX-License-Identifier: MIT
#include "core/model/mesh_picker.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/model/rig.h"

namespace ego {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// A vertex is seen when nothing lies in front of it by more than this share of its distance: its
/// own triangles end there.
constexpr double kSkinDepth = 1e-6;

}  // namespace

MeshPicker::MeshPicker(std::shared_ptr<const Character> character)
    : character_(std::move(character)),
      mesh_(CanonicalMesh(*character_)),
      bvh_(*character_, mesh_) {}

void MeshPicker::SetPose(std::span<const Mat4> node_global) {
  mesh_ = PoseMesh(*character_, node_global);
  bvh_.Refit(*character_, mesh_);
}

void MeshPicker::SetPose(const ModelPose& pose) {
  std::vector<Mat4> node_global(character_->nodes.joints.size());
  PoseNodes(character_->rig, pose, node_global);
  SetPose(node_global);
}

std::optional<MeshBvh::Hit> MeshPicker::Pick(const Vec3& origin_ws, const Vec3& direction) const {
  return bvh_.FirstHit(origin_ws, direction, kFar);
}

bool MeshPicker::Visible(const Vec3& eye_ws, const Vec3& position_ws) const {
  const Vec3 way = position_ws - eye_ws;
  const double distance = glm::length(way);
  if (!(distance > 0.0)) return true;
  return !bvh_.AnyHit(eye_ws, way / distance, distance * (1.0 - kSkinDepth));
}

Vec3 MeshPicker::Position(const MeshPoint& place) const {
  return ego::Position(*character_, mesh_, place);
}

Vec3 MeshPicker::Normal(const MeshPoint& place) const {
  const auto p = static_cast<std::size_t>(place.part);
  const std::uint32_t* corner = &character_->parts[p].triangles[3 * std::size_t{place.triangle}];
  const std::vector<Vec3>& at = mesh_.position_ws[p];
  const Vec3 cross = glm::cross(at[corner[1]] - at[corner[0]], at[corner[2]] - at[corner[0]]);
  const double length = glm::length(cross);
  return length > 0.0 ? cross / length : Vec3{0.0};
}

std::optional<VertexPick> MeshPicker::NearestVertex(const PickCone& cone) const {
  // Every corner inside the cone, once.
  std::vector<VertexPick> inside;
  const auto consider = [&](int part, std::uint32_t triangle, int corner, double farthest,
                            std::vector<VertexPick>& out) {
    const auto p = static_cast<std::size_t>(part);
    const std::uint32_t vertex =
        character_->parts[p]
            .triangles[3 * std::size_t{triangle} + static_cast<std::size_t>(corner)];
    const Vec3 position = mesh_.position_ws[p][vertex];
    const Vec3 way = position - cone.origin_ws;
    const double along = glm::dot(way, cone.direction);
    const double width = cone.radius + cone.slope * along;
    if (!(along >= 0.0) || !(width > 0.0)) return;
    const double off = glm::length(way - along * cone.direction) / width;
    if (off > farthest) return;
    out.push_back({AtCorner(part, triangle, corner), vertex, position, off});
  };
  bvh_.VisitCone(cone.origin_ws, cone.direction, cone.radius, cone.slope,
                 [&](int part, std::uint32_t triangle) {
                   for (int k = 0; k < 3; ++k) consider(part, triangle, k, 1.0, inside);
                 });
  const auto before = [](const VertexPick& a, const VertexPick& b) {
    if (a.off_axis != b.off_axis) return a.off_axis < b.off_axis;
    return std::tuple(a.place.part, a.vertex, a.place.triangle) <
           std::tuple(b.place.part, b.vertex, b.place.triangle);
  };
  std::sort(inside.begin(), inside.end(), before);
  std::optional<Vec3> last;
  for (const VertexPick& candidate : inside) {
    if (last && *last == candidate.position_ws) continue;  // hidden, and asked already
    last = candidate.position_ws;
    // Of an orthographic view every vertex has an eye of its own.
    const Vec3 eye =
        cone.slope > 0.0
            ? cone.origin_ws
            : candidate.position_ws -
                  glm::dot(candidate.position_ws - cone.origin_ws, cone.direction) * cone.direction;
    if (Visible(eye, candidate.position_ws)) return candidate;
  }

  const auto hit = Pick(cone.origin_ws, cone.direction);
  if (!hit) return std::nullopt;
  std::vector<VertexPick> corners;
  for (int k = 0; k < 3; ++k) consider(hit->place.part, hit->place.triangle, k, kFar, corners);
  if (corners.empty()) return std::nullopt;
  return *std::min_element(corners.begin(), corners.end(), before);
}

}  // namespace ego
