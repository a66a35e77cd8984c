// SPDX-License-Identifier: MIT
#include "core/model/avatar_body.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/model/mesh_bvh.h"
#include "core/model/rig.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

using J = HumanoidJoint;

Pose BentPose(const Skeleton& skeleton) {
  Pose pose = CanonicalPose(skeleton);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto a = static_cast<double>(j);
    pose.rotation_ls[j] = glm::angleAxis(
        0.5 * std::sin(1.7 * a + 0.3),
        glm::normalize(Vec3{std::sin(a), std::cos(2.0 * a), std::sin(0.7 * a + 1.0)}));
  }
  pose.root_ws += Vec3{0.3, 0.1, -0.2};
  return pose;
}

/// A calibration whose samples are the places of the skin nearest to the template's points.
AvatarCalibration NearestCalibration(const Character& character) {
  const MeshBvh bvh(character, CanonicalMesh(character));
  const Body body = TemplateBodyOf(character);
  AvatarCalibration calibration;
  const auto put = [&](CalibrationPoint& point, const Vec3& p) {
    point.place = bvh.Nearest(p)->place;
    point.state = PickState::kPicked;
    point.confidence = 1.0;
  };
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    put(calibration.sample[i], body.surface.sample_ms[i]);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    put(calibration.hand[side].palm, body.surface.hand[side].palm_ms);
    put(calibration.foot[side].heel, body.surface.foot[side].heel_ms);
  }
  return calibration;
}

TEST(AvatarBody, PutsThePointsWhereTheCanonicalSkinHasThem) {
  const Character character = test::MakeCapsulePerson();
  const AvatarCalibration calibration = NearestCalibration(character);
  const Body body = MakeAvatarBody(character, calibration);
  const PosedMesh mesh = CanonicalMesh(character);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const Vec3 on_skin = Position(character, mesh, calibration.sample[i].place);
    EXPECT_LT(glm::distance(body.surface.sample_ms[i], on_skin), 1e-12);
  }
  EXPECT_LT(glm::distance(body.surface.hand[0].palm_ms,
                          Position(character, mesh, calibration.hand[0].palm.place)),
            1e-12);
  EXPECT_LT(glm::distance(body.surface.foot[1].heel_ms,
                          Position(character, mesh, calibration.foot[1].heel.place)),
            1e-12);
  EXPECT_EQ(body.standing_root_height, character.rig.skeleton.offset[0].y);
  EXPECT_NEAR(body.height, 1.78, 0.01);
}

// The oracle skins the mesh with matrices, node by node; the body knows only joints.
TEST(AvatarBody, SamplesFollowTheDrawnSkinInAnyPose) {
  const Character character = test::MakeCapsulePerson();
  const AvatarCalibration calibration = NearestCalibration(character);
  const Body body = MakeAvatarBody(character, calibration);
  const ModelPose pose = ForwardKinematics(body.skeleton, BentPose(body.skeleton));
  std::vector<Mat4> nodes(character.nodes.joints.size());
  PoseNodes(character.rig, pose, nodes);
  const PosedMesh skinned = PoseMesh(character, nodes);
  std::array<Vec3, kSampleCount> sample_ws;
  PoseSamples(body.skeleton, body.surface, pose, sample_ws);
  // A rig skins corners with their own weights, the sample with the mean weights at its place:
  // linear blending is linear in both, so they differ only by the weights' change over a triangle.
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const Vec3 drawn = Position(character, skinned, calibration.sample[i].place);
    EXPECT_LT(glm::distance(sample_ws[i], drawn), 0.004) << Name(static_cast<SamplePoint>(i));
  }
}

