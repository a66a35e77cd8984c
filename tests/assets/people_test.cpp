// SPDX-License-Identifier: MIT
#include "assets/people/person.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/skeleton/pose.h"
#include "tests/support/skin_oracle.h"
#include "tests/support/studio_people.h"

namespace ego {
namespace {

using J = HumanoidJoint;

using test::DistanceTo;
using test::IsInside;
using test::Skin;
using test::SomePeople;
using test::VolumeOf;
using test::WeldedSkinOf;

/// Number of pieces that no edge joins.
std::size_t Pieces(const Skin& skin) {
  std::vector<std::size_t> root(skin.position.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::size_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& t : skin.triangles) {
    root[find(t[0])] = find(t[1]);
    root[find(t[1])] = find(t[2]);
  }
  std::size_t count = 0;
  for (std::size_t v = 0; v < root.size(); ++v) count += root[v] == v ? 1 : 0;
  return count;
}

/// Whether every edge joins two triangles that run along it in opposite directions; and its
/// Euler characteristic.
int ExpectClosed(const Skin& skin, const std::string& name) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const auto& t : skin.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  std::size_t wrong = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1 || edges.count({edge.second, edge.first}) == 0) ++wrong;
  }
  EXPECT_EQ(wrong, 0u) << name;
  return static_cast<int>(skin.position.size()) - static_cast<int>(edges.size() / 2) +
         static_cast<int>(skin.triangles.size());
}

TEST(People, MeshesAreClosedBallsThatFaceOutward) {
  for (const PersonParameters& parameters : StudioCast()) {
    const Person person = MakePerson(parameters);
    const Skin mesh = WeldedSkinOf(person.character);
    // Each piece has the topology of a ball: no hole through a hand, no handle at an ear.
    EXPECT_EQ(ExpectClosed(mesh, person.body.name), 2 * static_cast<int>(Pieces(mesh)))
        << person.body.name;
    std::size_t flat = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3& a = mesh.position[t[0]];
      const double area =
          0.5 * glm::length(glm::cross(mesh.position[t[1]] - a, mesh.position[t[2]] - a));
      if (area < 1e-10) ++flat;  // a ten-thousandth of a square millimetre
    }
    EXPECT_EQ(flat, 0u) << person.body.name;
    // As dense as water, the body mass index of a person or a cartoon of one.
    const double index = 1000.0 * VolumeOf(mesh) / (person.body.height * person.body.height);
    EXPECT_GT(index, 11.0) << person.body.name;
    EXPECT_LT(index, 60.0) << person.body.name;
  }
}

TEST(People, ASoftBodyIsOneSkin) {
  for (const Person& person : SomePeople()) {
    if (person.body.name == "Robot") continue;
    Character body = person.character;
    std::erase_if(body.parts, [](const MeshPart& part) {
      return part.name == "Brows" || part.name == "Mouth" || part.name == "Shine";
    });
    EXPECT_EQ(Pieces(WeldedSkinOf(body)), 1u) << person.body.name;
  }
}

TEST(People, TextureCoordinatesLieInTheUnitSquareAndHaveArea) {
  for (const Person& person : SomePeople()) {
    double covered = 0.0;
    for (const MeshPart& part : person.character.parts) {
      ASSERT_EQ(part.uvs.size(), part.positions.size()) << person.body.name;
      for (const glm::vec2& uv : part.uvs) {
        ASSERT_GE(std::min(uv.x, uv.y), 0.0f);
        ASSERT_LE(std::max(uv.x, uv.y), 1.0f);
      }
      for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
        const auto at = [&](std::size_t c) { return Vec3(part.positions[part.triangles[t + c]]); };
        const auto uv = [&](std::size_t c) { return Vec2(part.uvs[part.triangles[t + c]]); };
        const double area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        const Vec2 u = uv(1) - uv(0);
        const Vec2 v = uv(2) - uv(0);
        const double flat = 0.5 * std::abs(u.x * v.y - u.y * v.x);
        covered += flat;
        // Triangles too small for float coordinates do not tell.
        if (area > 1e-7) {
          EXPECT_GT(flat, 0.01 * area) << person.body.name << " " << part.name;
        }
      }
    }
    EXPECT_GT(covered, 0.15) << person.body.name;  // of the unit square
  }
}

