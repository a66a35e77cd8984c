// SPDX-License-Identifier: MIT
#include "assets/motions/skin_measure.h"

#include <algorithm>
#include <limits>

#include "core/geometry/closest_point.h"
#include "core/model/mesh_bvh.h"
#include "core/model/rig.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kFarShare = 0.5;  // of upper arm and thigh

int LimbOfJoint(J joint) {
  const std::optional<Limb> limb = LimbOf(joint);
  return limb ? static_cast<int>(*limb) : -1;
}

struct AxisBox {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};
  void Grow(const Vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool Holds(const Vec3& p) const {
    return glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
  }
};

/// Whether a point lies within closed skin: most of three rays leave it more often than they enter.
/// The triangle nearest to a point alone does not tell where hems and seams are sharp.
bool Within(const MeshBvh& skin, const Vec3& p) {
  constexpr double kFar = 4.0;
  int votes = 0;
  for (const Vec3& toward :
       {Vec3{0.61, 0.37, 0.70}, Vec3{-0.53, 0.75, -0.40}, Vec3{0.21, -0.64, -0.74}}) {
    const Vec3 direction = glm::normalize(toward);
    int leaves = 0;
    for (const MeshBvh::Hit& hit : skin.AllHits(p, direction, kFar)) {
      leaves += glm::dot(hit.normal_ws, direction) > 0.0 ? 1 : -1;
    }
    votes += leaves > 0 ? 1 : 0;
  }
  return votes >= 2;
}

}  // namespace

std::optional<Limb> LimbOf(HumanoidJoint joint) {
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    if (joint == joints.base || joint == joints.mid || joint == joints.end) return limb;
  }
  if (joint == J::kLeftToes) return Limb::kLeftLeg;
  if (joint == J::kRightToes) return Limb::kRightLeg;
  return std::nullopt;
}

SkinMeasure::SkinMeasure(const Character& character)
    : character_(character), mesh_(CanonicalMesh(character)) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(character.rig.skeleton);
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const MeshPart& part = character.parts[p];
    std::vector<Vertex>& vertices = vertices_.emplace_back(part.positions.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const std::array<double, kJointCount> shares = JointShares(character, part, v);
      Vertex& vertex = vertices[v];
      vertex.joint =
          static_cast<J>(std::max_element(shares.begin(), shares.end()) - shares.begin());
      vertex.limb = LimbOfJoint(vertex.joint);
      if (vertex.limb < 0) continue;
      const LimbJoints joints = JointsOf(static_cast<Limb>(vertex.limb));
      vertex.far = true;
      if (vertex.joint == joints.base) {
        const Vec3& base = canonical[Index(joints.base)];
        const Vec3 bone = canonical[Index(joints.mid)] - base;
        vertex.far =
            glm::dot(mesh_.position_ws[p][v] - base, bone) > kFarShare * glm::dot(bone, bone);
      }
    }
  }
}

void SkinMeasure::SetPose(const Pose& pose) {
  std::vector<Mat4> nodes(character_.nodes.joints.size());
  PoseNodes(character_.rig, pose, nodes);
  mesh_ = PoseMesh(character_, nodes);
}

SkinMeasure::Sinking SkinMeasure::Deepest() const {
  std::array<AxisBox, kJointCount> boxes;
  for (std::size_t p = 0; p < vertices_.size(); ++p) {
    for (std::size_t v = 0; v < vertices_[p].size(); ++v) {
      boxes[Index(vertices_[p][v].joint)].Grow(mesh_.position_ws[p][v]);
    }
  }
  Sinking deepest;
  for (const Limb limb : kLimbs) {
    // Only what lies within the box of something else can lie within that.
    std::vector<std::pair<Vec3, J>> suspects;
    for (std::size_t p = 0; p < vertices_.size(); ++p) {
      for (std::size_t v = 0; v < vertices_[p].size(); ++v) {
        const Vertex& vertex = vertices_[p][v];
        if (vertex.limb != static_cast<int>(limb) || !vertex.far) continue;
        const Vec3& at = mesh_.position_ws[p][v];
        for (std::size_t j = 0; j < kJointCount; ++j) {
          if (LimbOfJoint(static_cast<J>(j)) == vertex.limb || !boxes[j].Holds(at)) continue;
          suspects.emplace_back(at, vertex.joint);
          break;
        }
      }
    }
    if (suspects.empty()) continue;
    const MeshBvh rest(character_, mesh_, [&](int p, std::uint32_t t) {
      const auto part = static_cast<std::size_t>(p);
      const std::uint32_t* corner = &character_.parts[part].triangles[std::size_t{3} * t];
      return std::none_of(corner, corner + 3, [&](std::uint32_t v) {
        return vertices_[part][v].limb == static_cast<int>(limb);
      });
    });
    for (const auto& [at, joint] : suspects) {
      const auto hit = rest.Nearest(at);
      if (!hit || hit->distance <= deepest.depth) continue;
      if (glm::dot(at - hit->position_ws, hit->normal_ws) >= 0.0 || !Within(rest, at)) continue;
      const auto part = static_cast<std::size_t>(hit->place.part);
      const std::uint32_t vertex =
          character_.parts[part].triangles[std::size_t{3} * hit->place.triangle];
      deepest = {hit->distance, joint, vertices_[part][vertex].joint};
    }
  }
  return deepest;
}

double SkinMeasure::Gap(const Vec3& point_ws, Limb without) const {
  double best = std::numeric_limits<double>::max();
  double signed_best = best;
  for (std::size_t p = 0; p < vertices_.size(); ++p) {
    const std::vector<Vec3>& position = mesh_.position_ws[p];
    const std::vector<std::uint32_t>& triangles = character_.parts[p].triangles;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
      const Vec3& a = position[triangles[t]];
      const Vec3& b = position[triangles[t + 1]];
      const Vec3& c = position[triangles[t + 2]];
      // No edge is longer than this; what is farther than the best so far cannot win.
      const double edge = std::max(glm::distance(a, b), glm::distance(a, c));
      if (glm::distance(a, point_ws) - edge > best) continue;
      if (vertices_[p][triangles[t]].limb == static_cast<int>(without) ||
          vertices_[p][triangles[t + 1]].limb == static_cast<int>(without) ||
          vertices_[p][triangles[t + 2]].limb == static_cast<int>(without)) {
        continue;
      }
      const Triangle triangle = Triangle::Of(a, b, c);
      if (triangle.area <= 0.0) continue;
      const Vec3 nearest = AtBarycentric(triangle, ClosestOnTriangle(triangle, point_ws));
      const double distance = glm::distance(nearest, point_ws);
      if (distance >= best) continue;
      best = distance;
      signed_best = glm::dot(point_ws - nearest, triangle.normal) < 0.0 ? -distance : distance;
    }
  }
  return signed_best;
}

}  // namespace ego
