// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "assets/calibration/calibration_file.h"
#include "assets/gltf/character_file.h"
#include "assets/people/person.h"
#include "assets/people/person_calibration.h"
#include "core/model/avatar_body.h"
#include "core/skeleton/pose.h"
#include "tests/support/skin_oracle.h"
#include "tests/support/studio_people.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using test::DistanceTo;
using test::Skin;
using test::SomePeople;
using test::WeldedSkinOf;

TEST(PeopleBodies, SamplesLieOnTheMesh) {
  for (const Person& person : SomePeople()) {
    const Skin mesh = WeldedSkinOf(person.character);
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      EXPECT_LT(DistanceTo(person.body.surface.sample_ms[i], mesh), 0.0005)
          << person.body.name << " " << Name(static_cast<SamplePoint>(i));
      double sum = 0.0;
      for (const double w : person.body.surface.attachment[i].weight) sum += w;
      EXPECT_NEAR(sum, 1.0, 1e-9);
      const Vec3 p = person.body.surface.sample_ms[i];
      const Vec3 q = person.body.surface.sample_ms[Index(Mirror(static_cast<SamplePoint>(i)))];
      EXPECT_LT(glm::distance(p, Vec3{-q.x, q.y, q.z}), 0.004)
          << person.body.name << " " << Name(static_cast<SamplePoint>(i));
    }
    for (const HandSurface& hand : person.body.surface.hand) {
      EXPECT_LT(DistanceTo(hand.palm_ms, mesh), 0.0005) << person.body.name;
      EXPECT_LT(DistanceTo(hand.fingertip_ms, mesh), 0.0005) << person.body.name;
      EXPECT_GT(hand.half_thickness, 0.005);
    }
    for (const FootSurface& foot : person.body.surface.foot) {
      EXPECT_NEAR(foot.heel_ms.y, 0.0, 0.002) << person.body.name;
      EXPECT_NEAR(foot.ball_ms.y, 0.0, 0.002) << person.body.name;
      EXPECT_LT(DistanceTo(foot.toe_tip_ms, mesh), 0.0005);
    }
  }
}

TEST(PeopleBodies, CrudeMeshesAreTurnedOutward) {
  for (const Person& person : SomePeople()) {
    double trunk = 0.0;
    double head = 0.0;
    for (std::size_t i = 0; i < kTriangleCount; ++i) {
      const SampleTriangle& t = SampleTriangles()[i];
      const auto p = [&](std::size_t k) { return person.body.surface.sample_ms[Index(t[k])]; };
      (i < kTrunkTriangleCount ? trunk : head) += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
    }
    const double cube = std::pow(person.body.height, 3.0);
    EXPECT_GT(trunk, 0.0018 * cube) << person.body.name;
    EXPECT_GT(head, 0.0002 * cube) << person.body.name;
  }
}

/// Where a plane cuts the skin.
std::vector<std::pair<Vec3, Vec3>> Section(const Skin& skin, const Vec3& point,
                                           const Vec3& normal) {
  std::vector<std::pair<Vec3, Vec3>> section;
  for (const auto& t : skin.triangles) {
    std::vector<Vec3> cut;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& a = skin.position[t[c]];
      const Vec3& b = skin.position[t[(c + 1) % 3]];
      const double ha = glm::dot(a - point, normal);
      const double hb = glm::dot(b - point, normal);
      if ((ha < 0.0) != (hb < 0.0)) cut.push_back(a + ha / (ha - hb) * (b - a));
    }
    if (cut.size() == 2) section.emplace_back(cut[0], cut[1]);
  }
  return section;
}

/// Appendix E of the paper, centimetres.
struct Wanted {
  const char* name;
  double height, arm, upper_arm, lower_arm, leg, upper_leg, lower_leg, belly;
};
constexpr std::array<Wanted, 3> kAppendixE = {{{"Child", 120, 38, 5, 4, 48, 6, 5, 17},
                                               {"Alien", 152, 42, 3, 2, 66, 5, 2, 27},
                                               {"Woman", 168, 51, 5, 4, 80, 8, 4, 16}}};