TEST(People, FingerJointsLieInTheirFingersAndCarryThem) {
  for (const Person& person : SomePeople()) {
    const Character& character = person.character;
    const Skin skin = WeldedSkinOf(character);
    std::size_t found = 0;
    for (std::size_t n = 0; n < character.nodes.joints.size(); ++n) {
      const std::string& name = character.nodes.joints[n].name;
      const bool finger = name.find("Proximal") != std::string::npos ||
                          name.find("Intermediate") != std::string::npos ||
                          name.find("Distal") != std::string::npos ||
                          name.find("Metacarpal") != std::string::npos;
      if (!finger) continue;
      ++found;
      const Vec3 at(character.rig.canonical_global[n][3]);
      EXPECT_EQ(character.rig.driver[n], at.x > 0.0 ? J::kLeftHand : J::kRightHand);
      // Inside: skin both above and below, close by.
      EXPECT_LT(DistanceTo(at, skin), 0.09 * person.body.height / 1.7) << name;
      EXPECT_TRUE(IsInside(at, skin)) << person.body.name << " " << name;
      double most = 0.0;
      for (const MeshPart& part : character.parts) {
        for (const MeshPart::Influences& influences : part.influences) {
          for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
            if (character.palette[influences.entry[k]].node == static_cast<int>(n)) {
              most = std::max(most, static_cast<double>(influences.weight[k]));
            }
          }
        }
      }
      EXPECT_GT(most, 0.8) << person.body.name << " " << name;
    }
    EXPECT_EQ(found, 30u) << person.body.name;
  }
}

TEST(People, FingersAreRoundToTheirTips) {
  for (const Person& person : SomePeople()) {
    if (person.body.name == "Robot") continue;  // made of blocks
    const Skin skin = WeldedSkinOf(person.character);
    const double wrist = CanonicalPositions(person.body.skeleton)[Index(J::kLeftHand)].x;
    const double tip = person.body.surface.hand[0].fingertip_ms.x;
    std::map<std::pair<std::size_t, std::size_t>, Vec3> normal_beside;
    for (const auto& t : skin.triangles) {
      const Vec3& a = skin.position[t[0]];
      const Vec3 normal = glm::cross(skin.position[t[1]] - a, skin.position[t[2]] - a);
      for (std::size_t k = 0; k < 3; ++k) {
        normal_beside[{t[k], t[(k + 1) % 3]}] = glm::normalize(normal);
      }
    }
    // Past the webs; the fold at an edge, degrees.
    std::vector<double> folds;
    for (const auto& [edge, normal] : normal_beside) {
      const double x = std::abs(skin.position[edge.first].x);
      if (x < glm::mix(wrist, tip, 0.68)) continue;
      const Vec3& other = normal_beside.at({edge.second, edge.first});
      folds.push_back(Degrees(std::acos(std::clamp(glm::dot(normal, other), -1.0, 1.0))));
    }
    std::sort(folds.begin(), folds.end());
    ASSERT_GT(folds.size(), 1000u) << person.body.name;
    std::printf("%-20s folds of fingers: 99 of 100 below %.0f, sharpest %.0f degrees\n",
                person.body.name.c_str(), folds[folds.size() * 99 / 100], folds.back());
    EXPECT_LT(folds[folds.size() * 99 / 100], 42.0) << person.body.name;
    EXPECT_LT(folds.back(), 60.0) << person.body.name;
  }
}

/// A joint of one person turned, and how much of the limb that bends may be lost.
struct Bend {
  const char* name;
  J joint;
  Vec3 axis;
  double degrees;
  LimbSegment limb;
  double most;  // loss, as a share of the limb's volume
};

TEST(People, BentJointsKeepTheirVolume) {
  const std::array<Bend, 6> bends = {
      {{"elbow 90", J::kLeftLowerArm, {0.0, -1.0, 0.0}, 90.0, LimbSegment::kLeftUpperArm, 0.08},
       {"elbow 130", J::kLeftLowerArm, {0.0, -1.0, 0.0}, 130.0, LimbSegment::kLeftUpperArm, 0.16},
       {"knee 120", J::kLeftLowerLeg, {1.0, 0.0, 0.0}, 120.0, LimbSegment::kLeftThigh, 0.10},
       {"arm down 80", J::kLeftUpperArm, {0.0, 0.0, -1.0}, 80.0, LimbSegment::kLeftUpperArm, 0.20},
       {"arm up 80", J::kLeftUpperArm, {0.0, 0.0, 1.0}, 80.0, LimbSegment::kLeftUpperArm, 0.20},
       {"hip 90", J::kLeftUpperLeg, {-1.0, 0.0, 0.0}, 90.0, LimbSegment::kLeftThigh, 0.25}}};
  std::printf("volume lost, per cent of the limb's own\n%-20s", "");
  for (const Bend& bend : bends) std::printf("%12s", bend.name);
  std::printf("\n");
  for (const Person& person : SomePeople()) {
    if (person.body.name == "Robot") continue;  // rigid
    const Skeleton& skeleton = person.body.skeleton;
    const double rest = VolumeOf(WeldedSkinOf(person.character));
    std::printf("%-20s", person.body.name.c_str());
    for (const Bend& bend : bends) {
      Pose pose = CanonicalPose(skeleton);
      pose.rotation_ls[Index(bend.joint)] = glm::angleAxis(Radians(bend.degrees), bend.axis);
      const double radius = person.body.surface.limb_radius[Index(bend.limb)];
      const double limb = kPi * radius * radius * BoneLength(skeleton, EndJoint(bend.limb));
      const double lost = (rest - VolumeOf(WeldedSkinOf(person.character, pose))) / limb;
      std::printf("%12.1f", 100.0 * lost);
      EXPECT_LT(std::abs(lost), bend.most) << person.body.name << " " << bend.name;
    }
    std::printf("\n");
  }
}

