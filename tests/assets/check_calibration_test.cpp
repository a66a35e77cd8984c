// SPDX-License-Identifier: MIT
#include "assets/calibration/check_calibration.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "assets/calibration/propose_calibration.h"
#include "assets/calibration/test_postures.h"
#include "core/metrics/surface_gap.h"
#include "core/model/avatar_body.h"
#include "tests/support/capsule_person.h"
#include "tests/support/studio_motions.h"

namespace ego {
namespace {

using S = SamplePoint;
using Kind = FindingKind;

class CheckCalibrationTest : public ::testing::Test {
 protected:
  const Character person_ = test::MakeCapsulePerson();
  const SurfaceMesh surface_{person_};
  const CalibrationChecker checker_{person_, surface_};
  AvatarCalibration calibration_ = *ProposeCalibration(person_);

  void Put(PointId id, const Vec3& p) {
    *Find(calibration_, id) = {surface_.PlaceOf(*surface_.Nearest(p)), PickState::kPicked, 1.0, ""};
  }
  const CalibrationFinding* Finding(Kind kind) {
    findings_ = checker_.Check(calibration_);
    for (const CalibrationFinding& f : findings_) {
      if (f.kind == kind) return &f;
    }
    return nullptr;
  }
  std::vector<CalibrationFinding> findings_;
};

TEST_F(CheckCalibrationTest, AGoodCalibrationHasNothingWrongWithItsShape) {
  for (const CalibrationFinding& f : checker_.Check(calibration_)) {
    EXPECT_TRUE(f.kind == Kind::kDoubtfulPoint || f.kind == Kind::kDoubtfulJoint) << f.sentence;
    EXPECT_EQ(f.sentence.back(), '.');
  }
}

TEST_F(CheckCalibrationTest, NamesAFlippedTriangleByTheMisplacedPoint) {
  Put(PointId::Of(S::kLeftChest), {0.0, 1.05, -0.2});  // on the back
  const auto* finding = Finding(Kind::kFlippedTriangle);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->severity, Severity::kError);
  EXPECT_EQ(finding->points.front(), PointId::Of(S::kLeftChest));
  EXPECT_FALSE(finding->triangles.empty());
  EXPECT_EQ(&findings_.front(), finding) << "worst first";
  EXPECT_TRUE(NeedsAPerson(findings_));
}

TEST_F(CheckCalibrationTest, FindsTrianglesWithoutArea) {
  calibration_.At(S::kLeftCheek) = calibration_.At(S::kChin);
  const auto* finding = Finding(Kind::kDegenerateTriangle);
  ASSERT_TRUE(finding);
  EXPECT_NE(finding->sentence.find("hardly any area"), std::string::npos) << finding->sentence;
}

TEST_F(CheckCalibrationTest, FindsACrudeMeshThatCutsThroughItself) {
  Put(PointId::Of(S::kNavel), {0.0, 1.05, 0.4});
  EXPECT_FALSE(Finding(Kind::kSelfCrossing));
  // The lower back far out in front of the belly.
  calibration_.At(S::kLowerBack) = calibration_.At(S::kNavel);
  Put(PointId::Of(S::kNavel), {0.0, 1.2, -0.3});
  EXPECT_TRUE(Finding(Kind::kSelfCrossing));
}

TEST_F(CheckCalibrationTest, FindsPointsOnTheWrongPartOfTheBody) {
  Put(PointId::Of(S::kRightRibs), {-0.6, 1.45, 0.0});  // on the arm
  const auto* finding = Finding(Kind::kOffBody);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->points.front(), PointId::Of(S::kRightRibs));
  EXPECT_NE(finding->sentence.find("right "), std::string::npos) << finding->sentence;
  calibration_ = *ProposeCalibration(person_);
  Put({PointId::Kind::kPalm, 0, 0}, {0.35, 1.45, 0.0});
  EXPECT_TRUE(Finding(Kind::kOffBody));
}

TEST_F(CheckCalibrationTest, FindsLeftAndRightThatDiffer) {
  EXPECT_FALSE(Finding(Kind::kAsymmetric));
  const Vec3 ribs = PosePoint(person_, SkinMatrices(person_, person_.rig.canonical_global),
                              calibration_.At(S::kLeftRibs).place);
  Put(PointId::Of(S::kLeftRibs), ribs + Vec3{0.0, -0.10, 0.0});
  const auto* finding = Finding(Kind::kAsymmetric);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->points,
            (std::vector<PointId>{PointId::Of(S::kLeftRibs), PointId::Of(S::kRightRibs)}));
}

TEST_F(CheckCalibrationTest, ABodyThatIsNotSymmetricMayBeCalibratedSo) {
  const Character lopsided = test::MakeCapsulePerson({.left_arm = 1.6});
  const SurfaceMesh surface(lopsided);
  for (const auto& f : CalibrationChecker(lopsided, surface).Check(*ProposeCalibration(lopsided))) {
    EXPECT_NE(f.kind, Kind::kAsymmetric) << f.sentence;
  }
}

TEST_F(CheckCalibrationTest, FindsCapsulesThatDoNotFitTheSkinAndThoseThatAreMissing) {
  SegmentCalibration& thigh = calibration_.At(LimbSegment::kRightThigh);
  thigh.dots.clear();
  for (const auto& [factor, kind] :
       {std::pair(2.0, Kind::kCapsuleTooFat), std::pair(0.5, Kind::kCapsuleTooThin)}) {
    thigh.radius = factor * 0.065;
    const auto* finding = Finding(kind);
    ASSERT_TRUE(finding);
    EXPECT_EQ(finding->segment, LimbSegment::kRightThigh);
  }
  thigh = {};
  EXPECT_TRUE(Finding(Kind::kMissingRadius));
}

