// SPDX-License-Identifier: MIT
#include <filesystem>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "assets/calibration/calibration_file.h"
#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"
#include "assets/motions/motion_script_file.h"
#include "assets/people/person_file.h"
#include "assets/takes/bvh.h"
#include "assets/takes/c3d.h"
#include "assets/takes/trc.h"
#include "core/pipeline/skeleton_capture.h"
#include "tests/support/capsule_person.h"
#include "tests/support/character_laws.h"
#include "tests/support/script_laws.h"
#include "tests/support/take_laws.h"

namespace ego {
namespace {

/// Gives every file of a kept corpus to a reader; returns how many there were.
std::size_t Replay(const std::string& corpus,
                   const std::function<void(std::span<const std::uint8_t>)>& read) {
  const auto folder = std::filesystem::path(EGO_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / corpus;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Result<std::vector<std::uint8_t>> bytes = ReadFile(entry.path());
    EXPECT_TRUE(bytes) << bytes.error();
    read(*bytes);
    ++count;
  }
  return count;
}

std::string_view Text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(FuzzCorpus, HoldsTheLawsOfC3d) {
  EXPECT_GE(Replay("c3d", [](auto bytes) { test::CheckTake(ParseC3d(bytes, "x.c3d"), "x.c3d"); }),
            6u);
}

TEST(FuzzCorpus, HoldsTheLawsOfTrc) {
  EXPECT_GE(
      Replay("trc", [](auto bytes) { test::CheckTake(ParseTrc(Text(bytes), "x.trc"), "x.trc"); }),
      4u);
}

TEST(FuzzCorpus, HoldsTheLawsOfBvh) {
  const auto read = [](auto bytes) {
    const Result<JointMotion> motion = ParseBvh(Text(bytes), "x.bvh");
    test::CheckMotion(motion, "x.bvh");
    if (motion) test::CheckCapture(CaptureFromJointMotion(*motion), *motion);
  };
  EXPECT_GE(Replay("bvh", read), 4u);
}

TEST(FuzzCorpus, HoldsTheLawsOfGltf) {
  const auto read = [](auto bytes) {
    test::CheckCharacter(ParseCharacter(bytes, "x.glb"), "x.glb");
  };
  EXPECT_GE(Replay("gltf", read), 10u);
}

TEST(FuzzCorpus, HoldsTheLawsOfCalibrations) {
  const Character person = test::MakeCapsulePerson();
  const auto read = [&](auto bytes) {
    // Files of every version that ever was, none of them made on this character.
    const auto loaded = ParseCalibration(Text(bytes), "x.calib.json", person);
    ASSERT_TRUE(loaded) << loaded.error();
    EXPECT_FALSE(loaded->warnings.empty());
    const auto again =
        ParseCalibration(FormatCalibration(person, loaded->calibration), "x.calib.json", person);
    ASSERT_TRUE(again) << again.error();
    EXPECT_EQ(again->calibration, loaded->calibration);
  };
  EXPECT_GE(Replay("calibration", read), 4u);
}

TEST(FuzzCorpus, HoldsTheLawsOfMotionScripts) {
  const auto read = [](auto bytes) {
    test::CheckScript(ParseMotionScript(Text(bytes), "x.json"), "x.json");
  };
  EXPECT_GE(Replay("motion_script", read), 4u);
}

TEST(FuzzCorpus, HoldsTheLawsOfPeople) {
  const auto read = [](auto bytes) {
    test::CheckPeople(ParsePeople(Text(bytes), "x.json"), "x.json");
  };
  EXPECT_GE(Replay("people", read), 4u);
}

}  // namespace
}  // namespace ego
