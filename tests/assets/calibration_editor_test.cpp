// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_editor.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "assets/calibration/calibration_file.h"
#include "assets/calibration/calibration_recovery.h"
#include "assets/files/file_io.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

namespace fs = std::filesystem;
using S = SamplePoint;

constexpr PointId kNavelId = PointId::Of(S::kNavel);
constexpr PointId kLeftEarId = PointId::Of(S::kLeftEar);
constexpr PointId kRightEarId = PointId::Of(S::kRightEar);

class CalibrationEditorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("ego_editor_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  CalibrationEditor Editor(Character character = test::MakeCapsulePerson()) {
    character.source_path = (folder_ / "person.glb").string();
    Result<CalibrationDocument> document = OpenCalibration(std::move(character));
    EXPECT_TRUE(document) << document.error();
    return CalibrationEditor(*std::move(document));
  }
  static MeshPoint NearestTo(const CalibrationEditor& editor, const Vec3& p) {
    return editor.Surface().PlaceOf(*editor.Surface().Nearest(p));
  }
  static Vec3 At(const CalibrationEditor& editor, PointId id) {
    return Position(*editor.TheCharacter(), CanonicalMesh(*editor.TheCharacter()),
                    Find(editor.Calibration(), id)->place);
  }

  fs::path folder_;
};

TEST_F(CalibrationEditorTest, APickIsSettledMirroredAndUndoneInOneStep) {
  CalibrationEditor editor = Editor();
  EXPECT_FALSE(editor.Unsaved());
  EXPECT_FALSE(editor.CanUndo());
  const AvatarCalibration before = editor.Calibration();
  const MeshPoint place = NearestTo(editor, {0.08, 1.66, 0.02});
  ASSERT_TRUE(editor.Pick(kLeftEarId, place));
  EXPECT_TRUE(editor.Note().empty()) << editor.Note();
  EXPECT_EQ(Find(editor.Calibration(), kLeftEarId)->place, place);
  for (const PointId id : {kLeftEarId, kRightEarId}) {
    EXPECT_EQ(Find(editor.Calibration(), id)->state, PickState::kPicked);
    EXPECT_EQ(Find(editor.Calibration(), id)->confidence, 1.0);
  }
  const Vec3 left = At(editor, kLeftEarId);
  EXPECT_LT(glm::distance(At(editor, kRightEarId), Vec3{-left.x, left.y, left.z}), 1e-5);
  EXPECT_EQ(editor.AvatarBody().surface.sample_ms[Index(S::kLeftEar)], left);
  EXPECT_TRUE(editor.Unsaved());
  EXPECT_EQ(editor.UndoLabel(), "Pick left ear");
  ASSERT_TRUE(editor.Undo());
  EXPECT_EQ(editor.Calibration(), before);
  EXPECT_FALSE(editor.Unsaved());
  EXPECT_FALSE(editor.CanUndo());
  ASSERT_TRUE(editor.Redo());
  EXPECT_EQ(Find(editor.Calibration(), kLeftEarId)->place, place);
}

TEST_F(CalibrationEditorTest, WithoutAMirrorVertexOneSideIsPickedAndTheReasonTold) {
  Character person = test::MakeCapsulePerson();
  // A dent in the right side of the skull.
  for (MeshPart& part : person.parts) {
    for (glm::vec3& p : part.positions) {
      if (p.x < -0.02f && p.y > 1.6f) p.x *= 0.5f;
    }
  }
  CalibrationEditor editor = Editor(person);
  const AvatarCalibration before = editor.Calibration();
  const MeshPoint place = NearestTo(editor, {0.08, 1.66, 0.02});
  ASSERT_TRUE(editor.Pick(kLeftEarId, place));
  EXPECT_EQ(editor.Note().rfind("no mirror vertex here", 0), 0u) << editor.Note();
  EXPECT_EQ(*Find(editor.Calibration(), kRightEarId), *Find(before, kRightEarId));
  const Result<void> mirrored = editor.MirrorToOtherSide(kLeftEarId);
  EXPECT_EQ(mirrored.error().rfind("no mirror vertex here", 0), 0u) << mirrored.error();
  ASSERT_TRUE(editor.Undo());
  EXPECT_FALSE(editor.CanUndo());
  editor.SetSymmetric(false);
  ASSERT_TRUE(editor.Pick(kLeftEarId, place));
  EXPECT_TRUE(editor.Note().empty());
}

