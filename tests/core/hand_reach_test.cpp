// SPDX-License-Identifier: MIT
#include "core/adapt/hand_reach.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/egocentric/normalize.h"
#include "core/geometry/rotation.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

constexpr Limb kArm = Limb::kRightArm;

/// A hand, across, before a place at a distance that the arm and hand in line reach. `gap`, metres:
/// how near the performer's is to a surface.
struct Reaching {
  explicit Reaching(double gap) {
    Normalize(avatar, Posture("standing"), {}, *egocentric);
    for (const LimbPoint j : {EndPoint(kArm), PalmPoint(kArm), FingertipPoint(kArm)}) {
      egocentric->point[Index(j)].priority = avatar.height / gap;
    }
    state = std::make_unique<AdaptState>(avatar, *egocentric, settings);
    const LimbChain& chain = state->chain[Index(kArm)];
    const Vec3 hand = Hand();
    const Vec3 across = NormalizedOr(glm::cross(hand, Vec3{0.3, 0.4, 0.5}), Vec3{0.0});
    // Hand and way to the place enclose 90 degrees at the wrist.
    targets.end = chain.base_ws + (1.25 * chain.Reach()) * across;
    targets.mid = targets.end;
  }
  Vec3 Hand() const {
    return state->extremity_ws[Index(kArm)] * state->joint_target[Index(kArm)][1].hand_offset_ls;
  }
  double Distance() const { return glm::distance(targets.end, state->chain[Index(kArm)].base_ws); }

  const Body& avatar = StudioPerformer();
  AdaptSettings settings;
  std::unique_ptr<EgocentricPose> egocentric = std::make_unique<EgocentricPose>();
  std::unique_ptr<AdaptState> state;
  LimbTargets targets;
};

TEST(ReachWithHand, TurnsTheHandTowardsItsPlaceWhereTheArmIsTooShort) {
  Reaching reaching(0.001);
  const Vec3 place = reaching.targets.end + reaching.Hand();
  const double before = reaching.Distance();
  const double reach = reaching.state->chain[Index(kArm)].Reach();
  ReachWithHand(*reaching.state, kArm, reaching.targets);
  // The place stays; the wrist that it needs is nearer, but not nearer than the arm reaches.
  EXPECT_LT(glm::distance(reaching.targets.end + reaching.Hand(), place), 1e-12);
  EXPECT_LT(reaching.Distance() - reach, 0.75 * (before - reach));
  EXPECT_GT(reaching.Distance(), reach);
}

TEST(ReachWithHand, LeavesAloneWhatIsWithinReachOrFarFromSurfaces) {
  const auto is_left_alone = [](Reaching& reaching) {
    const Quat hand = reaching.state->extremity_ws[Index(kArm)];
    const Vec3 end = reaching.targets.end;
    ReachWithHand(*reaching.state, kArm, reaching.targets);
    return reaching.targets.end == end && reaching.state->extremity_ws[Index(kArm)] == hand;
  };
  Reaching near(0.001);
  const LimbChain& chain = near.state->chain[Index(kArm)];
  near.targets.end = glm::mix(chain.base_ws, near.targets.end, 0.7);
  EXPECT_TRUE(is_left_alone(near));

  Reaching off(0.001);
  off.settings.hand_reach_gap = 0.0;
  EXPECT_TRUE(is_left_alone(off));

  // In the air it hardly turns.
  Reaching free(2.0);
  const Quat hand = free.state->extremity_ws[Index(kArm)];
  ReachWithHand(*free.state, kArm, free.targets);
  EXPECT_LT(Degrees(AngleOf(glm::conjugate(hand) * free.state->extremity_ws[Index(kArm)])), 1.0);
}

}  // namespace
}  // namespace ego::test
