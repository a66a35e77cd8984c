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

namespace ego {
namespace {

using J = HumanoidJoint;

const std::vector<Person>& Cast() {
  static const std::vector<Person> people = [] {
    std::vector<Person> made;
    for (const PersonParameters& p : DemoCast()) made.push_back(MakePerson(p));
    return made;
  }();
  return people;
}

/// All triangles of a character's parts, vertices of equal position made one.
struct Welded {
  std::vector<Vec3> position;
  std::vector<std::array<std::size_t, 3>> triangles;
};

Welded Weld(const Character& character) {
  Welded welded;
  std::map<std::tuple<float, float, float>, std::size_t> index;
  for (const MeshPart& part : character.parts) {
    const auto vertex = [&](std::uint32_t v) {
      const glm::vec3& p = part.positions[v];
      const auto [it, fresh] = index.try_emplace({p.x, p.y, p.z}, welded.position.size());
      if (fresh) welded.position.emplace_back(p);
      return it->second;
    };
    for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
      welded.triangles.push_back({vertex(part.triangles[t]), vertex(part.triangles[t + 1]),
                                  vertex(part.triangles[t + 2])});
    }
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

double DistanceToMesh(const Vec3& p, const Welded& mesh) {
  double best = 1e9;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.position[t[0]];
    if (glm::distance(p, a) > best + 0.1) continue;
    best = std::min(best, DistanceToTriangle(p, a, mesh.position[t[1]], mesh.position[t[2]]));
  }
  return best;
}

TEST(People, MeshesAreClosedAndFaceOutward) {
  for (const Person& person : Cast()) {
    const Welded mesh = Weld(person.character);
    std::map<std::pair<std::size_t, std::size_t>, int> edges;
    double volume = 0.0;
    double smallest = 1.0;
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
      const Vec3& a = mesh.position[t[0]];
      const Vec3& b = mesh.position[t[1]];
      const Vec3& c = mesh.position[t[2]];
      volume += glm::dot(a, glm::cross(b, c)) / 6.0;
      smallest = std::min(smallest, 0.5 * glm::length(glm::cross(b - a, c - a)));
    }
    std::size_t wrong = 0;
    for (const auto& [edge, count] : edges) {
      if (count != 1 || edges.count({edge.second, edge.first}) == 0) ++wrong;
    }
    EXPECT_EQ(wrong, 0u) << person.body.name;
    EXPECT_GT(smallest, 1e-9) << person.body.name;  // a thousandth of a square millimetre
    // As dense as water, the body mass index of a person or a cartoon of one.
    const double index = 1000.0 * volume / (person.body.height * person.body.height);
    EXPECT_GT(index, 11.0) << person.body.name;
    EXPECT_LT(index, 60.0) << person.body.name;
  }
}

TEST(People, VerticesAreFewEnoughAndWellFormed) {
  for (const Person& person : Cast()) {
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
    EXPECT_LT(vertices, 30000u) << person.body.name;
  }
}

TEST(People, NothingBleedsBetweenArmAndTrunkOrBetweenLegs) {
  for (const Person& person : Cast()) {
    const std::array<Vec3, kJointCount> joint = CanonicalPositions(person.body.skeleton);
    const double waist = joint[Index(J::kChest)].y;
    const double knee = joint[Index(J::kLeftLowerLeg)].y;
    for (const MeshPart& part : person.character.parts) {
      for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const Vec3 p(part.positions[v]);
        std::array<double, kJointCount> weight{};
        for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
          weight[part.influences[v].entry[k]] += static_cast<double>(part.influences[v].weight[k]);
        }
        const double arms = weight[Index(J::kLeftUpperArm)] + weight[Index(J::kLeftLowerArm)] +
                            weight[Index(J::kRightUpperArm)] + weight[Index(J::kRightLowerArm)];
        if (p.y < waist) {
          EXPECT_EQ(arms, 0.0);
        }
        const double left = weight[Index(J::kLeftUpperLeg)] + weight[Index(J::kLeftLowerLeg)];
        const double right = weight[Index(J::kRightUpperLeg)] + weight[Index(J::kRightLowerLeg)];
        if (p.y < 0.5 * (knee + joint[Index(J::kLeftUpperLeg)].y)) {
          EXPECT_EQ(p.x > 0.0 ? right : left, 0.0);
        }
        // Half-way along a segment one joint carries everything.
        const double elbow = joint[Index(J::kLeftLowerArm)].x;
        const double wrist = joint[Index(J::kLeftHand)].x;
        if (std::abs(p.x - 0.5 * (elbow + wrist)) < 0.02) {
          EXPECT_GT(weight[Index(J::kLeftLowerArm)], 0.95) << person.body.name;
        }
      }
    }
  }
}