TEST(PeopleBodies, AppendixEIsMetOnTheMesh) {
  std::printf("appendix E, cm         H    AL   UAR   LAR    LL   ULR   LLR     BT\n");
  for (const Wanted& wanted : kAppendixE) {
    const auto it = std::find_if(SomePeople().begin(), SomePeople().end(),
                                 [&](const Person& p) { return p.body.name == wanted.name; });
    ASSERT_NE(it, SomePeople().end());
    const Person& person = *it;
    const Skeleton& skeleton = person.body.skeleton;
    const Skin mesh = WeldedSkinOf(person.character);
    double top = 0.0;
    for (const Vec3& p : mesh.position) top = std::max(top, p.y);
    // Belly: depth of the section at the navel's height, near the middle.
    const double navel = person.body.surface.sample_ms[Index(SamplePoint::kNavel)].y;
    double front = -1.0;
    double back = 1.0;
    for (const auto& [a, b] : Section(mesh, {0.0, navel, 0.0}, kUp)) {
      for (const Vec3& p : {a, b}) {
        if (std::abs(p.x) > 0.03) continue;
        front = std::max(front, p.z);
        back = std::min(back, p.z);
      }
    }
    // Radii: mean distance from the bone over the angle, in sections of the segment's middle.
    const std::array<Vec3, kJointCount> joint = CanonicalPositions(skeleton);
    const auto radius = [&](J start, J end) {
      const Vec3 from = joint[Index(start)];
      const Vec3 bone = joint[Index(end)] - from;
      double sum = 0.0;
      double turn = 0.0;
      for (double t = 0.3; t < 0.701; t += 0.05) {
        const Vec3 middle = from + t * bone;
        for (const auto& [a, b] : Section(mesh, middle, glm::normalize(bone))) {
          const double ra = glm::distance(a, middle);
          const double rb = glm::distance(b, middle);
          if (std::min(a.x, b.x) < 0.0 || ra > 0.15) continue;  // of the other leg or the trunk
          const double angle =
              std::acos(std::clamp(glm::dot(a - middle, b - middle) / (ra * rb), -1.0, 1.0));
          sum += 0.5 * (ra + rb) * angle;
          turn += angle;
        }
      }
      return sum / turn;
    };
    const double arm = BoneLength(skeleton, J::kLeftLowerArm) + BoneLength(skeleton, J::kLeftHand);
    const double leg = BoneLength(skeleton, J::kLeftLowerLeg) + BoneLength(skeleton, J::kLeftFoot);
    const double uar = radius(J::kLeftUpperArm, J::kLeftLowerArm);
    const double lar = radius(J::kLeftLowerArm, J::kLeftHand);
    const double ulr = radius(J::kLeftUpperLeg, J::kLeftLowerLeg);
    const double llr = radius(J::kLeftLowerLeg, J::kLeftFoot);
    const auto row = [&](const char* what, double h, double al, double u, double l, double ll,
                         double ul, double lo, double bt) {
      std::printf("%-7s %-9s %6.1f %5.1f %5.2f %5.2f %5.1f %5.2f %5.2f %6.2f\n", wanted.name, what,
                  h, al, u, l, ll, ul, lo, bt);
    };
    row("wanted", wanted.height, wanted.arm, wanted.upper_arm, wanted.lower_arm, wanted.leg,
        wanted.upper_leg, wanted.lower_leg, wanted.belly);
    row("measured", 100 * top, 100 * arm, 100 * uar, 100 * lar, 100 * leg, 100 * ulr, 100 * llr,
        100 * (front - back));
    EXPECT_NEAR(100 * top / wanted.height, 1.0, 0.005);
    EXPECT_NEAR(100 * arm, wanted.arm, 1e-6);
    EXPECT_NEAR(100 * leg, wanted.leg, 1e-6);
    EXPECT_NEAR(100 * uar / wanted.upper_arm, 1.0, 0.02);
    EXPECT_NEAR(100 * lar / wanted.lower_arm, 1.0, 0.02);
    EXPECT_NEAR(100 * ulr / wanted.upper_leg, 1.0, 0.02);
    EXPECT_NEAR(100 * llr / wanted.lower_leg, 1.0, 0.02);
    EXPECT_NEAR(100 * (front - back) / wanted.belly, 1.0, 0.02);
    // What the calibration says of itself.
    using L = LimbSegment;
    const auto calibrated = [&](L s) { return 100 * person.body.surface.limb_radius[Index(s)]; };
    EXPECT_NEAR(calibrated(L::kLeftUpperArm) / wanted.upper_arm, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kRightForearm) / wanted.lower_arm, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kLeftThigh) / wanted.upper_leg, 1.0, 0.02);
    EXPECT_NEAR(calibrated(L::kRightCalf) / wanted.lower_leg, 1.0, 0.02);
  }
}

