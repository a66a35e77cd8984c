// SPDX-License-Identifier: MIT
#include "core/adapt/spatial_order.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/adapt/half_space.h"
#include "core/egocentric/normalize.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

bool IsSame(const Quat& a, const Quat& b) {
  return a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Whether any segment of a limb, as it is placed, lies outside of a plane (appendix B), found one
/// after the other.
bool IsOutside(const AdaptState& state, Limb limb) {
  for (std::size_t part = 0; part < 2; ++part) {
    const auto segment = static_cast<LimbSegment>(2 * Index(limb) + part);
    for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
      const LimbSegment other = OtherSegment(limb, slot);
      if (!IsArm(limb) && IsArm(LimbOf(other))) continue;
      const EgocentricPlane& plane = state.egocentric.plane[Index(segment)][slot];
      const EgocentricPlane& reverse =
          state.egocentric.plane[Index(other)][SlotOf(LimbOf(other), segment)];
      const PosedCapsule& obstacle = state.posed.capsule[Index(other)];
      const RelaxedPlane relaxed =
          Relax(MapPlane(plane, obstacle, state.avatar.height), reverse,
                state.posed.capsule[Index(segment)], obstacle, state.avatar.height, plane.slack);
      if (relaxed.strength > 0.0) return true;
    }
  }
  return false;
}

TEST(EnsureSpatialOrder, LeavesAloneExactlyWhatIsInOrder) {
  const Body& performer = StudioPerformer();
  int in_order = 0;
  int changed = 0;
  for (const Body& avatar : StudyBodies()) {
    for (const auto& [name, pose] : StudioPostures()) {
      auto egocentric = std::make_unique<EgocentricPose>();
      Normalize(performer, pose, {}, *egocentric);
      const AdaptSettings settings;
      const AdaptState state(avatar, *egocentric, settings);
      for (const Limb limb : kLimbs) {
        const LimbPosture& posture = state.limb[Index(limb)];
        const LimbPosture ordered = EnsureSpatialOrder(state, limb, posture, 1.0);
        const bool same = IsSame(ordered.base, posture.base) && IsSame(ordered.mid, posture.mid);
        if (IsOutside(state, limb)) {
          changed += same ? 0 : 1;
        } else {
          EXPECT_TRUE(same) << avatar.name << " " << name << " limb " << Index(limb);
          ++in_order;
        }
      }
    }
  }
  EXPECT_GT(in_order, 20);
  EXPECT_GT(changed, 5);
}

}  // namespace
}  // namespace ego::test
