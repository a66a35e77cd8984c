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
#include "core/geometry/triangle_quad.h"

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

TriangleQuad QuadOf(std::span<const Triangle> triangles) {
  QuadVectors a;
  QuadVectors b;
  QuadVectors c;
  for (std::size_t k = 0; k < std::min<std::size_t>(4, triangles.size()); ++k) {
    a.Set(k, triangles[k].a);
    b.Set(k, triangles[k].b);
    c.Set(k, triangles[k].c);
  }
  return MakeTriangleQuad(a, b, c);
}

TEST(TriangleQuad, AgreesWithEachTriangleAlone) {
  Random random;
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<Triangle, 4> alone;
    for (Triangle& t : alone) t = Triangle::Of(random.Vector(), random.Vector(), random.Vector());
    const TriangleQuad quad = QuadOf(alone);
    const Vec3 p = 3.0 * random.Vector();
    for (std::size_t k = 0; k < 4; ++k) {
      const Triangle& triangle = alone[k];
      const Vec3 weight = ClosestOnTriangle(triangle, p);
      const Vec3 away = p - AtBarycentric(triangle, weight);
      const std::size_t first = k / 2 * 2;
      for (const auto& [found, lane] :
           {std::pair(ClosestOnTriangles(Load<Lanes>(quad, first), Splat<Lanes>(p)), k - first),
            std::pair(ClosestOnTriangles(Splat<Lanes>(quad, k), Splat<Lanes>(p)), 1 - k % 2)}) {
        EXPECT_LT(glm::distance(found.away.At(lane), away), 1e-11);
        EXPECT_NEAR(found.b[lane], weight.y, 1e-10);
        EXPECT_NEAR(found.c[lane], weight.z, 1e-10);
      }
      EXPECT_LT(glm::distance(quad.normal.At(k), triangle.normal), 1e-12);
      EXPECT_NEAR(quad.area[k], triangle.area, 1e-15);
    }
  }
}

TEST(TriangleQuad, HasAnAnswerWithoutArea) {
  const Triangle point = Triangle::Of(Vec3{1.0}, Vec3{1.0}, Vec3{1.0});
  const Triangle line = Triangle::Of({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  const TriangleQuad quad = QuadOf(std::array{point, line, point, line});
  const auto away = [&](const Vec3& p, std::size_t lane) {
    return ClosestOnTriangles(Load<Lanes>(quad, 0), Splat<Lanes>(p)).away.At(lane);
  };
  EXPECT_EQ(away(Vec3{5.0}, 0), Vec3(4.0));
  EXPECT_EQ(away({1.5, 1, 0}, 1), Vec3(0, 1, 0));
  EXPECT_EQ(quad.normal.At(1), Vec3(0.0));
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

/// Trunk (or head) of the template as it stands.
std::vector<Triangle> MeshOf(const Body& body, std::size_t first, std::size_t end) {
  std::vector<Triangle> mesh;
  for (std::size_t t = first; t < end; ++t) {
    const SampleTriangle& s = SampleTriangles()[t];
    const auto corner = [&](std::size_t k) { return body.surface.sample_ms[Index(s[k])]; };
    mesh.push_back(Triangle::Of(corner(0), corner(1), corner(2)));
  }
  return mesh;
}

std::vector<TriangleQuad> QuadsOf(std::span<const Triangle> mesh) {
  std::vector<TriangleQuad> quads;
  for (std::size_t t = 0; t < mesh.size(); t += 4) quads.push_back(QuadOf(mesh.subspan(t)));
  return quads;
}

TEST(SmoothMeshDistance, HasTheSignAndNearlyTheDistanceOfTheMesh) {
  const Body body = TemplateBody();
  const std::vector<Triangle> trunk = MeshOf(body, 0, kTrunkTriangleCount);
  const std::vector<TriangleQuad> quads = QuadsOf(trunk);
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
      const SignedDistance d = SmoothMeshDistance(quads, p, 0.009, 0.16);
      EXPECT_EQ(d.distance > 0.0, offset > 0.0);
      for (const std::size_t count : {quads.size(), std::size_t{3}, std::size_t{1}}) {
        const std::span<const TriangleQuad> part = std::span(quads).first(count);
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

/// The definition in mesh_distance.h written out, without leaving anything out.
TEST(SmoothMeshDistance, IsTheWeightedMeanOfItsDefinition) {
  const Body body = TemplateBody();
  std::vector<Triangle> head = MeshOf(body, kTrunkTriangleCount, kTriangleCount);
  head.pop_back();  // the last four are not full
  const std::vector<TriangleQuad> quads = QuadsOf(head);
  constexpr double kEpsilon = 0.009;
  constexpr double kWidth = 0.08;
  for (const Triangle& t : head) {
    for (const double offset : {-0.02, 0.003, 0.03, 0.12}) {
      const Vec3 p = (t.a + t.b + t.c) / 3.0 + offset * t.normal;
      double weights = 0.0;
      double planes = 0.0;
      double squares = 0.0;
      for (const Triangle& other : head) {
        const double q = glm::length(p - AtBarycentric(other, ClosestOnTriangle(other, p)));
        const double weight =
            other.area * std::pow(kEpsilon * kEpsilon / (q * q + kEpsilon * kEpsilon), 4.0);
        weights += weight;
        planes += weight * glm::dot(other.normal, p - other.a);
        squares += weight * q * q;
      }
      const double plane = planes / weights;
      const double away = std::sqrt(squares / weights);
      const double outside = 1.0 - (1.0 - Smoothstep(plane / (2.0 * kEpsilon))) *
                                       (1.0 - Smoothstep(away / kWidth - 1.0));
      const SignedDistance d = SmoothMeshDistance(quads, p, kEpsilon, kWidth);
      EXPECT_NEAR(d.distance, glm::mix(plane, away, outside), 1e-12);
    }
  }
}

}  // namespace
}  // namespace ego
