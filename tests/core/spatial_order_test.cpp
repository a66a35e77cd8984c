// SPDX-License-Identifier: MIT
#include "core/adapt/spatial_order.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/adapt/adapt.h"
#include "core/adapt/half_space.h"
#include "core/egocentric/normalize.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/rotation.h"
#include "tests/support/bodies.h"
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

/// Sitting, the right leg crossed over the left thigh.
Pose LegOverLeg() {
  Pose pose = CanonicalPose(TemplateBody().skeleton);
  pose.root_ws = {0.0, 0.45, -0.05};
  const auto turn = [&](HumanoidJoint joint, const Vec3& by) {
    pose.rotation_ls[Index(joint)] = FromRotationVector(by);
  };
  turn(HumanoidJoint::kLeftUpperLeg, {-1.51, 0.37, -0.47});
  turn(HumanoidJoint::kLeftLowerLeg, {2.46, 0.0, 0.0});
  turn(HumanoidJoint::kRightUpperLeg, {-2.13, 0.20, 1.00});
  turn(HumanoidJoint::kRightLowerLeg, {2.07, 0.0, 0.0});
  return pose;
}

/// How far the line of the right calf's bone is from that of the left thigh's, upwards from the
/// thigh, metres: which of them lies over the other. `across`: whether the bones themselves pass.
double CalfOverThigh(const Body& body, const Pose& pose, bool& across) {
  const ModelPose m = ForwardKinematics(body.skeleton, pose);
  const Vec3& hip = m.Position(HumanoidJoint::kLeftUpperLeg);
  const Vec3& thigh_end = m.Position(HumanoidJoint::kLeftLowerLeg);
  const Vec3& knee = m.Position(HumanoidJoint::kRightLowerLeg);
  const Vec3& calf_end = m.Position(HumanoidJoint::kRightFoot);
  const SegmentPair pair = ClosestOnSegments(hip, thigh_end, knee, calf_end);
  across = std::min({pair.s, pair.t, 1.0 - pair.s, 1.0 - pair.t}) > 0.0;
  const Vec3 normal = glm::normalize(glm::cross(thigh_end - hip, calf_end - knee));
  return glm::dot(knee - hip, normal) * (normal.y > 0.0 ? 1.0 : -1.0);
}

// What the planes are for: on legs of half the length the crossed calf passes through the thigh
// without them.
TEST(EnsureSpatialOrder, KeepsCrossedLegsFromPassingThroughEachOther) {
  const Body performer = TemplateBody();
  const Pose pose = LegOverLeg();
  auto egocentric = std::make_unique<EgocentricPose>();
  Normalize(performer, pose, {}, *egocentric);
  bool across = false;
  ASSERT_GT(CalfOverThigh(performer, pose, across), 0.05);
  ASSERT_TRUE(across);
  for (const double length : {0.33, 0.36, 0.40}) {
    const Body avatar = MakeBody(
        "short legs", {.leg_length = length, .upper_leg_radius = 0.065, .lower_leg_radius = 0.035});
    Pose out;
    AdaptSettings settings;
    Adapt(avatar, *egocentric, settings, out);
    EXPECT_GT(CalfOverThigh(avatar, out, across), 0.01) << length;
    settings.plane_ramp = 1e9;  // no planes
    Adapt(avatar, *egocentric, settings, out);
    EXPECT_LT(CalfOverThigh(avatar, out, across), -0.01) << length;
    EXPECT_TRUE(across) << length;
  }
}

}  // namespace
}  // namespace ego::test
