// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/math.h"
#include "core/body/body.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/mesh_distance.h"
#include "core/geometry/rotation.h"
#include "core/geometry/small_solve.h"
#include "core/geometry/smooth.h"
#include "core/geometry/triangle_pair.h"

namespace ego {
namespace {

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  Vec3 Vector() { return {(*this)(), (*this)(), (*this)()}; }
  Vec3 Unit() { return NormalizedOr(Vector(), {0.0, 1.0, 0.0}); }

 private:
  std::mt19937 engine_{11};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(ClosestOnTriangle, IsNoFartherThanAnySampledPoint) {
  Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const Triangle triangle = Triangle::Of(random.Vector(), random.Vector(), random.Vector());
    const Vec3 p = 2.0 * random.Vector();
    const Vec3 weight = ClosestOnTriangle(triangle, p);
    EXPECT_NEAR(weight.x + weight.y + weight.z, 1.0, 1e-12);
    EXPECT_GE(std::min({weight.x, weight.y, weight.z}), -1e-15);
    const double found = glm::distance(p, AtBarycentric(triangle, weight));
    double best = 1e9;
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps - i; ++j) {
        const Vec3 w = Vec3{i, j, kSteps - i - j} / static_cast<double>(kSteps);
        best = std::min(best, glm::distance(p, AtBarycentric(triangle, w)));
      }
    }
    EXPECT_LE(found, best + 1e-12);
    EXPECT_NEAR(found, best, 0.06);
  }
}

TEST(TrianglePair, AgreesWithEachTriangleAlone) {
  Random random;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::array<Vec3, 3> one = {random.Vector(), random.Vector(), random.Vector()};
    const std::array<Vec3, 3> two = {random.Vector(), random.Vector(), random.Vector()};
    const TrianglePair pair =
        MakeTrianglePair(Pair(one[0], two[0]), Pair(one[1], two[1]), Pair(one[2], two[2]));
    const Vec3 p = 3.0 * random.Vector();
    const ClosestLanes<Lanes> closest = ClosestOnTriangles(pair, Splat(p));
    for (std::size_t lane = 0; lane < kLaneCount<Lanes>; ++lane) {
      const auto& corner = lane == 0 ? one : two;
      const Triangle triangle = Triangle::Of(corner[0], corner[1], corner[2]);
      const Vec3 weight = ClosestOnTriangle(triangle, p);
      const Vec3 away = p - AtBarycentric(triangle, weight);
      EXPECT_LT(glm::distance(closest.away.At(lane), away), 1e-11);
      EXPECT_NEAR(closest.b[lane], weight.y, 1e-10);
      EXPECT_NEAR(closest.c[lane], weight.z, 1e-10);
      EXPECT_LT(glm::distance(pair.normal.At(lane), triangle.normal), 1e-12);
      EXPECT_NEAR(pair.area[lane], triangle.area, 1e-15);
    }
  }
}

TEST(TrianglePair, HasAnAnswerWithoutArea) {
  const Lanes3 point = Splat(Vec3{1.0});
  const TrianglePair none = MakeTrianglePair(point, point, point);
  EXPECT_EQ(ClosestOnTriangles(none, Splat(Vec3{5.0})).away.At(0), Vec3(4.0));
  const TrianglePair line =
      MakeTrianglePair(Splat(Vec3{0, 0, 0}), Splat(Vec3{1, 0, 0}), Splat(Vec3{2, 0, 0}));
  EXPECT_EQ(ClosestOnTriangles(line, Splat(Vec3{1.5, 1, 0})).away.At(1), Vec3(0, 1, 0));
  EXPECT_EQ(line.normal.At(0), Vec3(0.0));
}

