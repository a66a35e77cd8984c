// SPDX-License-Identifier: MIT
#include "core/egocentric/mesh_relations.h"

#include <gtest/gtest.h>

#include "tests/support/postures.h"

namespace ego::test {
namespace {

struct Outcome {
  MeshRelations relations;
  ImportanceTotal total{0.01, 0.01};
  std::array<Lanes, kTrianglePairCount> triangle{};
  std::array<double, kSampleCount> sample{};
};

Outcome Relate(const MeshQuery& query, LaneWidth lanes) {
  Outcome outcome;
  outcome.relations = RelateToMesh(query, 0, kTrunkPairCount, outcome.total, outcome.triangle,
                                   outcome.sample, lanes);
  return outcome;
}

TEST(RelateToMesh, GivesTheSameBitsInAnyWidth) {
  const Body body = TemplateBody();
  const BodyConstants constants(body);
  PosedBody posed;
  for (const std::string_view name : PostureNames()) {
    PlaceBody(body, constants, Posture(body, name), posed);
    for (std::size_t j = 0; j < kLimbPointCount; ++j) {
      const MeshQuery query{.constants = constants,
                            .posed = posed,
                            .paths = PathsFromTrunk(static_cast<LimbPoint>(j)),
                            .point = posed.point[j],
                            .thickness = constants.thickness[j],
                            .softness = 0.005,
                            .floor = 0.02,
                            .least_factor = 1e-9};
      const Outcome two = Relate(query, LaneWidth::kTwo);
      const Outcome fastest = Relate(query, FastestLanes());
      EXPECT_EQ(two.total.sum, fastest.total.sum);
      EXPECT_EQ(two.total.max, fastest.total.max);
      EXPECT_EQ(two.total.priority, fastest.total.priority);
      EXPECT_EQ(two.sample, fastest.sample);
      EXPECT_EQ(two.relations.inside, fastest.relations.inside);
      EXPECT_EQ(two.relations.along, fastest.relations.along);
      for (std::size_t t = 0; t < kTrunkPairCount; ++t) {
        for (std::size_t lane = 0; lane < kLaneCount<Lanes>; ++lane) {
          EXPECT_EQ(two.triangle[t][lane], fastest.triangle[t][lane]);
        }
      }
    }
  }
}

/// Equations 4 to 6 and appendix A written out for one triangle after the other.
TEST(RelateToMesh, AgreesWithTheEquationsTriangleByTriangle) {
  const Body body = TemplateBody();
  const BodyConstants constants(body);
  PosedBody posed;
  PlaceBody(body, constants, Posture(body, PostureNames()[0]), posed);
  for (std::size_t j = 0; j < kLimbPointCount; ++j) {
    const auto limb_point = static_cast<LimbPoint>(j);
    const MeshQuery query{.constants = constants,
                          .posed = posed,
                          .paths = PathsFromTrunk(limb_point),
                          .point = posed.point[j],
                          .thickness = constants.thickness[j],
                          .softness = 0.005,
                          .floor = 0.02,
                          .least_factor = 1e-9};
    const Outcome found = Relate(query, FastestLanes());
    Vec3 wanted{0.0};  // sum of lambda (x + v) on the performer's own body
    double sum = 0.0;
    for (std::size_t t = 0; t < kTrunkTriangleCount; ++t) {
      const SampleTriangle& s = SampleTriangles()[t];
      const Triangle triangle = Triangle::Of(posed.sample[Index(s[0])], posed.sample[Index(s[1])],
                                             posed.sample[Index(s[2])]);
      const Vec3 x = AtBarycentric(triangle, ClosestOnTriangle(triangle, query.point));
      const Vec3 v = query.point - x;
      const double lambda =
          Proximity(glm::length(v) - query.thickness, found.total.epsilon) *
          Orthogonality(glm::dot(v, triangle.normal), glm::length(v), query.softness, query.floor);
      wanted += lambda * (x + v);
      sum += lambda;
      EXPECT_NEAR(found.triangle[t / 2][t % 2], lambda, 1e-9 * lambda);
    }
    Vec3 given{0.0};
    for (std::size_t s = 0; s < kSampleCount; ++s) given += found.sample[s] * posed.sample[s];
    Vec3 displacement = query.thickness * found.relations.inside;
    for (std::size_t i = 0; i < query.paths.length; ++i) {
      displacement += constants.bone_length[query.paths.bone[i]] * found.relations.along[i];
    }
    given += posed.hips * displacement;
    EXPECT_NEAR(found.total.sum, sum, 1e-9 * sum);
    EXPECT_LT(glm::distance(given, wanted), 1e-9 * sum);
  }
}

}  // namespace
}  // namespace ego::test
