// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/solve/dense.h"
#include "core/solve/rigid_fit.h"

namespace ego {
namespace {

/// Solves A x = b by Gaussian elimination with pivoting: shares no code with the subject.
std::vector<double> Eliminate(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    }
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const double f = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= f * a[c][k];
      b[r] -= f * b[c];
    }
  }
  for (std::size_t r = n; r-- > 0;) {
    for (std::size_t k = r + 1; k < n; ++k) b[r] -= a[r][k] * b[k];
    b[r] /= a[r][r];
  }
  return b;
}

struct System {
  std::size_t n;
  std::vector<double> flat;
  std::vector<std::vector<double>> nested;
  std::vector<double> b;
};

System RandomPositiveSystem(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> m(n, std::vector<double>(n));
  for (auto& row : m) {
    for (double& v : row) v = normal(random);
  }
  System s{n, std::vector<double>(n * n), m, std::vector<double>(n)};
  for (std::size_t r = 0; r < n; ++r) {
    s.b[r] = normal(random);
    for (std::size_t c = 0; c < n; ++c) {
      double sum = r == c ? 0.1 : 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += m[r][k] * m[c][k];
      s.nested[r][c] = sum;
      s.flat[r * n + c] = sum;
    }
  }
  return s;
}

TEST(Cholesky, SolvesLikeElimination) {
  for (const std::size_t n : {1u, 2u, 3u, 10u, 59u}) {
    System s = RandomPositiveSystem(n, static_cast<unsigned>(n));
    std::vector<double> x = s.b;
    EXPECT_TRUE(CholeskyInPlace(s.flat.data(), n, n));
    SolveLower(s.flat.data(), n, n, x.data());
    SolveLowerTransposed(s.flat.data(), n, n, x.data());
    const std::vector<double> expected = Eliminate(s.nested, s.b);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], expected[i], 1e-6) << n << " " << i;
  }
}

TEST(Cholesky, SingularDirectionGetsZero) {
  std::vector<double> a = {4.0, 0.0, 0.0, 0.0};  // second unknown does not occur
  EXPECT_FALSE(CholeskyInPlace(a.data(), 2, 2));
  double x[2] = {8.0, 3.0};
  SolveLower(a.data(), 2, 2, x);
  SolveLowerTransposed(a.data(), 2, 2, x);
  EXPECT_DOUBLE_EQ(x[0], 2.0);
  EXPECT_DOUBLE_EQ(x[1], 0.0);
}

TEST(SchurComplement, EqualsSolvingTheWholeSystem) {
  constexpr std::size_t kFrame = 7;
  constexpr std::size_t kShared = 4;
  const System s = RandomPositiveSystem(kFrame + kShared, 3);
  std::vector<double> ff(kFrame * kFrame);
  std::vector<double> fs(kFrame * kShared);
  std::vector<double> ss(kShared * kShared);
  for (std::size_t r = 0; r < kFrame; ++r) {
    for (std::size_t c = 0; c < kFrame; ++c) ff[r * kFrame + c] = s.nested[r][c];
    for (std::size_t c = 0; c < kShared; ++c) fs[r * kShared + c] = s.nested[r][kFrame + c];
  }
  for (std::size_t r = 0; r < kShared; ++r) {
    for (std::size_t c = 0; c < kShared; ++c) {
      ss[r * kShared + c] = s.nested[kFrame + r][kFrame + c];
    }
  }
  std::vector<double> g(s.b.begin(), s.b.begin() + kFrame);
  std::vector<double> x(s.b.begin() + kFrame, s.b.end());
  CholeskyInPlace(ff.data(), kFrame, kFrame);
  SolveLower(ff.data(), kFrame, kFrame, g.data());
  SolveLowerMany(ff.data(), kFrame, kFrame, fs.data(), kShared);
  SubtractGram(ss.data(), kShared, fs.data(), kFrame, kShared);
  for (std::size_t r = 0; r < kFrame; ++r) {
    for (std::size_t c = 0; c < kShared; ++c) x[c] -= fs[r * kShared + c] * g[r];
  }
  CholeskyInPlace(ss.data(), kShared, kShared);
  SolveLower(ss.data(), kShared, kShared, x.data());
  SolveLowerTransposed(ss.data(), kShared, kShared, x.data());
  const std::vector<double> expected = Eliminate(s.nested, s.b);
  for (std::size_t i = 0; i < kShared; ++i) EXPECT_NEAR(x[i], expected[kFrame + i], 1e-7);
}

TEST(FitRigid, RecoversAnyMotionEvenHalfTurns) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 axis = glm::normalize(Vec3{normal(random), normal(random), normal(random)});
    const double angle = trial < 3 ? kPi : 3.0 * normal(random);
    const Quat rotation = glm::angleAxis(angle, axis);
    const Vec3 shift{normal(random), normal(random), normal(random)};
    std::vector<Vec3> from;
    std::vector<Vec3> to;
    for (int i = 0; i < 5; ++i) {
      from.push_back({normal(random), normal(random), normal(random)});
      to.push_back(rotation * from.back() + shift);
    }
    const RigidTransform fit = FitRigid(from, to);
    EXPECT_NEAR(std::abs(glm::dot(fit.rotation, rotation)), 1.0, 1e-9);
    EXPECT_LT(glm::distance(fit.translation, shift), 1e-8);
  }
}

TEST(FitRigid, NeverReflects) {
  // A mirror image would fit these perfectly; a rotation is wanted.
  const std::vector<Vec3> from = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const std::vector<Vec3> to = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const Mat3 r = glm::mat3_cast(FitRigid(from, to).rotation);
  EXPECT_NEAR(glm::determinant(r), 1.0, 1e-9);
}

TEST(FitRigid, DegeneratePointsGiveAValidTurn) {
  const std::vector<Vec3> none;
  EXPECT_EQ(FitRigid(none, none).rotation, kIdentity);
  const std::vector<Vec3> same(4, Vec3{1.0, 2.0, 3.0});
  const RigidTransform fit = FitRigid(same, same);
  EXPECT_NEAR(glm::length(fit.rotation), 1.0, 1e-12);
  EXPECT_LT(glm::distance(fit.rotation * same[0] + fit.translation, same[0]), 1e-12);
}

}  // namespace
}  // namespace ego