TEST(ClosestOnTriangle, HasAnAnswerWithoutArea) {
  const Triangle line = Triangle::Of({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  EXPECT_EQ(line.normal, Vec3(0.0));
  EXPECT_NEAR(
      glm::distance(AtBarycentric(line, ClosestOnTriangle(line, {1.5, 1, 0})), Vec3(1.5, 0, 0)),
      0.0, 1e-12);
  const Triangle point = Triangle::Of({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_EQ(AtBarycentric(point, ClosestOnTriangle(point, {5, 5, 5})), Vec3(1.0));
}

TEST(ClosestOnSegments, IsNoFartherThanAnySampledPair) {
  Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a0 = random.Vector();
    const Vec3 a1 = random.Vector();
    const Vec3 b0 = random.Vector();
    // Every third pair is parallel, every seventh has no length.
    Vec3 b1 = trial % 3 == 0 ? b0 + 0.7 * random() * (a1 - a0) : random.Vector();
    if (trial % 7 == 0) b1 = b0;
    const SegmentPair pair = ClosestOnSegments(a0, a1, b0, b1);
    const double found = glm::distance(glm::mix(a0, a1, pair.s), glm::mix(b0, b1, pair.t));
    double best = 1e9;
    for (int i = 0; i <= 60; ++i) {
      const Vec3 p = glm::mix(a0, a1, i / 60.0);
      best = std::min(best, glm::distance(p, glm::mix(b0, b1, ClosestOnSegment(p, b0, b1))));
    }
    EXPECT_LE(found, best + 1e-9);
  }
}

TEST(ClosestOnSegments, ParallelOnesMeetInTheMiddleOfTheirOverlap) {
  const SegmentPair pair = ClosestOnSegments({0, 0, 0}, {1, 0, 0}, {0.4, 1, 0}, {2, 1, 0});
  EXPECT_NEAR(pair.s, 0.7, 1e-12);
  EXPECT_NEAR(0.4 + 1.6 * pair.t, 0.7, 1e-12);
}

TEST(SmallestRotation, TakesOneToTheOtherAndHalfTurnsAboutTheHinge) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 from = random.Unit();
    const Vec3 to = random.Unit();
    const Quat q = SmallestRotation(from, to, {0, 1, 0});
    EXPECT_LT(glm::distance(q * from, to), 1e-9);
    EXPECT_NEAR(AngleOf(q), std::acos(std::clamp(glm::dot(from, to), -1.0, 1.0)), 1e-6);
  }
  const Quat half = SmallestRotation({1, 0, 0}, {-1, 0, 0}, {0, 0, 3});
  EXPECT_LT(glm::distance(half * Vec3(1, 0, 0), Vec3(-1, 0, 0)), 1e-12);
  EXPECT_NEAR(std::abs(half.z), 1.0, 1e-12);
  const Quat any = SmallestRotation({1, 0, 0}, {-1, 0, 0}, {2, 0, 0});  // hinge along the vector
  EXPECT_LT(glm::distance(any * Vec3(1, 0, 0), Vec3(-1, 0, 0)), 1e-12);
}

TEST(Smooth, CurvesHaveTheirStatedEnds) {
  EXPECT_EQ(Smoothstep(-1.0), 0.0);
  EXPECT_EQ(Smoothstep(2.0), 1.0);
  EXPECT_EQ(SoftRamp(-0.1, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(SoftRamp(3.0, 1.0), 2.5);
  EXPECT_EQ(SoftMin(0.0, 1.0, 2.0), 0.0);
  for (double x = 0.01; x < 1.0; x += 0.01) {
    const double least = std::min({x, 0.4, 1.0 - x});
    EXPECT_LE(SoftMin(x, 0.4, 1.0 - x), least);
    EXPECT_GE(SoftMin(x, 0.4, 1.0 - x), 0.75 * least);
    // Slopes of the ramp grow steadily.
    EXPECT_LE(SoftRamp(x, 1.0), 2.0 * SoftRamp(x + 0.01, 1.0));
    EXPECT_LE(SoftRamp(x + 0.01, 1.0) - SoftRamp(x, 1.0), 0.01 + 1e-12);
  }
}

TEST(NormalEquations, SolveWhatTheyAreGiven) {
  Random random;
  NormalEquations<4> equations;
  const std::array<double, 4> truth = {0.3, -1.0, 2.0, 0.7};
  for (int row = 0; row < 12; ++row) {
    std::array<double, 4> r;
    double value = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      r[k] = random();
      value += r[k] * truth[k];
    }
    equations.Add(r, value, 0.5 + row);
  }
  const std::array<double, 4> x = equations.Solve();
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(x[k], truth[k], 1e-9);
}

TEST(SmoothMeshDistance, HasTheSignAndNearlyTheDistanceOfTheMesh) {
  const Body body = TemplateBody();
  std::vector<Triangle> trunk;
  std::vector<TrianglePair> pairs;
  for (std::size_t t = 0; t < kTrunkTriangleCount; t += 2) {
    const auto corner = [&](std::size_t triangle, std::size_t k) -> const Vec3& {
      return body.surface.sample_ms[Index(SampleTriangles()[triangle][k])];
    };
    for (const std::size_t one : {t, t + 1}) {
      trunk.push_back(Triangle::Of(corner(one, 0), corner(one, 1), corner(one, 2)));
    }
    pairs.push_back(MakeTrianglePair(Pair(corner(t, 0), corner(t + 1, 0)),
                                     Pair(corner(t, 1), corner(t + 1, 1)),
                                     Pair(corner(t, 2), corner(t + 1, 2))));
  }
  const Box box = Box::Of(std::span<const Vec3>(body.surface.sample_ms).first(kTrunkSampleCount));
  for (const Triangle& t : trunk) {
    const Vec3 middle = (t.a + t.b + t.c) / 3.0;
    for (const double offset : {-0.02, 0.02, 0.05}) {
      const Vec3 p = middle + offset * t.normal;
      double nearest = 1e9;
      for (const Triangle& other : trunk) {
        nearest =
            std::min(nearest, glm::distance(p, AtBarycentric(other, ClosestOnTriangle(other, p))));
      }
      const SignedDistance d = SmoothMeshDistance(pairs, p, 0.009, 0.16);
      EXPECT_EQ(d.distance > 0.0, offset > 0.0);
      for (const std::size_t count : {pairs.size(), pairs.size() - 1, std::size_t{1}}) {
        const std::span<const TrianglePair> part = std::span(pairs).first(count);
        const SignedDistance two = SmoothMeshDistance(part, p, 0.009, 0.16, LaneWidth::kTwo);
        const SignedDistance fastest = SmoothMeshDistance(part, p, 0.009, 0.16, FastestLanes());
        EXPECT_EQ(two.distance, fastest.distance);
        EXPECT_EQ(two.gradient, fastest.gradient);
      }
      EXPECT_NEAR(std::abs(d.distance), nearest, 0.008);
      EXPECT_GT(glm::dot(d.gradient, t.normal), 0.6);
      EXPECT_LE(box.Distance(p), nearest + 1e-12);
    }
  }
  EXPECT_EQ(SmoothMeshDistance({}, {0, 0, 0}, 0.01, 0.2).gradient, Vec3(0.0));
}

}  // namespace
}  // namespace ego
