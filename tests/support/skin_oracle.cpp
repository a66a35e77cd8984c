// SPDX-License-Identifier: MIT
#include "tests/support/skin_oracle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace ego::test {
namespace {

struct Posed {
  Skin skin;
  std::vector<std::size_t> weld;  // of vertices: the first one at the same rest position
};

Posed PoseAll(const Character& character, const Pose& pose) {
  std::vector<Mat4> nodes(character.nodes.joints.size());
  PoseNodes(character.rig, ForwardKinematics(character.rig.skeleton, pose), nodes);
  Posed posed;
  std::map<std::tuple<float, float, float>, std::size_t> first;
  for (const MeshPart& part : character.parts) {
    const std::size_t base = posed.skin.position.size();
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      Vec3 p{0.0};
      std::array<double, kJointCount> share{};
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        const auto weight = static_cast<double>(part.influences[v].weight[k]);
        if (weight == 0.0) continue;
        const PaletteEntry& entry = character.palette[part.influences[v].entry[k]];
        const auto node = static_cast<std::size_t>(entry.node);
        p += weight * Vec3(nodes[node] * entry.inverse_bind * Vec4(Vec3(part.positions[v]), 1.0));
        share[Index(character.rig.driver[node])] += weight;
      }
      const glm::vec3& rest = part.positions[v];
      posed.weld.push_back(
          first.try_emplace({rest.x, rest.y, rest.z}, posed.skin.position.size()).first->second);
      posed.skin.position.push_back(p);
      posed.skin.share.push_back(share);
    }
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      posed.skin.triangles.push_back(
          {base + part.triangles[t], base + part.triangles[t + 1], base + part.triangles[t + 2]});
    }
  }
  return posed;
}

}  // namespace

Skin SkinOf(const Character& character, const Pose& pose) { return PoseAll(character, pose).skin; }

Skin WeldedSkinOf(const Character& character) {
  return WeldedSkinOf(character, CanonicalPose(character.rig.skeleton));
}

Skin WeldedSkinOf(const Character& character, const Pose& pose) {
  const Posed posed = PoseAll(character, pose);
  Skin welded;
  std::vector<std::size_t> index(posed.weld.size());
  for (std::size_t v = 0; v < posed.weld.size(); ++v) {
    if (posed.weld[v] == v) {
      index[v] = welded.position.size();
      welded.position.push_back(posed.skin.position[v]);
      welded.share.push_back(posed.skin.share[v]);
    } else {
      index[v] = index[posed.weld[v]];
    }
  }
  for (const auto& t : posed.skin.triangles) {
    welded.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  }
  return welded;
}

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_segment = [&](const Vec3& s, const Vec3& e) {
    const double t = std::clamp(glm::dot(p - s, e - s) / glm::dot(e - s, e - s), 0.0, 1.0);
    return glm::distance(p, s + t * (e - s));
  };
  const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
  const bool inside = glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                      glm::dot(glm::cross(c - b, p - b), n) >= 0.0 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= 0.0;
  if (inside) return std::abs(glm::dot(p - a, n));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

std::optional<double> CrossingOf(const Vec3& origin, const Vec3& direction, const Vec3& a,
                                 const Vec3& b, const Vec3& c) {
  const Vec3 n = glm::cross(b - a, c - a);
  const double along = glm::dot(direction, n);
  if (along == 0.0) return std::nullopt;
  const double t = glm::dot(a - origin, n) / along;
  const Vec3 q = origin + t * direction;
  if (t < 0.0 || glm::dot(glm::cross(b - a, q - a), n) < 0.0 ||
      glm::dot(glm::cross(c - b, q - b), n) < 0.0 || glm::dot(glm::cross(a - c, q - c), n) < 0.0) {
    return std::nullopt;
  }
  return t;
}

double DistanceTo(const Vec3& p, const Skin& skin) {
  double best = 1e9;
  for (const auto& t : skin.triangles) {
    const Vec3& a = skin.position[t[0]];
    if (glm::distance(p, a) > best + 0.1) continue;
    best = std::min(best, DistanceToTriangle(p, a, skin.position[t[1]], skin.position[t[2]]));
  }
  return best;
}

bool IsInside(const Vec3& p, const Skin& skin) {
  double angle = 0.0;
  for (const auto& t : skin.triangles) {
    const Vec3 a = skin.position[t[0]] - p;
    const Vec3 b = skin.position[t[1]] - p;
    const Vec3 c = skin.position[t[2]] - p;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                 glm::dot(b, c) * la +
                                                                 glm::dot(c, a) * lb);
  }
  return angle > 2.0 * kPi;
}

double VolumeOf(const Skin& skin) {
  double volume = 0.0;
  for (const auto& t : skin.triangles) {
    volume +=
        glm::dot(skin.position[t[0]], glm::cross(skin.position[t[1]], skin.position[t[2]])) / 6.0;
  }
  return volume;
}

}  // namespace ego::test
