// SPDX-License-Identifier: MIT
#include "core/metrics/arm_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/support/bodies.h"
#include "tests/support/studio_motions.h"

namespace ego::test {
namespace {

constexpr Limb kArm = Limb::kLeftArm;

Vec3 OnSphere(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(Vec3{normal(random), normal(random), normal(random)});
}

/// How near to a place the arm comes in any of many random postures: with its bones nowhere in
/// trunk or head, and up to `depth` metres deep.
struct Nearest {
  double outside = 1e9;
  double inside = 1e9;
};
Nearest NearestOfMany(const MeasuredBody& body, const Vec3& place, double hand, double depth) {
  const Skeleton& skeleton = body.body->skeleton;
  const LimbJoints joints = JointsOf(kArm);
  const double upper = BoneLength(skeleton, joints.mid);
  const double lower = BoneLength(skeleton, joints.end);
  std::mt19937 random(1);
  Nearest nearest;
  MeasuredBody moved = body;
  for (int k = 0; k < 100000; ++k) {
    const Vec3 a = OnSphere(random);
    const Vec3 b = OnSphere(random);
    const Vec3 c = OnSphere(random);
    if (glm::dot(a, b) < std::cos(Radians(155.0)) || glm::dot(b, c) < 0.0) continue;
    const Vec3 elbow = body.pose.Position(joints.base) + upper * a;
    const Vec3 wrist = elbow + lower * b;
    const Vec3 point = wrist + hand * c;
    const double distance = glm::distance(point, place);
    if (distance >= nearest.outside) continue;
    moved.pose.position_ws[Index(joints.mid)] = elbow;
    moved.pose.position_ws[Index(joints.end)] = wrist;
    const double deep = BoneDepth(moved, kArm, point);
    if (deep <= 0.0) nearest.outside = distance;
    if (deep <= depth) nearest.inside = std::min(nearest.inside, distance);
  }
  return nearest;
}

TEST(CanTouch, AgreesWithManyRandomPostures) {
  int can = 0;
  int cannot = 0;
  int around = 0;  // near enough for a straight arm, but not without going through the body
  for (const Body& body : {Stubby(), MakeBody("stump", {.arm_length = 0.3})}) {
    const MeasuredBody posed(body, CanonicalPose(body.skeleton));
    const double hand = 0.06 * body.height;
    const LimbJoints joints = JointsOf(kArm);
    const double straight =
        BoneLength(body.skeleton, joints.mid) + BoneLength(body.skeleton, joints.end) + hand;
    for (std::size_t triangle = 0; triangle < kTriangleCount; triangle += 5) {
      const SurfacePlace place{true, triangle, Vec3{1.0 / 3.0}, 0.0};
      const Vec3 at = OnMesh(posed, place);
      const std::string what = body.name + " triangle " + std::to_string(triangle);
      const Nearest nearest = NearestOfMany(posed, at, hand, 0.02 * body.height);
      if (CanTouch(posed, kArm, place, hand, 0.0)) {
        EXPECT_LT(nearest.inside / body.height, 0.025) << what;
        ++can;
      } else {
        EXPECT_GT(nearest.outside / body.height, 0.01) << what;
        ++cannot;
        around += glm::distance(at, posed.pose.Position(joints.base)) < straight ? 1 : 0;
      }
    }
  }
  EXPECT_GT(can, 5);
  EXPECT_GT(cannot, 5);
  EXPECT_GT(around, 1);
}

// Apart as they are in the canonical pose: what counts is whether the arms can meet.
TEST(CanTouch, TheOtherHandWhereverItIs) {
  const SurfacePlace other_hand{false, kSegmentCount, Vec3{0.0}, 0.5};
  const Body& performer = StudioPerformer();
  const MeasuredBody apart(performer, CanonicalPose(performer.skeleton));
  EXPECT_TRUE(CanTouch(apart, kArm, other_hand, 0.1, 0.0));
  const Body stump = MakeBody("stump", {.arm_length = 0.05});
  const MeasuredBody short_of(stump, CanonicalPose(stump.skeleton));
  EXPECT_FALSE(CanTouch(short_of, kArm, other_hand, 0.05, 0.0));
}

// The documented surface: palm and fingertip lie on the hand's skin.
TEST(SurfaceGap, OfAHandIsToItsSkin) {
  const Body& body = StudioPerformer();
  const MeasuredBody measured(body, CanonicalPose(body.skeleton));
  const HandSurface& hand = body.surface.hand[0];
  const MeasuredBone bone = BoneOf(measured, Limb::kRightArm, kSegmentCount);
  EXPECT_NEAR(glm::dot(measured.Palm(0) - bone.start, hand.palm_normal_ms), hand.half_thickness,
              0.004);
  EXPECT_NEAR(glm::dot(bone.end - bone.start, hand.palm_normal_ms), 0.0, 1e-12);
}

}  // namespace
}  // namespace ego::test