TEST(PeopleBodies, RigIsTheCanonicalPose) {
  for (const Person& person : SomePeople()) {
    const Rig& rig = person.character.rig;
    std::vector<Mat4> nodes(person.character.nodes.joints.size());
    PoseNodes(rig, ForwardKinematics(rig.skeleton, CanonicalPose(rig.skeleton)), nodes);
    const std::vector<Mat4> rest = person.character.nodes.RestGlobal();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (int c = 0; c < 4; ++c) {
        EXPECT_LT(glm::length(nodes[n][c] - rest[n][c]), 1e-12);
      }
    }
    for (const PaletteEntry& entry : person.character.palette) {
      const Mat4 m = nodes[static_cast<std::size_t>(entry.node)] * entry.inverse_bind;
      EXPECT_LT(glm::length(m[3] - Vec4(0.0, 0.0, 0.0, 1.0)), 1e-12);
    }
  }
}

/// A folder that goes away.
struct TemporaryFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ego_people_" + std::to_string(::getpid()));
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
};

TEST(PeopleBodies, FilesGiveTheSameBodyBack) {
  const TemporaryFolder folder;
  for (const Person& person : SomePeople()) {
    const auto path = folder.path / "person.glb";
    ASSERT_TRUE(WriteCharacter(path, person.character));
    ASSERT_TRUE(
        WriteCalibration(CalibrationPathFor(path), person.character, CalibrationOf(person)));
    const Result<Character> character = ReadCharacter(path);
    ASSERT_TRUE(character) << character.error();
    const Result<LoadedCalibration> calibration =
        ReadCalibration(CalibrationPathFor(path), *character);
    ASSERT_TRUE(calibration) << calibration.error();
    EXPECT_TRUE(calibration->warnings.empty()) << calibration->warnings[0];
    const Body body = MakeAvatarBody(*character, calibration->calibration);

    const std::array<Vec3, kJointCount> joint = CanonicalPositions(body.skeleton);
    const std::array<Vec3, kJointCount> exact = CanonicalPositions(person.body.skeleton);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_LT(glm::distance(joint[j], exact[j]), 1e-4)
          << person.body.name << " " << Name(static_cast<J>(j));
    }
    EXPECT_NEAR(body.height, person.body.height, 0.003) << person.body.name;
    const BodySurface& a = body.surface;
    const BodySurface& b = person.body.surface;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      EXPECT_LT(glm::distance(a.sample_ms[i], b.sample_ms[i]), 1e-4) << person.body.name;
    }
    for (std::size_t s = 0; s < kSegmentCount; ++s) {
      EXPECT_NEAR(a.limb_radius[s], b.limb_radius[s], 1e-6) << person.body.name;
    }
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_LT(glm::distance(a.hand[side].palm_ms, b.hand[side].palm_ms), 1e-4);
      EXPECT_LT(glm::distance(a.hand[side].fingertip_ms, b.hand[side].fingertip_ms), 1e-4);
      EXPECT_NEAR(a.hand[side].half_thickness, b.hand[side].half_thickness, 2e-4);
      EXPECT_LT(glm::distance(a.foot[side].heel_ms, b.foot[side].heel_ms), 1e-4);
      EXPECT_LT(glm::distance(a.foot[side].toe_tip_ms, b.foot[side].toe_tip_ms), 1e-4);
    }
    // Fingers stay fingers: they follow the hand and are still there under their names.
    std::size_t fingers = 0;
    for (std::size_t n = 0; n < character->nodes.joints.size(); ++n) {
      if (character->nodes.joints[n].name != "leftIndexIntermediate") continue;
      ++fingers;
      EXPECT_EQ(character->rig.driver[n], J::kLeftHand);
    }
    EXPECT_EQ(fingers, 1u);
  }
}

}  // namespace
}  // namespace ego
