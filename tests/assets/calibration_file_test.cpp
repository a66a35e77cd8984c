// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_file.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assets/calibration/propose_calibration.h"
#include "assets/files/file_io.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

class CalibrationFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("ego_calibration_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    character_.source_path = (folder_ / "person.glb").string();
    calibration_ = *ProposeCalibration(character_);
    calibration_.At(SamplePoint::kNavel).state = PickState::kPicked;
    calibration_.At(SamplePoint::kNoseTip) = {};
    calibration_.At(SamplePoint::kNoseTip).reason = "cut off \"here\"";
  }
  void TearDown() override { fs::remove_all(folder_); }

  nlohmann::json Json() const {
    return nlohmann::json::parse(FormatCalibration(character_, calibration_));
  }
  std::string ErrorOf(const nlohmann::json& json) const {
    return ParseCalibration(json.dump(), "a.calib.json", character_).error();
  }

  fs::path folder_;
  Character character_ = test::MakeCapsulePerson();
  AvatarCalibration calibration_;
};

void ExpectSame(AvatarCalibration a, AvatarCalibration b) {
  EXPECT_EQ(a.mesh_hash, b.mesh_hash);
  const auto left = AllPoints(a);
  const auto right = AllPoints(b);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i].point->state, right[i].point->state) << left[i].name;
    EXPECT_EQ(left[i].point->confidence, right[i].point->confidence) << left[i].name;
    EXPECT_EQ(left[i].point->reason, right[i].point->reason) << left[i].name;
    if (left[i].point->state != PickState::kMissing) {
      EXPECT_EQ(left[i].point->place, right[i].point->place) << left[i].name;
    }
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    EXPECT_EQ(a.segment[s].radius, b.segment[s].radius);
    EXPECT_EQ(a.segment[s].state, b.segment[s].state);
    EXPECT_EQ(a.segment[s].confidence, b.segment[s].confidence);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_EQ(a.hand[side].half_thickness, b.hand[side].half_thickness);
  }
}

TEST_F(CalibrationFileTest, ComesBackBitForBit) {
  const fs::path path = CalibrationPathFor(character_.source_path);
  EXPECT_EQ(path.filename(), "person.glb.calib.json");
  ASSERT_TRUE(WriteCalibration(path, character_, calibration_));
  const auto read = ReadCalibration(path, character_);
  ASSERT_TRUE(read) << read.error();
  EXPECT_TRUE(read->from_file);
  EXPECT_TRUE(read->warnings.empty());
  ExpectSame(read->calibration, calibration_);
}

TEST_F(CalibrationFileTest, TheFileBesideTheAvatarWinsOverAProposal) {
  const auto proposed = LoadOrProposeCalibration(character_);
  ASSERT_TRUE(proposed) << proposed.error();
  EXPECT_FALSE(proposed->from_file);
  EXPECT_TRUE(fs::is_empty(folder_)) << "nothing may be written unasked";
  ASSERT_TRUE(
      WriteCalibration(CalibrationPathFor(character_.source_path), character_, calibration_));
  const auto loaded = LoadOrProposeCalibration(character_);
  ASSERT_TRUE(loaded) << loaded.error();
  EXPECT_TRUE(loaded->from_file);
  EXPECT_EQ(loaded->calibration.At(SamplePoint::kNavel).state, PickState::kPicked);
}

TEST_F(CalibrationFileTest, ABrokenFileIsReportedAndLeftAlone) {
  const fs::path path = CalibrationPathFor(character_.source_path);
  std::ofstream(path) << "{ \"format\": ";
  const auto loaded = LoadOrProposeCalibration(character_);
  ASSERT_TRUE(loaded) << loaded.error();
  EXPECT_FALSE(loaded->from_file);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_NE(loaded->warnings[0].find(path.string()), std::string::npos);
  EXPECT_EQ(*ReadTextFile(path), "{ \"format\": ");
}

