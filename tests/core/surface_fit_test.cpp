// SPDX-License-Identifier: MIT
#include "core/body/surface_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace ego {
namespace {

using J = HumanoidJoint;

/// Both arms lowered by this angle from the T-pose, in the frontal plane.
Pose ArmsDown(const Skeleton& skeleton, double left_degrees, double right_degrees) {
  Pose pose = CanonicalPose(skeleton);
  pose.rotation_ls[Index(J::kLeftUpperArm)] = glm::angleAxis(-Radians(left_degrees), Vec3(0, 0, 1));
  pose.rotation_ls[Index(J::kRightUpperArm)] =
      glm::angleAxis(Radians(right_degrees), Vec3(0, 0, 1));
  return pose;
}

bool SameSurface(const BodySurface& a, const BodySurface& b) {
  return a.sample_ms == b.sample_ms && a.limb_radius == b.limb_radius;
}

TEST(SurfaceFit, LeavesABodyAloneThatProvesNothing) {
  Body body = TemplateBody();
  const BodySurface before = body.surface;
  FitSurfaceToMotion(body, {});
  EXPECT_TRUE(SameSurface(body.surface, before));
  std::vector<Pose> poses;
  for (int f = 0; f < 100; ++f) poses.push_back(ArmsDown(body.skeleton, 0.3 * f, 0.5 * f));
  const SurfaceFit fit = FitSurfaceToMotion(body, poses);
  EXPECT_TRUE(SameSurface(body.surface, before));
  EXPECT_EQ(fit.deep_before, 0.0);
}

TEST(SurfaceFit, IgnoresWhatHappensRarely) {
  Body body = TemplateBody();
  const BodySurface before = body.surface;
  std::vector<Pose> poses(200, ArmsDown(body.skeleton, 30.0, 30.0));
  for (std::size_t f = 0; f < 8; ++f) poses[f] = ArmsDown(body.skeleton, 95.0, 95.0);
  FitSurfaceToMotion(body, poses);
  EXPECT_TRUE(SameSurface(body.surface, before));
}

TEST(SurfaceFit, FreesArmsThatLieInTheTrunk) {
  // Arms that hang straight down beside the template lie in its ribs.
  Body body = TemplateBody();
  std::vector<Pose> poses;
  for (int f = 0; f < 120; ++f) {
    const double sway = 2.0 * std::sin(0.2 * f);
    poses.push_back(ArmsDown(body.skeleton, 88.0 + sway, 88.0 - sway));
  }
  const BodySurface before = body.surface;
  const SurfaceFit fit = FitSurfaceToMotion(body, poses);
  EXPECT_GT(fit.deep_before, 0.9);
  EXPECT_LT(fit.deep_after, 0.05);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const auto sample = static_cast<SamplePoint>(i);
    EXPECT_GE(fit.sample[i], 0.80 - 1e-12);
    EXPECT_LE(fit.sample[i], 1.0);
    EXPECT_EQ(fit.sample[i], fit.sample[Index(Mirror(sample))]);
    // Samples move level and towards the middle only.
    EXPECT_EQ(body.surface.sample_ms[i].y, before.sample_ms[i].y);
    EXPECT_LE(std::abs(body.surface.sample_ms[i].x), std::abs(before.sample_ms[i].x));
  }
  EXPECT_LT(fit.sample[Index(SamplePoint::kLeftRibs)], 0.95);
  EXPECT_EQ(fit.sample[Index(SamplePoint::kForehead)], 1.0);
  EXPECT_EQ(fit.limb_radius[Index(LimbSegment::kLeftCalf)], 1.0);
}

TEST(SurfaceFit, TreatsBothSidesAlike) {
  Body left = TemplateBody();
  Body right = TemplateBody();
  std::vector<Pose> poses(50, ArmsDown(left.skeleton, 88.0, 40.0));
  const SurfaceFit fit = FitSurfaceToMotion(left, poses);
  EXPECT_LT(fit.sample[Index(SamplePoint::kRightRibs)], 0.95);
  for (Pose& pose : poses) pose = Mirrored(pose);
  const SurfaceFit mirrored = FitSurfaceToMotion(right, poses);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    EXPECT_NEAR(fit.sample[i], mirrored.sample[i], 1e-9);
  }
}

TEST(SurfaceFit, IsScaleFreeInItsFactors) {
  // Only the tolerances are absolute; they are small beside what is asked here.
  Body small = TemplateBody(1.78);
  Body large = Scaled(small, 1.2);
  const std::vector<Pose> poses(50, ArmsDown(small.skeleton, 90.0, 90.0));
  std::vector<Pose> large_poses = poses;
  for (Pose& pose : large_poses) pose.root_ws *= 1.2;
  const SurfaceFit a = FitSurfaceToMotion(small, poses);
  const SurfaceFit b = FitSurfaceToMotion(large, large_poses);
  for (std::size_t i = 0; i < kSampleCount; ++i) EXPECT_NEAR(a.sample[i], b.sample[i], 0.02);
}

}  // namespace
}  // namespace ego