TEST(People, SamplesLieOnTheMesh) {
  for (const Person& person : Cast()) {
    const Welded mesh = Weld(person.character);
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      EXPECT_LT(DistanceToMesh(person.body.surface.sample_ms[i], mesh), 0.0005)
          << person.body.name << " " << Name(static_cast<SamplePoint>(i));
      double sum = 0.0;
      for (const double w : person.body.surface.attachment[i].weight) sum += w;
      EXPECT_NEAR(sum, 1.0, 1e-9);
      const Vec3 p = person.body.surface.sample_ms[i];
      const Vec3 q = person.body.surface.sample_ms[Index(Mirror(static_cast<SamplePoint>(i)))];
      EXPECT_LT(glm::distance(p, Vec3{-q.x, q.y, q.z}), 0.004) << person.body.name;
    }
    for (const HandSurface& hand : person.body.surface.hand) {
      EXPECT_LT(DistanceToMesh(hand.palm_ms, mesh), 0.0005) << person.body.name;
      EXPECT_LT(DistanceToMesh(hand.fingertip_ms, mesh), 0.0005) << person.body.name;
      EXPECT_GT(hand.half_thickness, 0.005);
    }
    for (const FootSurface& foot : person.body.surface.foot) {
      EXPECT_NEAR(foot.heel_ms.y, 0.0, 0.002) << person.body.name;
      EXPECT_NEAR(foot.ball_ms.y, 0.0, 0.002) << person.body.name;
      EXPECT_LT(DistanceToMesh(foot.toe_tip_ms, mesh), 0.0005);
    }
  }
}

TEST(People, CrudeMeshesAreTurnedOutward) {
  for (const Person& person : Cast()) {
    double trunk = 0.0;
    double head = 0.0;
    for (std::size_t i = 0; i < kTriangleCount; ++i) {
      const SampleTriangle& t = SampleTriangles()[i];
      const auto p = [&](std::size_t k) { return person.body.surface.sample_ms[Index(t[k])]; };
      (i < kTrunkTriangleCount ? trunk : head) += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
    }
    const double cube = std::pow(person.body.height, 3.0);
    EXPECT_GT(trunk, 0.0018 * cube) << person.body.name;
    EXPECT_GT(head, 0.0002 * cube) << person.body.name;
  }
}

/// Appendix E of the paper, centimetres.
struct Wanted {
  const char* name;
  double height, arm, upper_arm, lower_arm, leg, upper_leg, lower_leg, belly;
};
constexpr std::array<Wanted, 3> kAppendixE = {{{"Child", 120, 38, 5, 4, 48, 6, 5, 17},
                                               {"Alien", 152, 42, 3, 2, 66, 5, 2, 27},
                                               {"Woman", 168, 51, 5, 4, 80, 8, 4, 16}}};