TEST(AvatarBody, SamplesAtVerticesFollowTheSkinToRounding) {
  const Character character = test::MakeCapsulePerson();
  AvatarCalibration calibration = NearestCalibration(character);
  for (CalibrationPoint& point : calibration.sample) {
    point.place = AtCorner(point.place.part, point.place.triangle, 1);
  }
  const Body body = MakeAvatarBody(character, calibration);
  const ModelPose pose = ForwardKinematics(body.skeleton, BentPose(body.skeleton));
  std::array<Vec3, kSampleCount> sample_ws;
  PoseSamples(body.skeleton, body.surface, pose, sample_ws);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const MeshPoint& place = calibration.sample[i].place;
    const MeshPart& part = character.parts[static_cast<std::size_t>(place.part)];
    const std::size_t v = part.triangles[3 * place.triangle + 1];
    Vec3 expected{0.0};
    for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
      const double weight = part.influences[v].weight[k];
      const auto j = static_cast<std::size_t>(part.influences[v].entry[k]);
      const Vec3 joint = CanonicalPositions(character.rig.skeleton)[j];
      expected +=
          weight * (pose.position_ws[j] + pose.rotation_ws[j] * (Vec3(part.positions[v]) - joint));
    }
    EXPECT_LT(glm::distance(sample_ws[i], expected), 1e-6) << i;  // weights are floats
  }
}

TEST(AvatarBody, RadiusIsTheDotsAverageDistanceToTheBone) {
  const Character character = test::MakeCapsulePerson({.arm_radius = 0.06});
  const MeshBvh bvh(character, CanonicalMesh(character));
  AvatarCalibration calibration;
  const auto joint = CanonicalPositions(character.rig.skeleton);
  const Vec3 middle = 0.5 * (joint[Index(J::kLeftUpperArm)] + joint[Index(J::kLeftLowerArm)]);
  for (const Vec3 direction : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
    CalibrationPoint dot;
    dot.place = bvh.FirstHit(middle, direction, 1.0)->place;
    dot.state = PickState::kPicked;
    calibration.At(LimbSegment::kLeftUpperArm).dots.push_back(dot);
  }
  calibration.At(LimbSegment::kLeftThigh).radius = 0.123;  // given, no dots
  const Body body = MakeAvatarBody(character, calibration);
  EXPECT_NEAR(body.surface.limb_radius[Index(LimbSegment::kLeftUpperArm)], 0.06, 0.001);
  EXPECT_EQ(body.surface.limb_radius[Index(LimbSegment::kLeftThigh)], 0.123);
  EXPECT_EQ(body.surface.limb_radius[Index(LimbSegment::kRightCalf)],
            TemplateBodyOf(character).surface.limb_radius[Index(LimbSegment::kRightCalf)]);
}

TEST(AvatarBody, MissingOrImpossiblePlacesAreTheTemplates) {
  const Character character = test::MakeCapsulePerson();
  AvatarCalibration calibration;
  calibration.At(SamplePoint::kNavel).state = PickState::kPicked;
  calibration.At(SamplePoint::kNavel).place = {0, 4000000u, {1.0, 0.0, 0.0}};
  const Body body = MakeAvatarBody(character, calibration);
  const Body usual = TemplateBodyOf(character);
  EXPECT_EQ(body.surface.sample_ms, usual.surface.sample_ms);
  EXPECT_EQ(body.height, usual.height);
}

TEST(AvatarCalibrationNames, AreUniqueAndCoverEveryPoint) {
  AvatarCalibration calibration;
  calibration.At(LimbSegment::kLeftCalf).dots.resize(2);
  auto points = AllPoints(calibration);
  EXPECT_EQ(points.size(), kSampleCount + 12 + 2);
  std::sort(points.begin(), points.end(),
            [](const NamedPoint& a, const NamedPoint& b) { return a.name < b.name; });
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_NE(points[i].name, points[i - 1].name);
}

TEST(MeshHash, ChangesWithTheMeshAndOnlyWithIt) {
  Character character = test::MakeCapsulePerson();
  const std::uint64_t hash = MeshHash(character);
  EXPECT_EQ(MeshHash(test::MakeCapsulePerson()), hash);
  character.name = "another name";
  EXPECT_EQ(MeshHash(character), hash);
  character.parts[0].positions[5].x += 1e-4f;
  EXPECT_NE(MeshHash(character), hash);
}

}  // namespace
}  // namespace ego
