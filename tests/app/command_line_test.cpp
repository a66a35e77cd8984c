// SPDX-License-Identifier: MIT
// The program as a user meets it: exit codes, one sentence on stderr, files written whole or not.
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "assets/gltf/character_file.h"
#include "assets/takes/bvh.h"
#include "core/body/body.h"
#include "tests/support/capsule_person.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

std::string TextOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("ego-command-line-") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs the program without a display.
  Outcome Run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && env -u DISPLAY -u WAYLAND_DISPLAY '" EGO_BINARY_DIR
                                "/egostudio' " +
                                arguments + " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, TextOf(folder_ / "out.txt"),
            TextOf(folder_ / "err.txt")};
  }

  void ExpectOneSentence(const std::string& arguments, int code, const std::string& about) const {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << arguments << "\n"
                                                                           << outcome.err;
    EXPECT_NE(outcome.err.find(about), std::string::npos) << arguments << "\n" << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  fs::path folder_;
};

TEST_F(CommandLine, HelpTellsEveryVerbAndSucceeds) {
  const Outcome help = Run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* verb : {"retarget", "solve", "render"}) {
    EXPECT_NE(help.out.find(verb), std::string::npos) << verb;
    const Outcome own = Run(std::string(verb) + " --help");
    EXPECT_EQ(own.code, 0);
    EXPECT_NE(own.out.find("--out"), std::string::npos);
    EXPECT_NE(own.out.find("Example"), std::string::npos);
  }
}

TEST_F(CommandLine, WrongArgumentsGiveTwo) {
  ExpectOneSentence("solve", 2, "--take");
  ExpectOneSentence("solve --take", 2, "--take");
  ExpectOneSentence("render --out x.png --view below", 2, "--view");
  ExpectOneSentence("retarget --out x --method guess", 2, "--method");
  ExpectOneSentence("render --out x.png --nonsense", 2, "--nonsense");
}

TEST_F(CommandLine, BadFilesGiveOneSentenceThatNamesThem) {
  Write("empty.c3d", "");
  Write("words.bvh", "this is no motion\n");
  Write("words.glb", "this is no avatar\n");
  Write("words.trc", "neither\nis\nthis\n");
  ExpectOneSentence("solve --take absent.c3d --out s.bvh", 1, "absent.c3d");
  ExpectOneSentence("solve --take empty.c3d --out s.bvh", 1, "empty.c3d");
  ExpectOneSentence("solve --take words.bvh --out s.bvh", 1, "words.bvh");
  ExpectOneSentence("solve --take words.trc --out s.bvh", 1, "words.trc");
  ExpectOneSentence("solve --take words.glb --out s.bvh", 1, "words.glb");
  ExpectOneSentence("solve --take picture.jpg --out s.bvh", 1, "picture.jpg");
  ExpectOneSentence("retarget --avatar words.glb --take words.bvh --out r", 1, "words.glb");
  ExpectOneSentence("retarget --avatar absent.glb --out r", 1, "absent.glb");
  ExpectOneSentence("retarget --avatar words.bvh --out r", 1, "words.bvh");
  EXPECT_FALSE(fs::exists(folder_ / "s.bvh"));
}

TEST_F(CommandLine, PicturesOfImpossibleKindOrSizeAreRefused) {
  ExpectOneSentence("render --out x.jpg", 1, "x.jpg");
  ExpectOneSentence("render --out x.png --size 12", 1, "--size");
  ExpectOneSentence("render --out x.png --size 0x100", 1, "--size");
  ExpectOneSentence("render --out x.png --size 99999999999x2", 1, "--size");
  ExpectOneSentence("render --out x.mp4 --strip 3", 1, "--strip");
  ExpectOneSentence("render --out x.mp4 --size 101x100", 1, "even");
}

TEST_F(CommandLine, WithoutADisplayTheWindowSaysSo) { ExpectOneSentence("", 1, "display"); }

TEST_F(CommandLine, AFolderThatCannotBeMadeIsNamed) {
  Write("file", "");
  ExpectOneSentence("retarget --out file/below", 1, "file/below");
}