TEST_F(CalibrationFileTest, PointsAreCarriedOverToAChangedMesh) {
  const std::string text = FormatCalibration(character_, calibration_);
  Character changed = character_;
  // Other triangle numbers, the same skin.
  auto& index = changed.parts[0].triangles;
  std::rotate(index.begin(), index.begin() + 3000, index.end());
  auto read = ParseCalibration(text, "a.calib.json", changed);
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->warnings.size(), 1u);
  EXPECT_NE(read->warnings[0].find("changed"), std::string::npos);
  EXPECT_EQ(read->calibration.mesh_hash, MeshHash(changed));
  const PosedMesh before = CanonicalMesh(character_);
  const PosedMesh after = CanonicalMesh(changed);
  auto old_points = AllPoints(calibration_);
  auto new_points = AllPoints(read->calibration);
  for (std::size_t i = 0; i < old_points.size(); ++i) {
    EXPECT_EQ(old_points[i].point->state, new_points[i].point->state);
    if (old_points[i].point->state == PickState::kMissing) continue;
    EXPECT_LT(glm::distance(Position(character_, before, old_points[i].point->place),
                            Position(changed, after, new_points[i].point->place)),
              1e-9)
        << old_points[i].name;
  }
  // A mesh from which the head was moved away: its points become doubtful, the rest do not.
  Character headless = character_;
  for (std::size_t v = 0; v < headless.parts[0].positions.size(); ++v) {
    if (JointShares(headless, headless.parts[0], v)[Index(HumanoidJoint::kHead)] > 0.5) {
      headless.parts[0].positions[v] *= 0.5f;
    }
  }
  read = ParseCalibration(text, "a.calib.json", headless);
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->calibration.At(SamplePoint::kForehead).state, PickState::kDoubtful);
  EXPECT_EQ(read->calibration.At(SamplePoint::kMidBack).state, PickState::kProposed);
}

TEST_F(CalibrationFileTest, ErrorsNameTheFileAndTheObject) {
  struct Case {
    const char* pointer;
    nlohmann::json value;
    const char* named;
  };
  const std::vector<Case> cases = {
      {"/format", "something else", "format"},
      {"/version", 3, "version"},
      {"/meshHash", 12, "meshHash"},
      {"/samples/navel/part", 9, "samples.navel.part"},
      {"/samples/navel/part", "zero", "samples.navel.part"},
      {"/samples/navel/triangle", -1, "samples.navel.triangle"},
      {"/samples/navel/triangle", 99999999999, "samples.navel.triangle"},
      {"/samples/navel/barycentric", {0.5, 0.6, 0.2}, "samples.navel.barycentric"},
      {"/samples/navel/barycentric", {0.5, 0.5}, "samples.navel.barycentric"},
      {"/samples/navel/position", {0, nullptr, 1}, "samples.navel.position"},
      {"/samples/navel/state", "sure", "samples.navel.state"},
      {"/samples/navel/confidence", 1.5, "samples.navel.confidence"},
      {"/samples/navel", 3, "samples.navel"},
      {"/segments/leftThigh/radius", -1.0, "segments.leftThigh.radius"},
      {"/segments/leftThigh/dots", nullptr, "segments.leftThigh.dots"},
      {"/segments/leftThigh/dots/3/part", 7, "segments.leftThigh.dots[3].part"},
      {"/leftHand/palm/reason", 1, "leftHand.palm.reason"},
      {"/rightFoot/heel", nullptr, "rightFoot.heel"},
  };
  for (const Case& c : cases) {
    nlohmann::json json = Json();
    json[nlohmann::json::json_pointer(c.pointer)] = c.value;
    const std::string error = ErrorOf(json);
    EXPECT_EQ(error.rfind("a.calib.json: ", 0), 0u) << c.pointer << ": " << error;
    EXPECT_NE(error.find(c.named), std::string::npos) << c.pointer << ": " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  for (const char* key : {"samples", "segments", "leftHand", "rightFoot", "format"}) {
    nlohmann::json json = Json();
    json.erase(key);
    EXPECT_NE(ErrorOf(json).find(key), std::string::npos) << key;
  }
  EXPECT_FALSE(ParseCalibration("", "a", character_));
  EXPECT_FALSE(ParseCalibration("[1,2]", "a", character_));
  EXPECT_FALSE(ParseCalibration(std::string(200000, '['), "a", character_));
}

TEST_F(CalibrationFileTest, AFolderThatCannotBeWrittenLosesNothing) {
  const fs::path path = folder_ / "no such folder" / "x.calib.json";
  const auto written = WriteCalibration(path, character_, calibration_);
  EXPECT_FALSE(written);
  EXPECT_NE(written.error().find("x.calib.json"), std::string::npos);
}

}  // namespace
}  // namespace ego
