// SPDX-License-Identifier: MIT
#include "core/model/mesh_bvh.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/support/capsule_person.h"
#include "tests/support/skin_oracle.h"

namespace ego {
namespace {

class MeshBvhTest : public ::testing::Test {
 protected:
  const Character character_ = test::MakeCapsulePerson();
  const PosedMesh mesh_ = CanonicalMesh(character_);
  const MeshBvh bvh_{character_, mesh_};
  std::mt19937 random_{7};

  Vec3 RandomPoint() {
    std::uniform_real_distribution<double> x(-1.0, 1.0);
    std::uniform_real_distribution<double> y(-0.2, 2.0);
    return {x(random_), y(random_), 0.4 * x(random_)};
  }
  template <class Visit>
  void EachTriangle(const Visit& visit) const {
    for (std::size_t p = 0; p < character_.parts.size(); ++p) {
      const auto& index = character_.parts[p].triangles;
      for (std::size_t t = 0; t < index.size(); t += 3) {
        visit(mesh_.position_ws[p][index[t]], mesh_.position_ws[p][index[t + 1]],
              mesh_.position_ws[p][index[t + 2]]);
      }
    }
  }
};

// A second formulation: where the ray meets the plane, and on which side of each edge that is.
TEST_F(MeshBvhTest, FindsTheCrossingsThatBruteForceFinds) {
  for (int i = 0; i < 60; ++i) {
    const Vec3 origin = RandomPoint();
    const Vec3 direction = glm::normalize(RandomPoint() - origin);
    std::vector<double> expected;
    EachTriangle([&](const Vec3& a, const Vec3& b, const Vec3& c) {
      if (const auto t = test::CrossingOf(origin, direction, a, b, c)) expected.push_back(*t);
    });
    std::sort(expected.begin(), expected.end());
    const auto hits = bvh_.AllHits(origin, direction, 1e6);
    ASSERT_EQ(hits.size(), expected.size()) << "ray " << i;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_NEAR(hits[k].distance, expected[k], 1e-9);
      EXPECT_TRUE(IsOn(character_, hits[k].place));
      EXPECT_LT(glm::distance(Position(character_, mesh_, hits[k].place),
                              origin + hits[k].distance * direction),
                1e-8);
    }
  }
}

// No point of any triangle, densely sampled, is nearer than the answer; and the answer is on one.
TEST_F(MeshBvhTest, NoSampleOfTheSkinIsNearerThanTheNearestPlace) {
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = RandomPoint();
    const auto hit = bvh_.Nearest(p);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(glm::distance(p, hit->position_ws), hit->distance, 1e-12);
    EXPECT_LT(glm::distance(Position(character_, mesh_, hit->place), hit->position_ws), 1e-12);
    double least = 1e9;
    EachTriangle([&](const Vec3& a, const Vec3& b, const Vec3& c) {
      for (int u = 0; u <= 4; ++u) {
        for (int v = 0; u + v <= 4; ++v) {
          least = std::min(least, glm::distance(p, a + 0.25 * u * (b - a) + 0.25 * v * (c - a)));
        }
      }
    });
    EXPECT_LE(hit->distance, least + 1e-12);
    EXPECT_GT(hit->distance, least - 0.02);  // the samples are at most 2 cm apart
  }
}

TEST_F(MeshBvhTest, LeavesOutWhatTheFilterRefusesAndEmptyMeshesAnswerNothing) {
  const MeshBvh none(character_, mesh_, [](int, std::uint32_t) { return false; });
  EXPECT_TRUE(none.Empty());
  EXPECT_FALSE(none.Nearest({0.0, 1.0, 0.0}).has_value());
  EXPECT_TRUE(none.AllHits({0.0, 1.0, 0.0}, kUp, 10.0).empty());
  const MeshBvh even(character_, mesh_, [](int, std::uint32_t t) { return t % 2 == 0; });
  EXPECT_EQ(even.Nearest({0.0, 1.0, 0.3})->place.triangle % 2, 0u);
}

}  // namespace
}  // namespace ego
