// SPDX-License-Identifier: MIT
#include "core/adapt/limb_ik.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/adapt/half_space.h"
#include "core/body/body.h"
#include "core/geometry/rotation.h"

namespace ego {
namespace {

LimbPosture Bent(double degrees) {
  return {glm::angleAxis(0.4, glm::normalize(Vec3{0.3, 1.0, -0.2})),
          glm::angleAxis(Radians(degrees), FlexionAxis(Limb::kLeftArm))};
}

LimbChain Arm(const LimbPosture& captured, double softness = 0.006) {
  return MakeChain(TemplateSkeleton(1.78), Limb::kLeftArm, {0.2, 1.4, 0.0},
                   glm::angleAxis(0.2, Vec3{0.0, 0.0, 1.0}), captured, softness);
}

double Difference(const LimbPosture& a, const LimbPosture& b) {
  return AngleOf(glm::conjugate(a.base) * b.base) + AngleOf(glm::conjugate(a.mid) * b.mid);
}

TEST(LimbIk, KeepsAPostureWhoseTargetsAreReached) {
  for (const double flexion : {-5.0, 0.0, 0.5, 10.0, 90.0, 165.0}) {
    const LimbPosture posture = Bent(flexion);
    const LimbChain chain = Arm(posture);
    const LimbPlacement placed = Place(chain, posture);
    for (const double gamma : {0.0, 0.4, 1.0}) {
      const LimbPosture out = BlendedIk(chain, posture, placed.mid, placed.end, gamma);
      EXPECT_LT(Difference(posture, out), 1e-6) << flexion;
    }
  }
}

/// Side by side with any other limb, locked or without bones, a limb ends with the same bits.
TEST(LimbIk, DoesNotHeedThePartner) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3{uniform(engine), uniform(engine), uniform(engine)}; };
  for (int trial = 0; trial < 400; ++trial) {
    std::array<LimbChain, 2> chain;
    std::array<LimbTask, 2> task;
    for (std::size_t k = 0; k < 2; ++k) {
      const LimbPosture posture = Bent(80.0 + 85.0 * uniform(engine));
      chain[k] = Arm(posture, trial % 3 == 0 ? 0.0 : 0.05);
      if (k == 1 && trial % 5 == 0) chain[k].base_locked = true;
      if (k == 1 && trial % 7 == 0) chain[k].mid_locked = true;
      if (k == 1 && trial % 11 == 0) {
        chain[k] = MakeChain(Skeleton{}, Limb::kRightArm, vector(), kIdentity, posture, 0.05);
      }
      task[k] = {&chain[k], posture, chain[k].base_ws + vector(),
                 chain[k].base_ws + (trial % 4 == 0 ? 0.02 : 0.7) * vector(),
                 std::max(0.0, uniform(engine))};
    }
    const std::array<LimbPosture, 2> together = BlendedIk(task);
    const std::array<LimbPosture, 2> plain = BlendedIk(task, LaneWidth::kTwo);
    for (std::size_t k = 0; k < 2; ++k) {
      const LimbPosture alone = BlendedIk({task[k], task[k]})[1];
      EXPECT_EQ(together[k].base, alone.base) << trial;
      EXPECT_EQ(together[k].mid, alone.mid) << trial;
      EXPECT_EQ(plain[k].base, alone.base) << trial;
      EXPECT_EQ(plain[k].mid, alone.mid) << trial;
      EXPECT_NEAR(glm::length(alone.base), 1.0, 1e-12);
      EXPECT_NEAR(glm::length(alone.mid), 1.0, 1e-12);
      if (chain[k].mid_locked) {
        EXPECT_LT(AngleOf(glm::conjugate(alone.mid) * task[k].start.mid), 1e-7);
      }
    }
  }
}