TEST(People, AppendixEIsMetOnTheMesh) {
  std::printf("            height arm   UAR   LAR   leg   ULR   LLR   belly (cm, measured)\n");
  for (const Wanted& wanted : kAppendixE) {
    const auto it = std::find_if(Cast().begin(), Cast().end(),
                                 [&](const Person& p) { return p.body.name == wanted.name; });
    ASSERT_NE(it, Cast().end());
    const Person& person = *it;
    const Skeleton& skeleton = person.body.skeleton;
    const Welded mesh = Weld(person.character);
    // Belly: the extent of the trunk's vertices around the navel's height, an independent way.
    const double navel = person.body.surface.sample_ms[Index(SamplePoint::kNavel)].y;
    double front = -1.0;
    double back = 1.0;
    double top = 0.0;
    for (const Vec3& p : mesh.position) {
      top = std::max(top, p.y);
      if (std::abs(p.y - navel) > 0.02 || std::abs(p.x) > 0.04) continue;
      front = std::max(front, p.z);
      back = std::min(back, p.z);
    }
    // Radii: mean distance of vertices from the bone around the segment's middle.
    const std::array<Vec3, kJointCount> joint = CanonicalPositions(skeleton);
    const auto radius = [&](J start, J end) {
      const Vec3 a = joint[Index(start)];
      const Vec3 d = joint[Index(end)] - a;
      // Rings of equal weight, since the mesh is denser towards the hands.
      std::array<double, 6> sum{};
      std::array<int, 6> count{};
      for (const Vec3& p : mesh.position) {
        const double t = glm::dot(p - a, d) / glm::dot(d, d);
        const double r = glm::length(p - a - t * d);
        if (t < 0.3 || t >= 0.7 || r > 0.13 || p.x < 0.0) continue;
        const auto ring = static_cast<std::size_t>((t - 0.3) / 0.4 * 6.0);
        sum[ring] += r;
        ++count[ring];
      }
      double mean = 0.0;
      for (std::size_t ring = 0; ring < 6; ++ring) mean += sum[ring] / count[ring] / 6.0;
      return mean;
    };
    const double arm = BoneLength(skeleton, J::kLeftLowerArm) + BoneLength(skeleton, J::kLeftHand);
    const double leg = BoneLength(skeleton, J::kLeftLowerLeg) + BoneLength(skeleton, J::kLeftFoot);
    const double uar = radius(J::kLeftUpperArm, J::kLeftLowerArm);
    const double lar = radius(J::kLeftLowerArm, J::kLeftHand);
    const double ulr = radius(J::kLeftUpperLeg, J::kLeftLowerLeg);
    const double llr = radius(J::kLeftLowerLeg, J::kLeftFoot);
    std::printf("%-11s %6.1f %5.1f %5.2f %5.2f %5.1f %5.2f %5.2f %5.2f\n", wanted.name, 100 * top,
                100 * arm, 100 * uar, 100 * lar, 100 * leg, 100 * ulr, 100 * llr,
                100 * (front - back));
    EXPECT_NEAR(100 * top, wanted.height, 0.1);
    EXPECT_NEAR(100 * arm, wanted.arm, 1e-6);
    EXPECT_NEAR(100 * leg, wanted.leg, 1e-6);
    EXPECT_NEAR(100 * uar / wanted.upper_arm, 1.0, 0.03);
    EXPECT_NEAR(100 * lar / wanted.lower_arm, 1.0, 0.03);
    EXPECT_NEAR(100 * ulr / wanted.upper_leg, 1.0, 0.03);
    EXPECT_NEAR(100 * llr / wanted.lower_leg, 1.0, 0.03);
    EXPECT_NEAR(100 * (front - back) / wanted.belly, 1.0, 0.03);
    // What the calibration says of itself.
    using L = LimbSegment;
    const auto calibrated = [&](L s) { return 100 * person.body.surface.limb_radius[Index(s)]; };
    EXPECT_NEAR(calibrated(L::kLeftUpperArm) / wanted.upper_arm, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kRightForearm) / wanted.lower_arm, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kLeftThigh) / wanted.upper_leg, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kRightCalf) / wanted.lower_leg, 1.0, 0.02);
  }
}

TEST(People, EqualParametersGiveBitEqualPeople) {
  const Person& first = Cast()[1];
  const Person again = MakePerson(DemoCast()[1]);
  ASSERT_EQ(again.character.parts.size(), first.character.parts.size());
  for (std::size_t i = 0; i < first.character.parts.size(); ++i) {
    const MeshPart& a = first.character.parts[i];
    const MeshPart& b = again.character.parts[i];
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_TRUE(a.positions == b.positions);
    EXPECT_TRUE(a.normals == b.normals);
  }
  EXPECT_TRUE(again.body.surface.sample_ms == first.body.surface.sample_ms);
  EXPECT_EQ(again.body.surface.limb_radius, first.body.surface.limb_radius);
}

TEST(People, RigIsTheCanonicalPose) {
  for (const Person& person : Cast()) {
    const Rig& rig = person.character.rig;
    std::vector<Mat4> nodes(person.character.nodes.joints.size());
    PoseNodes(rig, ForwardKinematics(rig.skeleton, CanonicalPose(rig.skeleton)), nodes);
    const std::vector<Mat4> rest = person.character.nodes.RestGlobal();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (int c = 0; c < 4; ++c) {
        EXPECT_LT(glm::length(nodes[n][c] - rest[n][c]), 1e-12);
      }
    }
    for (const PaletteEntry& entry : person.character.palette) {
      const Mat4 m = nodes[static_cast<std::size_t>(entry.node)] * entry.inverse_bind;
      EXPECT_LT(glm::length(m[3] - Vec4(0.0, 0.0, 0.0, 1.0)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace ego
