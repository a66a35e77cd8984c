// SPDX-License-Identifier: MIT
#include "core/body/body.h"

#include <algorithm>
#include <map>
#include <utility>

#include <gtest/gtest.h>

namespace ego {
namespace {

TEST(SampleTriangles, AreTwoClosedManifolds) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const SampleTriangle& t : SampleTriangles()) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{Index(t[k]), Index(t[(k + 1) % 3])}];
    EXPECT_EQ(IsHead(t[0]), IsHead(t[1]));
    EXPECT_EQ(IsHead(t[0]), IsHead(t[2]));
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1) << edge.first << "-" << edge.second;
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u)
        << Name(static_cast<SamplePoint>(edge.first)) << "-"
        << Name(static_cast<SamplePoint>(edge.second));
  }
}

TEST(SampleTriangles, EnclosePositiveVolumeAndFaceOutward) {
  const Body body = TemplateBody();
  double trunk = 0.0;
  double head = 0.0;
  for (std::size_t i = 0; i < kTriangleCount; ++i) {
    const SampleTriangle& t = SampleTriangles()[i];
    const auto p = [&](std::size_t k) { return body.surface.sample_ms[Index(t[k])]; };
    const double volume = glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
    (i < kTrunkTriangleCount ? trunk : head) += volume;
    // Star-shaped about the middle of each part, so every face looks away from it.
    const Vec3 centre = i < kTrunkTriangleCount ? Vec3{0.0, 1.2, -0.02} : Vec3{0.0, 1.66, 0.01};
    const Vec3 normal = glm::cross(p(1) - p(0), p(2) - p(0));
    EXPECT_GT(glm::dot(normal, p(0) - centre), 0.0) << "triangle " << i;
  }
  EXPECT_GT(trunk, 0.02);  // an adult's trunk holds about 40 litres, the crude mesh less
  EXPECT_LT(trunk, 0.06);
  EXPECT_GT(head, 0.0015);
  EXPECT_LT(head, 0.006);
}

TEST(SampleTriangles, OddOnesMirrorEvenOnes) {
  for (std::size_t i = 0; i < kTriangleCount; i += 2) {
    const SampleTriangle& left = SampleTriangles()[i];
    const SampleTriangle& right = SampleTriangles()[i + 1];
    EXPECT_EQ(right[0], Mirror(left[0]));
    EXPECT_EQ(right[1], Mirror(left[2]));
    EXPECT_EQ(right[2], Mirror(left[1]));
    EXPECT_EQ(ParentJoint(i), ParentJoint(i + 1));
  }
}

TEST(SamplePoint, NamesRoundTripAndMirrorIsAnInvolution) {
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const auto point = static_cast<SamplePoint>(i);
    EXPECT_EQ(SamplePointNamed(Name(point)), point);
    EXPECT_EQ(Mirror(Mirror(point)), point);
    EXPECT_EQ(IsHead(Mirror(point)), IsHead(point));
  }
  EXPECT_FALSE(SamplePointNamed("elbow"));
}

TEST(HumanoidJoint, MirrorSwapsSidesOnly) {
  EXPECT_EQ(Mirror(HumanoidJoint::kHead), HumanoidJoint::kHead);
  EXPECT_EQ(Mirror(HumanoidJoint::kLeftHand), HumanoidJoint::kRightHand);
  EXPECT_EQ(Mirror(HumanoidJoint::kRightShoulder), HumanoidJoint::kLeftShoulder);
  EXPECT_EQ(Mirror(HumanoidJoint::kLeftToes), HumanoidJoint::kRightToes);
  EXPECT_EQ(Mirror(HumanoidJoint::kRightUpperLeg), HumanoidJoint::kLeftUpperLeg);
}

TEST(TemplateBody, IsSymmetricAndScales) {
  const Body body = TemplateBody(1.78);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const Vec3 p = body.surface.sample_ms[i];
    const Vec3 m = body.surface.sample_ms[Index(Mirror(static_cast<SamplePoint>(i)))];
    EXPECT_NEAR(p.x, -m.x, 1e-12);
    EXPECT_NEAR(p.y, m.y, 1e-12);
    EXPECT_NEAR(p.z, m.z, 1e-12);
  }
  const Body child = TemplateBody(1.2);
  const Body scaled = Scaled(body, 1.2 / 1.78);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    EXPECT_LT(glm::distance(child.surface.sample_ms[i], scaled.surface.sample_ms[i]), 1e-9);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    EXPECT_NEAR(child.surface.limb_radius[s], scaled.surface.limb_radius[s], 1e-9);
  }
}

TEST(Pose, MirroringTwiceGivesTheSameAndMirrorsPositions) {
  const Skeleton skeleton = TemplateSkeleton(1.78);
  Pose pose = CanonicalPose(skeleton);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const double a = 0.1 * static_cast<double>(i + 1);
    pose.rotation_ls[i] =
        glm::angleAxis(a, glm::normalize(Vec3{std::sin(3.0 * a), std::cos(a), a}));
  }
  const ModelPose posed = ForwardKinematics(skeleton, pose);
  const ModelPose mirrored = ForwardKinematics(skeleton, Mirrored(pose));
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 p = posed.position_ws[i];
    const Vec3 m = mirrored.Position(Mirror(static_cast<HumanoidJoint>(i)));
    EXPECT_NEAR(p.x, -m.x, 1e-12);
    EXPECT_NEAR(p.y, m.y, 1e-12);
    EXPECT_NEAR(p.z, m.z, 1e-12);
  }
  const Pose back = PoseFromWorldRotations(posed.rotation_ws, posed.position_ws[0]);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_NEAR(std::abs(glm::dot(back.rotation_ls[i], pose.rotation_ls[i])), 1.0, 1e-12);
  }
}

TEST(PoseSamples, CanonicalPoseLeavesThemInPlace) {
  const Body body = TemplateBody();
  const ModelPose pose = ForwardKinematics(body.skeleton, CanonicalPose(body.skeleton));
  std::array<Vec3, kSampleCount> sample_ws;
  PoseSamples(body.skeleton, body.surface, pose, sample_ws);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    EXPECT_LT(glm::distance(sample_ws[i], body.surface.sample_ms[i]), 1e-12);
  }
}

}  // namespace
}  // namespace ego