TEST(LimbIk, StandardReachesTheEndAndReversedTheMiddle) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const LimbPosture posture = Bent(40.0 + 30.0 * uniform(engine));
    const LimbChain chain = Arm(posture, 0.0);
    const Vec3 direction =
        NormalizedOr({uniform(engine), uniform(engine), uniform(engine)}, {0, 0, 1});
    const Vec3 end = chain.base_ws + (0.5 + 0.2 * uniform(engine)) * chain.Reach() * direction;
    const Vec3 mid = chain.base_ws + Vec3{uniform(engine), uniform(engine), uniform(engine)};
    EXPECT_LT(glm::distance(Place(chain, StandardIk(chain, posture, mid, end)).end, end), 1e-9);
    const LimbPlacement reversed = Place(chain, ReversedIk(chain, posture, mid, end));
    const Vec3 wanted =
        chain.base_ws + glm::length(chain.upper_ls) * glm::normalize(mid - chain.base_ws);
    EXPECT_LT(glm::distance(reversed.mid, wanted), 1e-9);
  }
}

/// Targets that pass behind a limb, near its line, where the way round is undecided and what they
/// say is worth little.
TEST(LimbIk, TargetsPassingBehindDoNotTurnItOver) {
  const LimbPosture posture = Bent(15.0);
  const LimbChain chain = Arm(posture);
  const LimbPlacement placed = Place(chain, posture);
  const Vec3 upper = glm::normalize(placed.mid - chain.base_ws);
  const Vec3 off = NormalizedOr(Perpendicular(placed.end - placed.mid, upper), Vec3{0.0});
  const Vec3 aside = glm::cross(upper, off);
  LimbPosture last_reversed;
  LimbPosture last_standard;
  for (int step = -40; step <= 40; ++step) {
    const Vec3 away = -0.03 * off + 0.001 * step * aside;
    const LimbPosture reversed =
        ReversedIk(chain, posture, placed.mid, placed.mid + 0.25 * upper + away);
    const LimbPosture standard = StandardIk(chain, posture, placed.mid + away * 3.0, placed.end);
    if (step > -40) {
      EXPECT_LT(Degrees(Difference(last_reversed, reversed)), 2.5) << step;
      EXPECT_LT(Degrees(Difference(last_standard, standard)), 2.5) << step;
    }
    last_reversed = reversed;
    last_standard = standard;
  }
}

TEST(LimbIk, SingularTargetsKeepWhatTheyLeaveOpen) {
  const LimbPosture posture = Bent(60.0);
  const LimbChain chain = Arm(posture);
  const LimbPlacement placed = Place(chain, posture);
  for (const LimbPosture& out :
       {StandardIk(chain, posture, placed.mid, chain.base_ws),
        StandardIk(chain, posture, chain.base_ws, placed.end),
        ReversedIk(chain, posture, chain.base_ws, placed.end),
        ReversedIk(chain, posture, placed.mid, placed.mid),
        StandardIk(chain, posture, placed.mid, chain.base_ws + Vec3{9.0, 0.0, 0.0})}) {
    EXPECT_NEAR(glm::length(out.base), 1.0, 1e-9);
    EXPECT_NEAR(glm::length(out.mid), 1.0, 1e-9);
  }
}

TEST(LimbIk, IsContinuousThroughFullReachAndOverStretch) {
  // The target moves out through the reach in tenths of a millimetre.
  const LimbPosture posture = Bent(30.0);
  const LimbChain chain = Arm(posture);
  const LimbPlacement placed = Place(chain, posture);
  const Vec3 direction = glm::normalize(placed.end - chain.base_ws);
  LimbPosture last = posture;
  for (int k = 0; k <= 2000; ++k) {
    const double distance = chain.Reach() * (0.9 + 0.0001 * k);
    const LimbPosture out =
        StandardIk(chain, posture, placed.mid, chain.base_ws + distance * direction);
    if (k > 0) {
      EXPECT_LT(Difference(last, out), Radians(0.4)) << k;
    }
    last = out;
  }
  // The captured elbow passes through straight while the target stays within a bent one's reach.
  for (int k = 0; k <= 1000; ++k) {
    const LimbPosture captured = Bent(-8.0 + 0.02 * k);
    const LimbChain other = Arm(captured);
    const LimbPosture out =
        ReachEnd(other, captured, other.base_ws + 0.97 * other.Reach() * direction);
    if (k > 0) {
      EXPECT_LT(Difference(last, out), Radians(2.0)) << k;
    }
    last = out;
  }
}

