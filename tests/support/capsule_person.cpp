// SPDX-License-Identifier: MIT
#include "tests/support/capsule_person.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/body/body.h"

namespace ego::test {
namespace {

using J = HumanoidJoint;
using Weights = std::vector<std::pair<J, double>>;

struct Ring {
  Vec3 centre;
  Vec3 u;  // half axes; the ring turns from u to v, outward to the right of the way it is stacked
  Vec3 v;
  Weights weights;
};

class Builder {
 public:
  Builder(Character& character, bool rigid) : character_(character), rigid_(rigid) {
    if (!rigid_) character_.parts.emplace_back().name = "skin";
  }

  /// A closed tube through the rings, its ends capped by their middles.
  void AddTube(const char* name, const std::vector<Ring>& rings) {
    constexpr std::uint32_t kSpokes = 24;
    if (rigid_) character_.parts.emplace_back().name = name;
    MeshPart& part = character_.parts.back();
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    for (const Ring& ring : rings) {
      for (std::uint32_t k = 0; k < kSpokes; ++k) {
        const double a = 2.0 * kPi * k / kSpokes;
        Add(part, ring.centre + std::cos(a) * ring.u + std::sin(a) * ring.v, ring.weights);
      }
    }
    const auto low = static_cast<std::uint32_t>(part.positions.size());
    Add(part, rings.front().centre, rings.front().weights);
    Add(part, rings.back().centre, rings.back().weights);
    const auto rows = static_cast<std::uint32_t>(rings.size());
    for (std::uint32_t k = 0; k < kSpokes; ++k) {
      const std::uint32_t n = (k + 1) % kSpokes;
      for (std::uint32_t r = 0; r + 1 < rows; ++r) {
        const std::uint32_t a = first + r * kSpokes + k;
        const std::uint32_t b = first + r * kSpokes + n;
        part.triangles.insert(part.triangles.end(),
                              {a, b, a + kSpokes, b, b + kSpokes, a + kSpokes});
      }
      const std::uint32_t top = first + (rows - 1) * kSpokes;
      part.triangles.insert(part.triangles.end(), {low, first + n, first + k});
      part.triangles.insert(part.triangles.end(), {low + 1, top + k, top + n});
    }
  }

 private:
  void Add(MeshPart& part, const Vec3& p, const Weights& weights) const {
    part.positions.emplace_back(p);
    part.normals.emplace_back(0.0f, 1.0f, 0.0f);
    MeshPart::Influences& influences = part.influences.emplace_back();
    std::size_t heaviest = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k].second > weights[heaviest].second) heaviest = k;
    }
    for (std::size_t k = 0; k < weights.size(); ++k) {
      influences.entry[k] = static_cast<std::uint16_t>(weights[k].first);
      influences.weight[k] =
          rigid_ ? (k == heaviest ? 1.0f : 0.0f) : static_cast<float>(weights[k].second);
    }
  }

  Character& character_;
  bool rigid_;
};

/// Weights that pass from one joint to the next over `half` on either side of the second.
Weights Blend(J a, J b, double at, double half) {
  const double t = std::clamp(0.5 + 0.5 * at / half, 0.0, 1.0);
  return {{a, 1.0 - t}, {b, t}};
}

/// An ellipsoid as a stack of rings along y.
std::vector<Ring> EllipsoidRings(const Vec3& centre, const Vec3& radii, const Weights& weights) {
  std::vector<Ring> rings;
  constexpr int kRows = 24;
  for (int i = 0; i <= kRows; ++i) {
    const double a = -0.5 * kPi + kPi * std::clamp((i + 0.0) / kRows, 0.01, 0.99);
    const double r = std::cos(a);
    rings.push_back({centre + Vec3{0.0, std::sin(a) * radii.y, 0.0},
                     {0.0, 0.0, r * radii.z},
                     {r * radii.x, 0.0, 0.0},
                     weights});
  }
  return rings;
}

}  // namespace