TEST_F(CalibrationEditorTest, ADragIsOneStepAndEscapeTakesItBack) {
  CalibrationEditor editor = Editor();
  const PosedMesh posed = CanonicalMesh(*editor.TheCharacter());
  const AvatarCalibration before = editor.Calibration();
  const Vec3 start = At(editor, kNavelId);
  for (const bool keep : {false, true}) {
    editor.BeginGroup("Drag navel");
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(editor.Walk(kNavelId, {0.004, 0.002, 0.0}, posed));
      EXPECT_FALSE(editor.CanUndo());
    }
    EXPECT_GT(At(editor, kNavelId).x, start.x + 0.02);
    if (keep) {
      editor.EndGroup();
    } else {
      editor.CancelGroup();
      EXPECT_EQ(editor.Calibration(), before);
    }
  }
  EXPECT_EQ(editor.UndoLabel(), "Drag navel");
  ASSERT_TRUE(editor.Undo());
  EXPECT_EQ(editor.Calibration(), before);
  EXPECT_FALSE(editor.CanUndo());
}

TEST_F(CalibrationEditorTest, ArrowKeysStepAlongEdges) {
  CalibrationEditor editor = Editor();
  const PosedMesh posed = CanonicalMesh(*editor.TheCharacter());
  const Vec3 start = At(editor, kNavelId);
  ASSERT_TRUE(editor.Step(kNavelId, {0.0, 1.0, 0.0}, posed));
  const Vec3 higher = At(editor, kNavelId);
  EXPECT_GT(higher.y, start.y);
  const auto vertex = editor.Surface().VertexAt(Find(editor.Calibration(), kNavelId)->place);
  EXPECT_EQ(editor.Surface().Position(*vertex), higher);
}

// Whatever was done, undoing all of it leads back bit for bit, and redoing all of it forth.
TEST_F(CalibrationEditorTest, RandomEditsAreUndoneAndRedoneExactly) {
  CalibrationEditor editor = Editor();
  const PosedMesh posed = CanonicalMesh(*editor.TheCharacter());
  const AvatarCalibration first = editor.Calibration();
  std::mt19937 random(5);
  const auto pick = [&] { return PickOrder()[random() % PickOrder().size()]; };
  const auto segment = [&] { return static_cast<LimbSegment>(random() % kSegmentCount); };
  const auto place = [&] {
    return editor.Surface().PlaceOf(
        static_cast<SurfaceMesh::Vertex>(random() % editor.Surface().VertexCount()));
  };
  for (int i = 0; i < 120; ++i) {
    editor.SetSymmetric(random() % 2 == 0);
    switch (random() % 11) {
      case 0:
        static_cast<void>(editor.Pick(pick(), place()));
        break;
      case 1:
        static_cast<void>(editor.Step(pick(), {1.0, 0.3, 0.0}, posed));
        break;
      case 2:
        static_cast<void>(editor.Walk(pick(), {0.0, 0.1, 0.02}, posed));
        break;
      case 3:
        static_cast<void>(editor.Delete(pick()));
        break;
      case 4:
        static_cast<void>(editor.Confirm(pick()));
        break;
      case 5:
        static_cast<void>(editor.SetLimbPoint(segment(), random() % 30, place()));
        break;
      case 6:
        static_cast<void>(editor.SetRing(segment(), 0.3 + 0.1 * static_cast<double>(random() % 5)));
        break;
      case 7:
        static_cast<void>(editor.SetRadius(segment(), 0.05));
        break;
      case 8:
        static_cast<void>(editor.ResetToProposal(pick()));
        break;
      case 9:
        static_cast<void>(editor.Delete(PointId::Of(segment(), random() % 10)));
        break;
      default:
        static_cast<void>(editor.MirrorToOtherSide(pick()));
        break;
    }
  }
  editor.ConfirmAll(0.6);
  const AvatarCalibration last = editor.Calibration();
  std::size_t steps = 0;
  while (editor.Undo()) ++steps;
  EXPECT_GT(steps, 60u);
  EXPECT_EQ(editor.Calibration(), first);
  EXPECT_FALSE(editor.Unsaved());
  while (editor.Redo()) --steps;
  EXPECT_EQ(steps, 0u);
  EXPECT_EQ(editor.Calibration(), last);
}

TEST_F(CalibrationEditorTest, AsksForDoubtfulPointsFirstAndForNoneWhenAllAreSettled) {
  CalibrationEditor editor = Editor();
  editor.SetSymmetric(false);
  ASSERT_TRUE(editor.Delete(kLeftEarId));
  EXPECT_EQ(editor.NextPoint(), kLeftEarId);
  EXPECT_FALSE(editor.Confirm(kLeftEarId)) << "what has no place cannot be confirmed";
  ASSERT_TRUE(editor.ResetToProposal(kLeftEarId));
  std::optional<PointId> at;
  std::size_t asked = 0;
  while ((at = editor.NextPoint(at))) {
    ASSERT_TRUE(editor.Confirm(*at)) << Name(*at);
    EXPECT_EQ(editor.Settled(), ++asked);
  }
  EXPECT_EQ(asked, PickOrder().size());
}