TEST(LimbIk, TwistIsBoundedByFlexionAndFadesAtTheHalfTurn) {
  EXPECT_EQ(BoundTwist(1.0, 0.0), 0.0);
  EXPECT_NEAR(BoundTwist(kPi, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(BoundTwist(-0.01, 1.0), -0.01, 1e-6);
  double last = BoundTwist(-kPi, 0.7);
  for (double t = -kPi; t <= kPi; t += 0.001) {
    const double bound = BoundTwist(t, 0.7);
    EXPECT_LE(std::abs(bound), std::min(std::abs(t), 0.7) + 1e-15);
    EXPECT_NEAR(bound, last, 0.002);
    last = bound;
  }
}

TEST(LimbIk, LockedAndLengthlessJointsStay) {
  Skeleton skeleton = TemplateSkeleton(1.78);
  skeleton.locked[Index(HumanoidJoint::kLeftUpperArm)] = true;
  skeleton.locked[Index(HumanoidJoint::kLeftLowerArm)] = true;
  LimbChain chain = MakeChain(skeleton, Limb::kLeftArm, Vec3{0.0}, kIdentity, {}, 0.006);
  LimbPosture out = BlendedIk(chain, {}, {0.1, 0.2, 0.3}, {0.3, 0.1, 0.2}, 0.5);
  EXPECT_LT(Difference({}, out), 1e-12);
  skeleton.locked.reset();
  skeleton.offset[Index(HumanoidJoint::kLeftHand)] = Vec3{0.0};
  chain = MakeChain(skeleton, Limb::kLeftArm, Vec3{0.0}, kIdentity, {}, 0.006);
  out = BlendedIk(chain, {}, {0.1, 0.2, 0.3}, {0.3, 0.1, 0.2}, 0.5);
  const Vec3 end = Place(chain, out).end;
  EXPECT_LT(glm::distance(glm::normalize(end), glm::normalize(Vec3{0.3, 0.1, 0.2})), 1e-9);
}

TEST(HalfSpace, SatisfiedPlanesChangeNothingAndViolatedOnesAreMet) {
  const LimbPosture posture = Bent(60.0);
  const LimbChain chain = Arm(posture);
  const LimbPlacement placed = Place(chain, posture);
  const Vec3 normal = glm::normalize(Vec3{0.2, 0.3, 1.0});
  const HalfSpace free{normal,
                       std::min(glm::dot(normal, placed.mid), glm::dot(normal, placed.end)) - 0.01};
  EXPECT_LT(Difference(posture, SatisfyLower(chain, posture, free, 0.0, 1.0)), 1e-15);
  const HalfSpace inside{normal, glm::dot(normal, placed.mid) + 0.05};
  const LimbPlacement met = Place(chain, SatisfyUpper(chain, posture, inside, 0.0, 1.0));
  EXPECT_NEAR(inside.Distance(met.mid), 0.0, 1e-9);
  const LimbPlacement both = Place(chain, SatisfyLower(chain, posture, inside, 0.0, 1.0));
  EXPECT_GT(inside.Distance(both.end), -2e-3);  // within the softened reach
}

TEST(HalfSpace, TurnsLittleWhereTheUpperBoneIsAlongTheNormal) {
  const LimbPosture posture = Bent(60.0);
  const LimbChain chain = Arm(posture);
  const Vec3 upper = glm::normalize(Place(chain, posture).mid - chain.base_ws);
  const Vec3 side = glm::normalize(glm::cross(upper, Vec3{0.0, 1.0, 0.0}));
  LimbPosture last = posture;
  for (int k = -200; k <= 200; ++k) {
    const double angle = 0.0005 * k;  // through the singular direction
    const Vec3 normal = -(std::cos(angle) * upper + std::sin(angle) * side);
    const HalfSpace plane{normal, glm::dot(normal, chain.base_ws) - 0.1};
    const LimbPosture out = SatisfyUpper(chain, posture, plane, 0.018, 1.0);
    EXPECT_LE(Difference(posture, out), std::abs(angle) + 1e-9);
    if (k > -200) {
      EXPECT_LT(Difference(last, out), 0.0025);
    }
    last = out;
  }
}

}  // namespace
}  // namespace ego