Character MakeCapsulePerson(const CapsulePersonOptions& options) {
  Character character;
  character.name = "capsule person";
  const double s = options.height / 1.78;
  character.rig.skeleton = TemplateSkeleton(options.height);
  const auto joint = CanonicalPositions(character.rig.skeleton);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto name = static_cast<J>(j);
    JointTree::Joint node;
    node.name = std::string(Name(name));
    node.parent = j == 0 ? -1 : static_cast<int>(Index(Parent(name)));
    node.rest_local[3] = Vec4(character.rig.skeleton.offset[j], 1.0);
    character.nodes.joints.push_back(node);
    Mat4 global{1.0};
    global[3] = Vec4(joint[j], 1.0);
    character.rig.canonical_global.push_back(global);
    character.rig.driver.push_back(name);
    character.rig.node[j] = static_cast<int>(j);
    character.palette.push_back({static_cast<int>(j), glm::inverse(global)});
    character.map.joint[j] = {static_cast<int>(j), 1.0, "generated"};
  }

  Builder build(character, options.rigid);
  std::vector<Ring> trunk;
  constexpr std::array<J, 5> kSpine = {J::kHips, J::kSpine, J::kChest, J::kUpperChest, J::kNeck};
  constexpr int kRows = 40;
  for (int i = 0; i <= kRows; ++i) {
    const double y = s * glm::mix(0.84, 1.62, double(i) / kRows);
    Weights weights = {{J::kHips, 1.0}};
    for (std::size_t k = 1; k < kSpine.size(); ++k) {
      const double at = y - joint[Index(kSpine[k])].y;
      if (at > -0.04 * s) weights = Blend(kSpine[k - 1], kSpine[k], at, 0.04 * s);
    }
    const double share = y / s;
    const double neck = 1.0 / (1.0 + std::exp(-(share - 1.48) / 0.012));
    const double round = std::sqrt(std::max(0.0, 1.0 - std::pow((0.90 - share) / 0.065, 2.0)));
    const double close = share < 0.90 ? std::max(0.1, round) : 1.0;
    const double belly = options.belly * std::exp(-std::pow((share - 1.06) / 0.12, 2.0));
    const double width = close * glm::mix(0.165, 0.055, neck);
    const double depth = close * (glm::mix(0.11, 0.055, neck) + 0.5 * belly);
    const Vec3 centre{0.0, y, s * (-0.015 + 0.5 * belly)};
    trunk.push_back({centre, {0.0, 0.0, s * depth}, {s * width, 0.0, 0.0}, weights});
  }
  build.AddTube("trunk", trunk);
  build.AddTube("head", EllipsoidRings(s * Vec3{0.0, 1.665, 0.01}, s * Vec3{0.078, 0.115, 0.10},
                                       {{J::kHead, 1.0}}));
  build.AddTube("nose", EllipsoidRings(s * Vec3{0.0, 1.645, 0.105}, s * Vec3{0.012, 0.02, 0.022},
                                       {{J::kHead, 1.0}}));
  for (const Limb limb : kLimbs) {
    const LimbJoints on = JointsOf(limb);
    const Vec3 base = joint[Index(on.base)];
    const Vec3 mid = joint[Index(on.mid)];
    const Vec3 end = joint[Index(on.end)];
    const double thickness = limb == Limb::kLeftArm ? options.left_arm : 1.0;
    const double radius = s * thickness * (IsArm(limb) ? options.arm_radius : options.leg_radius);
    std::vector<Ring> tube;
    for (int i = 0; i <= 24; ++i) {
      const double t = i / 12.0;
      const Vec3 centre = t < 1.0 ? glm::mix(base, mid, t) : glm::mix(mid, end, t - 1.0);
      const Vec3 axis = CanonicalDirection(limb);
      const Vec3 u{0.0, 0.0, radius};
      tube.push_back({centre, u, glm::cross(axis, u), Blend(on.base, on.mid, t - 1.0, 0.1)});
    }
    build.AddTube("limb", tube);
    const double sign = IsLeft(limb) ? 1.0 : -1.0;
    if (IsArm(limb)) {
      build.AddTube("hand", EllipsoidRings(end + s * Vec3{sign * 0.09, 0.0, 0.0},
                                           s * Vec3{0.095, 0.016, 0.04}, {{on.end, 1.0}}));
    } else {
      build.AddTube("foot", EllipsoidRings(Vec3{end.x, 0.04 * s, end.z + 0.07 * s},
                                           s * Vec3{0.045, 0.04, 0.14}, {{on.end, 1.0}}));
    }
  }
  return character;
}

Character Mirrored(const Character& character) {
  Character mirrored = character;
  const Mat4 flip{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (Mat4& m : mirrored.rig.canonical_global) m = flip * m * flip;
  for (PaletteEntry& entry : mirrored.palette)
    entry.inverse_bind = flip * entry.inverse_bind * flip;
  for (J& driver : mirrored.rig.driver) driver = Mirror(driver);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const std::size_t m = Index(Mirror(static_cast<J>(j)));
    mirrored.map.joint[j] = character.map.joint[m];
    mirrored.rig.node[j] = character.rig.node[m];
    const Vec3 offset = character.rig.skeleton.offset[m];
    mirrored.rig.skeleton.offset[j] = {-offset.x, offset.y, offset.z};
  }
  for (MeshPart& part : mirrored.parts) {
    for (glm::vec3& p : part.positions) p.x = -p.x;
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      std::swap(part.triangles[t + 1], part.triangles[t + 2]);
    }
  }
  return mirrored;
}

Character Scaled(const Character& character, double factor) {
  Character scaled = character;
  const auto scale_translation = [&](Mat4& m) { m[3] = Vec4(factor * Vec3(m[3]), 1.0); };
  scaled.rig.skeleton = Scaled(character.rig.skeleton, factor);
  for (Mat4& m : scaled.rig.canonical_global) scale_translation(m);
  for (PaletteEntry& entry : scaled.palette) scale_translation(entry.inverse_bind);
  for (MeshPart& part : scaled.parts) {
    for (glm::vec3& p : part.positions) p *= static_cast<float>(factor);
  }
  return scaled;
}

}  // namespace ego::test