TEST_F(CalibrationEditorTest, LimbPointsMakeTheCapsule) {
  CalibrationEditor editor = Editor(test::MakeCapsulePerson({.left_arm = 1.4}));
  editor.SetSymmetric(false);
  constexpr LimbSegment kArm = LimbSegment::kLeftUpperArm;
  const auto radius = [&] { return editor.Calibration().At(kArm).radius; };
  ASSERT_TRUE(editor.SetRadius(kArm, 0.2));
  EXPECT_EQ(editor.AvatarBody().surface.limb_radius[Index(kArm)], 0.2);
  EXPECT_EQ(editor.Findings().front().kind, FindingKind::kCapsuleTooFat);
  ASSERT_TRUE(editor.SetRing(kArm, 0.5));
  EXPECT_EQ(editor.Calibration().At(kArm).dots.size(), 8u);
  EXPECT_NEAR(radius(), 1.4 * 0.045, 0.001);
  ASSERT_TRUE(editor.SetRing(kArm, 0.5, 5)) << "a ring takes the place of one near it";
  EXPECT_EQ(editor.Calibration().At(kArm).dots.size(), 5u);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(editor.Delete(PointId::Of(kArm, 0)));
  EXPECT_EQ(editor.Calibration().At(kArm).state, PickState::kMissing);
  EXPECT_FALSE(editor.Delete(PointId::Of(kArm, 0)));
  EXPECT_FALSE(editor.SetRadius(kArm, -1.0));
  ASSERT_TRUE(editor.SetLimbPoint(kArm, 0, NearestTo(editor, {0.35, 1.5, 0.0})));
  EXPECT_NEAR(radius(), 1.4 * 0.045, 0.004);
}

TEST_F(CalibrationEditorTest, AMendedJointMapIsStoredAndUsedAgain) {
  CalibrationEditor editor = Editor();
  const int hand = editor.TheCharacter()->map.Node(HumanoidJoint::kLeftHand);
  ASSERT_GE(hand, 0);
  ASSERT_TRUE(editor.Pick(kNavelId, NearestTo(editor, {0.0, 1.05, 0.2})));
  const std::size_t character = editor.CharacterRevision();
  // The rig loses its left hand: the forearm's end is all there is.
  ASSERT_TRUE(editor.SetJointOverride(HumanoidJoint::kLeftHand, -1));
  EXPECT_GT(editor.CharacterRevision(), character);
  EXPECT_EQ(editor.TheCharacter()->map.Node(HumanoidJoint::kLeftHand), -1);
  EXPECT_EQ(Find(editor.Calibration(), kNavelId)->state, PickState::kPicked);
  EXPECT_FALSE(editor.SetJointOverride(HumanoidJoint::kHead, -1));
  EXPECT_FALSE(editor.SetJointOverride(HumanoidJoint::kLeftHand, 100000));
  ASSERT_TRUE(editor.Save());
  EXPECT_FALSE(editor.Unsaved());

  Character again = test::MakeCapsulePerson();
  again.source_path = (folder_ / "person.glb").string();
  const auto loaded = LoadCalibrated(again);
  ASSERT_TRUE(loaded) << loaded.error();
  EXPECT_TRUE(loaded->from_file);
  EXPECT_EQ(loaded->character->map.Node(HumanoidJoint::kLeftHand), -1);
  EXPECT_EQ(loaded->as_read->map.Node(HumanoidJoint::kLeftHand), hand);
  EXPECT_EQ(loaded->calibration, editor.Calibration());

  ASSERT_TRUE(editor.Undo());
  EXPECT_EQ(editor.TheCharacter()->map.Node(HumanoidJoint::kLeftHand), hand);
  EXPECT_TRUE(editor.Unsaved());
  ASSERT_TRUE(editor.Redo());
  ASSERT_TRUE(editor.ClearJointOverride(HumanoidJoint::kLeftHand));
  EXPECT_EQ(editor.TheCharacter()->map.Node(HumanoidJoint::kLeftHand), hand);
}

TEST_F(CalibrationEditorTest, SwappedJointsChangePlaces) {
  CalibrationEditor editor = Editor();
  const HumanoidMap map = editor.TheCharacter()->map;
  ASSERT_GE(map.Node(HumanoidJoint::kSpine), 0);
  const Result<void> swapped =
      editor.SetJointOverride(HumanoidJoint::kSpine, map.Node(HumanoidJoint::kChest));
  ASSERT_TRUE(swapped) << swapped.error();
  const HumanoidMap& now = editor.TheCharacter()->map;
  EXPECT_EQ(now.Node(HumanoidJoint::kSpine), map.Node(HumanoidJoint::kChest));
  EXPECT_EQ(now.Node(HumanoidJoint::kChest), map.Node(HumanoidJoint::kSpine));
  // A map without sense is refused with a sentence, and nothing changes.
  const Result<void> refused = editor.SetJointOverride(HumanoidJoint::kLeftUpperArm,
                                                       map.Node(HumanoidJoint::kRightUpperArm));
  if (!refused) {
    EXPECT_FALSE(refused.error().empty());
    EXPECT_EQ(editor.TheCharacter()->map.Node(HumanoidJoint::kLeftUpperArm),
              map.Node(HumanoidJoint::kLeftUpperArm));
  }
}

