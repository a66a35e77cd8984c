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

#include "assets/takes/bvh.h"
#include "core/body/body.h"

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

}  // namespace
}  // namespace ego
