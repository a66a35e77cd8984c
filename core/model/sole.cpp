// SPDX-License-Identifier: MIT
#include "core/model/sole.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/model/mesh_point.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// Forward and up.
struct SidePoint {
  double z = 0.0;
  double y = 0.0;
};

/// The skin of foot and toes seen from the side, from back to front.
std::vector<SidePoint> SideView(const Character& character, bool left) {
  const std::size_t foot = Index(left ? J::kLeftFoot : J::kRightFoot);
  const std::size_t toes = Index(left ? J::kLeftToes : J::kRightToes);
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  std::vector<SidePoint> points;
  for (const MeshPart& part : character.parts) {
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      const auto shares = JointShares(character, part, v);
      if (shares[foot] + shares[toes] < 0.5) continue;
      const Vec3 at = SkinVertex(part, skin, v);
      points.push_back({at.z, at.y});
    }
  }
  std::sort(points.begin(), points.end(), [](const SidePoint& a, const SidePoint& b) {
    return a.z != b.z ? a.z < b.z : a.y < b.y;
  });
  return points;
}

/// Andrew's monotone chain, lower half.
std::vector<SidePoint> LowerHull(const std::vector<SidePoint>& points) {
  std::vector<SidePoint> hull;
  for (const SidePoint& p : points) {
    while (hull.size() >= 2) {
      const SidePoint& a = hull[hull.size() - 2];
      const SidePoint& b = hull.back();
      if ((b.z - a.z) * (p.y - a.y) - (b.y - a.y) * (p.z - a.z) > 0.0) break;
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

}  // namespace

std::optional<double> SoleSlope(const Character& character, bool left) {
  const std::vector<SidePoint> points = SideView(character, left);
  if (points.size() < 3) return {};
  // Skin on edge, or a foot that hangs straight down, does not say what it would stand on.
  constexpr double kLeastLengthPerHeight = 0.1;
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(),
                          [](const SidePoint& a, const SidePoint& b) { return a.y < b.y; });
  const double length = points.back().z - points.front().z;
  if (!(length > kLeastLengthPerHeight * (high->y - low->y))) return {};
  const double middle = 0.5 * (points.front().z + points.back().z);
  const std::vector<SidePoint> hull = LowerHull(points);
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const SidePoint& back = hull[i];
    const SidePoint& front = hull[i + 1];
    if (back.z <= middle && front.z > middle) {
      return std::atan2(back.y - front.y, front.z - back.z);
    }
  }
  return {};
}

}  // namespace ego