TEST_F(CalibrationEditorTest, AFailedSaveLosesNothing) {
  CalibrationEditor editor = Editor();
  ASSERT_TRUE(editor.Pick(kNavelId, NearestTo(editor, {0.0, 1.05, 0.2})));
  ASSERT_TRUE(editor.Save());
  const std::string on_disk = *ReadTextFile(editor.Path());
  ASSERT_TRUE(editor.Pick(kNavelId, NearestTo(editor, {0.0, 1.15, 0.2})));
  const Result<void> failed = editor.SaveAs(folder_ / "no such folder" / "x.json");
  EXPECT_FALSE(failed);
  EXPECT_EQ(failed.error().find('\n'), std::string::npos);
  EXPECT_TRUE(editor.Unsaved());
  EXPECT_EQ(*ReadTextFile(editor.Path()), on_disk);
}

TEST_F(CalibrationEditorTest, ADamagedFileIsPutAsideBeforeItIsReplaced) {
  const fs::path path = folder_ / "person.glb.calib.json";
  std::ofstream(path) << "{ half a fi";
  CalibrationEditor editor = Editor();
  EXPECT_EQ(*ReadTextFile(path), "{ half a fi");
  ASSERT_TRUE(editor.Save());
  EXPECT_EQ(*ReadTextFile(path.string() + ".damaged"), "{ half a fi");
  EXPECT_TRUE(ReadCalibration(path, *editor.TheCharacter()));
}

TEST_F(CalibrationEditorTest, AKilledSessionOffersItsPicksBack) {
  const fs::path recovery = folder_ / "state" / "recovery";
  const fs::path avatar = folder_ / "person.glb";
  CalibrationEditor editor = Editor();
  EXPECT_FALSE(FindRecovery(recovery, avatar));
  ASSERT_TRUE(editor.Pick(kLeftEarId, NearestTo(editor, {0.08, 1.66, 0.02})));
  ASSERT_TRUE(WriteRecovery(recovery, avatar, *editor.TheCharacter(), editor.Calibration()));
  const auto found = FindRecovery(recovery, avatar);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->picked, 2u);
  EXPECT_FALSE(FindRecovery(recovery, folder_ / "other" / "person.glb"));
  ASSERT_EQ(FindRecoveries(recovery).size(), 1u);

  CalibrationEditor next = Editor();
  const auto read = ReadRecovery(*found, *next.TheCharacter());
  ASSERT_TRUE(read) << read.error();
  next.Adopt(read->calibration, "Recover picks");
  EXPECT_EQ(next.Calibration(), editor.Calibration());
  EXPECT_TRUE(next.Unsaved());
  ASSERT_TRUE(next.Undo());
  EXPECT_FALSE(next.Unsaved());

  std::ofstream(found->path) << "cut o";
  EXPECT_FALSE(FindRecovery(recovery, avatar));
  DiscardRecovery(recovery, avatar);
  EXPECT_FALSE(fs::exists(found->path));
  EXPECT_FALSE(WriteRecovery({}, avatar, *editor.TheCharacter(), editor.Calibration()));
}

TEST(PointIds, HaveNamesPlacesAndPartners) {
  for (const PointId id : PickOrder()) {
    EXPECT_EQ(PointNamed(Name(id)), id);
    EXPECT_EQ(Mirror(Mirror(id)), id);
    EXPECT_FALSE(Title(id).empty());
    EXPECT_FALSE(Place(id).empty());
    EXPECT_EQ((Title(id) + Place(id)).find('%'), std::string::npos);
  }
  EXPECT_EQ(Title(kLeftEarId), "Left ear");
  EXPECT_EQ(Mirror(kLeftEarId), kRightEarId);
  const PointId dot = PointId::Of(LimbSegment::kLeftThigh, 3);
  EXPECT_EQ(Name(dot), "leftThigh[3]");
  EXPECT_EQ(PointNamed("leftThigh[3]"), dot);
  EXPECT_FALSE(PointNamed("leftThigh[x]"));
  EXPECT_FALSE(PointNamed("leftThumb"));
}

}  // namespace
}  // namespace ego