TEST_F(CommandLine, ASkeletonTakeComesBackAsTheSkeletonItIs) {
  const Body body = TemplateBody(1.7);
  std::vector<Pose> poses(30, CanonicalPose(body.skeleton));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].rotation_ls[Index(HumanoidJoint::kLeftLowerArm)] =
        glm::angleAxis(0.04 * static_cast<double>(i), Vec3{0, -1, 0});
  }
  ASSERT_TRUE(WriteBvh(folder_ / "take.bvh", body, poses, 60.0));
  const Outcome outcome = Run("solve --take take.bvh --out solved.bvh --report report.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("30 frames"), std::string::npos) << outcome.out;
  const std::string report = TextOf(folder_ / "report.json");
  EXPECT_NE(report.find("\"frames\": 30"), std::string::npos) << report;
  EXPECT_NE(report.find("\"leftForearm\""), std::string::npos) << report;
  const Result<JointMotion> solved = ReadBvh(folder_ / "solved.bvh");
  ASSERT_TRUE(solved) << solved.error();
  EXPECT_EQ(solved->frame_count, 30u);
}

TEST_F(CommandLine, CalibrateTellsByItsExitCodeWhetherAPersonShouldLook) {
  const fs::path avatar = folder_ / "person.glb";
  ASSERT_TRUE(WriteCharacter(avatar, test::MakeCapsulePerson()));
  const Outcome first =
      Run("calibrate --avatar person.glb --out person.glb.calib.json --report r.json");
  EXPECT_TRUE(first.code == 0 || first.code == 3) << first.err;
  EXPECT_NE(first.out.find("person.glb.calib.json: "), std::string::npos) << first.out;
  EXPECT_EQ(first.code == 3, first.out.find("a person should look") != std::string::npos);
  const std::string report = TextOf(folder_ / "r.json");
  for (const char* key : {"aPersonShouldLook", "findings", "points", "testPostures"}) {
    EXPECT_NE(report.find(key), std::string::npos) << key;
  }
  // A calibration that is plainly wrong: the navel on a foot.
  std::string text = TextOf(folder_ / "person.glb.calib.json");
  const auto entry = [&](const std::string& key) {
    const std::size_t at = text.find("{", text.find("\"" + key + "\""));
    return std::pair(at, text.find("}", at) + 1 - at);
  };
  const auto [heel, heel_size] = entry("heel");
  const std::string on_the_foot = text.substr(heel, heel_size);
  const auto [navel, navel_size] = entry("navel");
  text.replace(navel, navel_size, on_the_foot);
  std::ofstream(folder_ / "wrong.json") << text;
  const Outcome wrong = Run("calibrate --check --avatar person.glb --out wrong.json");
  EXPECT_EQ(wrong.code, 3) << wrong.err;
  EXPECT_NE(wrong.out.find("Navel"), std::string::npos) << wrong.out;
  EXPECT_EQ(TextOf(folder_ / "wrong.json"), text) << "--check writes nothing";

  ExpectOneSentence("calibrate --avatar no.glb --out x.json", 1, "no.glb");
  ExpectOneSentence("calibrate --avatar person.glb --out none/x.json", 1, "x.json");
  ExpectOneSentence("calibrate --avatar person.glb", 2, "--out");
  ExpectOneSentence("calibrate --out x.json", 2, "--avatar");
  // What a person worked on is not replaced unasked.
  text = TextOf(folder_ / "person.glb.calib.json");
  text.replace(text.find("\"proposed\""), 10, "\"picked\"");
  std::ofstream(folder_ / "person.glb.calib.json") << text;
  const std::string again = "calibrate --avatar person.glb --out person.glb.calib.json";
  ExpectOneSentence(again, 1, "--force");
  EXPECT_EQ(TextOf(folder_ / "person.glb.calib.json"), text);
  EXPECT_NE(Run(again + " --force").code, 1);
}

}  // namespace
}  // namespace ego
