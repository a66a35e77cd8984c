// SPDX-License-Identifier: MIT
#include "core/egocentric/clearance.h"

#include <gtest/gtest.h>

#include "core/geometry/closest_point.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

PosedBody Place(const Body& body, const Pose& pose) {
  PosedBody posed;
  PlaceBody(body, BodyConstants(body), pose, posed);
  return posed;
}

void ExpectEqual(const QuadVectors& a, const QuadVectors& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
}

TEST(PlaceTriangles, GivesTheSameBitsInAnyWidth) {
  const Body& body = StudioPerformer();
  const BodyConstants constants(body);
  for (const auto& [name, pose] : StudioPostures()) {
    PosedBody two = Place(body, pose);
    PosedBody fastest = two;
    PlaceTriangles(body, constants, two, LaneWidth::kTwo);
    PlaceTriangles(body, constants, fastest, FastestLanes());
    for (std::size_t q = 0; q < kTriangleQuadCount; ++q) {
      ExpectEqual(two.triangle[q].normal, fastest.triangle[q].normal);
      ExpectEqual(two.triangle[q].a, fastest.triangle[q].a);
      EXPECT_EQ(two.triangle[q].per_bc, fastest.triangle[q].per_bc);
      EXPECT_EQ(two.triangle[q].per_square, fastest.triangle[q].per_square);
      ExpectEqual(two.tangent[q].along, fastest.tangent[q].along);
      ExpectEqual(two.tangent[q].third, fastest.tangent[q].third);
    }
  }
}

TEST(PlaceTriangles, MakesRightHandedTangentFrames) {
  const PosedBody posed = Place(StudioPerformer(), Posture("standing"));
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    const Vec3 normal = posed.triangle[t / 4].normal.At(t % 4);
    const Vec3 along = posed.tangent[t / 4].along.At(t % 4);
    EXPECT_NEAR(glm::length(along), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(along, normal), 0.0, 1e-12);
    EXPECT_LT(glm::distance(posed.tangent[t / 4].third.At(t % 4), glm::cross(normal, along)),
              1e-12);
  }
}

TEST(MeasureClearance, GivesTheSameBitsInAnyWidth) {
  const Body& body = StudioPerformer();
  for (const auto& [name, pose] : StudioPostures()) {
    const PosedBody posed = Place(body, pose);
    EgocentricPose::ArmClearance two;
    EgocentricPose::ArmClearance fastest;
    MeasureClearance(body, posed, Limb::kLeftArm, two, LaneWidth::kTwo);
    MeasureClearance(body, posed, Limb::kLeftArm, fastest, FastestLanes());
    for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
      for (std::size_t o = 0; o < kObstacleCount; ++o) {
        EXPECT_EQ(two[s][o].known, fastest[s][o].known);
        EXPECT_EQ(two[s][o].distance, fastest[s][o].distance);
        EXPECT_EQ(two[s][o].direction_ls, fastest[s][o].direction_ls);
        EXPECT_EQ(two[s][o].trust, fastest[s][o].trust);
      }
    }
  }
}

TEST(MeasureClearance, IsTheDistanceBetweenSphereAndCapsule) {
  const Body& body = StudioPerformer();
  for (const auto& [name, pose] : StudioPostures()) {
    const PosedBody posed = Place(body, pose);
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      EgocentricPose::ArmClearance clearance;
      MeasureClearance(body, posed, arm, clearance);
      for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
        const ArmSample sample = SampleOf(body, posed, arm, s);
        for (std::size_t o = kFirstCapsuleObstacle; o < kObstacleCount; ++o) {
          const PosedCapsule& capsule =
              o + 1 == kObstacleCount
                  ? posed.hand[Index(Mirror(arm))]
                  : posed.capsule[Index(OtherSegment(arm, o - kFirstCapsuleObstacle))];
          const double t = ClosestOnSegment(sample.center, capsule.start, capsule.end);
          const Vec3 away = sample.center - capsule.At(t);
          const Clearance& found = clearance[s][o];
          const double distance = glm::length(away) - capsule.radius - sample.radius;
          EXPECT_TRUE(found.known);
          EXPECT_NEAR(found.distance * body.height, distance, 1e-12);
          EXPECT_LT(glm::distance(capsule.frame * found.direction_ls, glm::normalize(away)), 1e-9);
          if (distance >= 0.0) {
            EXPECT_EQ(found.trust, 1.0);
          } else {
            EXPECT_LE(found.trust, 1.0 + 1e-12);
            EXPECT_GE(found.trust, 0.0);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace ego::test