TEST(People, VerticesAreFewEnoughAndWellFormed) {
  for (const Person& person : SomePeople()) {
    std::size_t vertices = 0;
    for (const MeshPart& part : person.character.parts) {
      ASSERT_EQ(part.normals.size(), part.positions.size());
      ASSERT_EQ(part.influences.size(), part.positions.size());
      ASSERT_GE(part.material, 0);
      ASSERT_LT(static_cast<std::size_t>(part.material), person.character.materials.size());
      vertices += part.positions.size();
      for (std::size_t v = 0; v < part.positions.size(); ++v) {
        EXPECT_NEAR(glm::length(part.normals[v]), 1.0f, 1e-4f);
        float sum = 0.0f;
        for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
          sum += part.influences[v].weight[k];
          ASSERT_LT(part.influences[v].entry[k], person.character.palette.size());
          ASSERT_GE(part.influences[v].weight[k], 0.0f);
        }
        ASSERT_NEAR(sum, 1.0f, 1e-5f);
      }
    }
    EXPECT_GT(vertices, 6000u) << person.body.name;
    EXPECT_LT(vertices, 20000u) << person.body.name;
  }
}

TEST(People, NothingBleedsBetweenArmAndTrunkOrBetweenLegs) {
  for (const Person& person : SomePeople()) {
    const std::array<Vec3, kJointCount> joint = CanonicalPositions(person.body.skeleton);
    const double waist = joint[Index(J::kChest)].y;
    const double knee = joint[Index(J::kLeftLowerLeg)].y;
    const Skin skin = WeldedSkinOf(person.character);
    for (std::size_t v = 0; v < skin.position.size(); ++v) {
      const Vec3& p = skin.position[v];
      const auto weight = [&](J j) { return skin.share[v][Index(j)]; };
      const double arms = weight(J::kLeftUpperArm) + weight(J::kLeftLowerArm) +
                          weight(J::kRightUpperArm) + weight(J::kRightLowerArm);
      if (p.y < waist) {
        EXPECT_EQ(arms, 0.0);
      }
      const double left = weight(J::kLeftUpperLeg) + weight(J::kLeftLowerLeg);
      const double right = weight(J::kRightUpperLeg) + weight(J::kRightLowerLeg);
      if (p.y < 0.5 * (knee + joint[Index(J::kLeftUpperLeg)].y)) {
        EXPECT_EQ(p.x > 0.0 ? right : left, 0.0);
      }
      // Half-way along a segment one joint carries everything.
      const double elbow = joint[Index(J::kLeftLowerArm)].x;
      const double wrist = joint[Index(J::kLeftHand)].x;
      if (std::abs(p.x - 0.5 * (elbow + wrist)) < 0.02) {
        EXPECT_GT(weight(J::kLeftLowerArm), 0.95) << person.body.name;
      }
    }
  }
}

TEST(People, EqualParametersGiveBitEqualPeople) {
  for (const char* name : {"Child", "Robot"}) {
    const auto named = [&](const Person& person) { return person.body.name == name; };
    const Person& first = *std::find_if(SomePeople().begin(), SomePeople().end(), named);
    const auto parameters = DemoCast();
    const Person again = MakePerson(*std::find_if(parameters.begin(), parameters.end(),
                                                  [&](const auto& p) { return p.name == name; }));
    ASSERT_EQ(again.character.parts.size(), first.character.parts.size());
    for (std::size_t i = 0; i < first.character.parts.size(); ++i) {
      const MeshPart& a = first.character.parts[i];
      const MeshPart& b = again.character.parts[i];
      EXPECT_EQ(a.triangles, b.triangles);
      EXPECT_TRUE(a.positions == b.positions);
      EXPECT_TRUE(a.normals == b.normals);
      EXPECT_TRUE(a.uvs == b.uvs);
    }
    EXPECT_TRUE(again.body.surface.sample_ms == first.body.surface.sample_ms);
    EXPECT_EQ(again.body.surface.limb_radius, first.body.surface.limb_radius);
  }
}

}  // namespace
}  // namespace ego