TEST_F(CheckCalibrationTest, FindsMissingPoints) {
  calibration_.At(S::kNavel) = {};
  const auto* finding = Finding(Kind::kMissingPoint);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->points.front(), PointId::Of(S::kNavel));
  EXPECT_NE(finding->sentence.find("Navel"), std::string::npos);
}

TEST_F(CheckCalibrationTest, FindsPointsOnACape) {
  Character caped = person_;
  // A sheet behind the back, carried by the chest, wide enough for the whole trunk.
  MeshPart cape;
  cape.name = "cape";
  for (const float y : {0.9f, 1.5f}) {
    for (const float x : {-0.3f, 0.3f}) cape.positions.emplace_back(x, y, -0.35f);
  }
  cape.normals.resize(4, {0.0f, 0.0f, -1.0f});
  cape.triangles = {0, 2, 1, 1, 2, 3};
  const int chest = caped.rig.node[Index(HumanoidJoint::kChest)];
  const auto entry = std::find_if(caped.palette.begin(), caped.palette.end(),
                                  [&](const PaletteEntry& e) { return e.node == chest; });
  ASSERT_NE(entry, caped.palette.end());
  cape.influences.resize(4);
  for (auto& influence : cape.influences) {
    influence.entry[0] = static_cast<std::uint16_t>(entry - caped.palette.begin());
    influence.weight[0] = 1.0f;
  }
  caped.parts.push_back(cape);
  const SurfaceMesh surface(caped);
  const CalibrationChecker checker(caped, surface);
  AvatarCalibration calibration = *ProposeCalibration(caped);
  const auto loose = [&] {
    const auto findings = checker.Check(calibration);
    return std::any_of(findings.begin(), findings.end(),
                       [](const CalibrationFinding& f) { return f.kind == Kind::kOnLooseCloth; });
  };
  EXPECT_FALSE(loose());
  calibration.At(S::kMidBack) = {
      {static_cast<int>(caped.parts.size()) - 1, 0, Vec3{1.0 / 3.0}}, PickState::kPicked, 1.0, ""};
  EXPECT_TRUE(loose());
}

TEST(TestPostures, TouchOnThePerformerAndEndWhereTheyBegin) {
  TestPostures postures;
  const Body& performer = postures.Performer();
  for (std::size_t i = 0; i < kTestPostureCount; ++i) {
    const auto posture = static_cast<TestPosture>(i);
    SCOPED_TRACE(Title(posture));
    // Onto the performer's own body the method gives the posture back, contacts and all.
    const TestPostureResult same = postures.Apply(performer, posture, 1.0);
    EXPECT_LT(std::abs(same.contact_gap), 1e-5);
    const Pose wanted = postures.PerformerPose(posture, 1.0);
    const ModelPose a = ForwardKinematics(performer.skeleton, wanted);
    const ModelPose b = ForwardKinematics(performer.skeleton, same.pose);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_LT(glm::distance(a.position_ws[j], b.position_ws[j]), 1e-5) << j;
    }
    // At least one hand touches, as the crude mesh sees it.
    double nearest = 1.0;
    const MeasuredBody measured(performer, wanted);
    for (const std::size_t side : {0, 1}) {
      const Limb arm = side == 0 ? Limb::kLeftArm : Limb::kRightArm;
      for (const Vec3& point : {measured.Palm(side), measured.Fingertip(side)}) {
        nearest = std::min(nearest, std::abs(SurfaceGap(measured, arm, point)));
      }
    }
    EXPECT_LT(nearest, 0.015);
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      EXPECT_LT(ArmDepth(MeasuredBody(performer, wanted), arm), 0.03);
    }
    EXPECT_EQ(postures.Apply(performer, posture, 0.0).pose.root_ws,
              postures.Apply(performer, TestPosture::kArmsCrossed, 0.0).pose.root_ws);
    // A little more of a posture is a little more of the motion.
    Vec3 last = postures.Apply(performer, posture, 0.0).pose.root_ws;
    for (double amount = 0.05; amount <= 1.0; amount += 0.05) {
      const Vec3 next = postures.Apply(performer, posture, amount).pose.root_ws;
      EXPECT_LT(glm::distance(last, next), 0.05);
      last = next;
    }
  }
}

TEST(TestPostures, ShowAMisplacedPointAsAGap) {
  TestPostures postures;
  const Body& body = test::StudioBody("Child");
  Body wrong = body;
  // The belly picked far too deep: hands that should lie on it sink into the true one.
  for (const S p : {S::kNavel, S::kLeftBellySide, S::kRightBellySide}) {
    wrong.surface.sample_ms[Index(p)].z += 0.10;
  }
  const Pose pose = postures.Apply(wrong, TestPosture::kHandsOnBelly, 1.0).pose;
  const MeasuredBody measured(body, pose);
  EXPECT_GT(TrunkDistance(measured, measured.Palm(0)), 0.05);
  EXPECT_LT(std::abs(postures.Apply(body, TestPosture::kHandsOnBelly, 1.0).contact_gap), 0.03);
}

}  // namespace
}  // namespace ego
