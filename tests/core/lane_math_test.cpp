// SPDX-License-Identifier: MIT
#include "core/geometry/lane_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego::test {
namespace {

class LaneMath : public testing::Test {
 protected:
  double Number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Quat Rotation() {
    return glm::normalize(Quat(Number(-1, 1), Number(-1, 1), Number(-1, 1), Number(-1, 1)));
  }

 private:
  std::mt19937 random_{7};
};

TEST_F(LaneMath, SineAndCosineAreTheLibrarys) {
  for (int trial = 0; trial < 20000; ++trial) {
    const double a = trial < 100 ? (trial - 50) * 0.25 * kPi : Number(-20.0, 20.0);
    const SineCosine<Lanes> found = SinCos<Lanes>(Lanes{a, -a});
    EXPECT_NEAR(found.sine[0], std::sin(a), 1e-15) << a;
    EXPECT_NEAR(found.cosine[0], std::cos(a), 1e-15) << a;
    EXPECT_EQ(found.sine[1], -found.sine[0]);
    EXPECT_EQ(found.cosine[1], found.cosine[0]);
  }
  // Small angles keep their relative precision.
  EXPECT_EQ(SinCos<Lanes>(Splat(1e-9)).sine[0], std::sin(1e-9));
}

TEST_F(LaneMath, AnglesAreTheLibrarys) {
  for (int trial = 0; trial < 20000; ++trial) {
    const double x = Number(-1.0, 1.0) * std::pow(10.0, Number(-8.0, 0.0));
    const double y = Number(-1.0, 1.0) * std::pow(10.0, Number(-8.0, 0.0));
    EXPECT_NEAR((Atan2<Lanes>(Splat(y), Splat(x))[0]), std::atan2(y, x), 1e-15) << y << " " << x;
    EXPECT_NEAR((Acos<Lanes>(Splat(x))[0]), std::acos(x), 1e-15) << x;
  }
  for (const double x : {-1.0, 0.0, 1.0}) {
    EXPECT_NEAR((Acos<Lanes>(Splat(x))[0]), std::acos(x), 1e-15);
    for (const double y : {-1.0, 0.0, 1.0}) {
      EXPECT_NEAR((Atan2<Lanes>(Splat(y), Splat(x))[0]), std::atan2(y, x), 1e-15);
    }
  }
}

TEST_F(LaneMath, RotationsAreThoseOfOneAlone) {
  for (int trial = 0; trial < 2000; ++trial) {
    const std::array<Quat, 2> a = {Rotation(), Rotation()};
    std::array<Quat, 2> b = {Rotation(), Rotation()};
    if (trial % 5 == 0) b[0] = a[0];
    if (trial % 7 == 0) b[1] = -a[1];
    const double t = Number(0.0, 1.0);
    const Vec3 v{Number(-1, 1), Number(-1, 1), Number(-1, 1)};
    const LaneQuats<Lanes> p = Pair(a[0], a[1]);
    const LaneQuats<Lanes> q = Pair(b[0], b[1]);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto expect_near = [](const Quat& found, const Quat& wanted) {
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-14);
      };
      expect_near((p * q).At(k), a[k] * b[k]);
      expect_near(Conjugate(p).At(k), glm::conjugate(a[k]));
      expect_near(Slerp<Lanes>(p, q, Splat(t)).At(k), Slerp(a[k], b[k], t));
      expect_near(AngleAxis<Lanes>(Splat(3.0 * t), Splat<Lanes>(v)).At(k),
                  glm::angleAxis(3.0 * t, v));
      EXPECT_LT(glm::distance((p * Splat<Lanes>(v)).At(k), a[k] * v), 1e-14);
    }
  }
}

TEST_F(LaneMath, CurvesAreThoseOfOneAlone) {
  for (int trial = 0; trial < 2000; ++trial) {
    const double a = Number(-0.2, 1.2);
    const double b = Number(-0.05, 2.0);
    const double c = Number(0.0, 2.0);
    EXPECT_NEAR(Smoothstep<Lanes>(Splat(a))[0], Smoothstep(a), 1e-14);
    EXPECT_NEAR((SoftMin<Lanes>(Splat(a), Splat(b), Splat(c))[0]), SoftMin(a, b, c), 1e-14);
  }
  EXPECT_EQ((SoftMin<Lanes>(Splat(0.0), Splat(1.0), Splat(0.0))[0]), 0.0);
}

}  // namespace
}  // namespace ego::test
