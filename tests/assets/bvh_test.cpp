// SPDX-License-Identifier: MIT
#include "assets/takes/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace ego {
namespace {

/// Positions of all joints in one frame, by the textbook: matrices down the tree.
std::vector<Vec3> Positions(const JointMotion& motion, std::size_t frame) {
  const std::size_t n = motion.tree.joints.size();
  std::vector<Mat4> global(n);
  std::vector<Vec3> position(n);
  for (std::size_t j = 0; j < n; ++j) {
    const int parent = motion.tree.joints[j].parent;
    const Mat4 local = glm::translate(Mat4{1.0}, motion.translation_ls[frame * n + j]) *
                       glm::mat4_cast(motion.rotation_ls[frame * n + j]);
    global[j] = parent < 0 ? local : global[static_cast<std::size_t>(parent)] * local;
    position[j] = Vec3(global[j][3]);
  }
  return position;
}

const std::string kSmall =
    "HIERARCHY\nROOT Hips\n{\n  OFFSET 1 2 3\n"
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "  JOINT Left Leg\n  {\n    OFFSET 0 -2 0\n    CHANNELS 3 Yrotation Zrotation Xrotation\n"
    "    End Site\n    {\n      OFFSET 0 -1 0\n    }\n  }\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.00833333\n";
const std::string kNumbers = "10 20 30 0 0 0 0 90 0\n10 20 30 90 0 0 0 0 90\n";

TEST(Bvh, AppliesChannelsInTheirOrder) {
  const Result<JointMotion> motion = ParseBvh(kSmall + kNumbers, "a/walk.bvh");
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_EQ(motion->name, "walk");
  EXPECT_EQ(motion->frame_count, 2u);
  EXPECT_DOUBLE_EQ(motion->rate_hz, 120.0);
  ASSERT_EQ(motion->tree.joints.size(), 3u);
  EXPECT_EQ(motion->tree.joints[1].name, "Left Leg");
  EXPECT_EQ(motion->tree.joints[2].name, "Left Leg_end");
  EXPECT_EQ(Vec3(motion->tree.joints[0].rest_local[3]), Vec3(1, 2, 3));
  // Frame 1: the root's position replaces its offset; the leg turns 90 degrees about Z.
  std::vector<Vec3> p = Positions(*motion, 0);
  EXPECT_LT(glm::length(p[1] - Vec3(10, 18, 30)), 1e-12);
  EXPECT_LT(glm::length(p[2] - Vec3(11, 18, 30)), 1e-12);
  // Frame 2: the root turns about Z; the leg's X rotation is about the turned X axis.
  p = Positions(*motion, 1);
  EXPECT_LT(glm::length(p[1] - Vec3(12, 20, 30)), 1e-12);
  EXPECT_LT(glm::length(p[2] - Vec3(12, 20, 29)), 1e-12);
}

TEST(Bvh, MatchesMatricesForAnyChannelsOnAnyJoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-400.0, 400.0);
  const std::array<std::string, 6> names = {"Xposition", "Yposition", "Zposition",
                                            "Xrotation", "Yrotation", "Zrotation"};
  for (int round = 0; round < 50; ++round) {
    std::array<int, 6> order = {0, 1, 2, 3, 4, 5};
    std::shuffle(order.begin(), order.end(), random);
    const int count = 1 + round % 6;
    std::string text =
        "HIERARCHY ROOT a { OFFSET 1 1 1 CHANNELS 0 JOINT b { OFFSET 1 2 3 CHANNELS " +
        std::to_string(count);
    for (int k = 0; k < count; ++k)
      text += " " + names[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])];
    text += " End Site { OFFSET 0 0 2 } } } MOTION Frames: 3 Frame Time: 0.04\n";
    std::vector<Vec3> expected;
    for (int f = 0; f < 3; ++f) {
      Vec3 offset{1, 2, 3};
      Mat4 turn{1.0};
      for (int k = 0; k < count; ++k) {
        const int channel = order[static_cast<std::size_t>(k)];
        const double value = std::round(angle(random) * 1000.0) / 1000.0;
        text += std::to_string(value) + " ";
        Vec3 axis{0.0};
        axis[channel % 3] = 1.0;
        if (channel < 3) {
          offset[channel] = value;
        } else {
          turn = turn * glm::rotate(Mat4{1.0}, Radians(value), axis);
        }
      }
      expected.push_back(Vec3{1.0} + offset + Vec3(turn * Vec4(0, 0, 2, 0)));
    }
    const Result<JointMotion> motion = ParseBvh(text, "a.bvh");
    ASSERT_TRUE(motion) << motion.error();
    for (std::size_t f = 0; f < 3; ++f) {
      EXPECT_LT(glm::length(Positions(*motion, f)[2] - expected[f]), 1e-9) << text;
    }
  }
}

TEST(Bvh, KeepsQuaternionSignsThroughEulerJumps) {
  std::string text =
      "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 3 Zrotation Xrotation Yrotation } MOTION "
      "Frames: 721 Frame Time: 0.01\n";
  // The same slow turn, written with jumps of whole turns and through the 180 degree seam.
  for (int f = 0; f <= 720; ++f) {
    const int wrapped = (f + 180) % 360 - 180 + 360 * (f % 3);
    text += std::to_string(wrapped) + " 0 0\n";
  }
  const Result<JointMotion> motion = ParseBvh(text, "a.bvh");
  ASSERT_TRUE(motion) << motion.error();
  for (std::size_t f = 1; f < motion->frame_count; ++f) {
    EXPECT_NEAR(glm::dot(motion->rotation_ls[f], motion->rotation_ls[f - 1]),
                std::cos(Radians(0.5)), 1e-9);
  }
}

TEST(Bvh, ReadsAnyCaseAndSpacing) {
  const Result<JointMotion> motion = ParseBvh(
      "\xEF\xBB\xBFhierarchy\r\nRoot a{offset 0 0 0 channels 1 xROTATION\r\n"
      "joint b{OFFSET 0 +1 0 CHANNELS 2 Xscale Yposition End Site{OFFSET 1 0 0}}}\r\n"
      "ROOT second { OFFSET 1 2 3 CHANNELS 0 }\r\nMotion\r\nFRAMES:\t1\r\nframe "
      "time:\t0.0333667\r\n"
      "1\t2\r\n3 99\r\n",
      "a.bvh");
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_EQ(motion->tree.joints.size(), 4u);
  EXPECT_EQ(motion->tree.joints[3].parent, -1);
  EXPECT_NEAR(motion->rate_hz, 30000.0 / 1001.0, 1e-9);
  EXPECT_EQ(motion->translation_ls[1], Vec3(0, 3, 0));
  EXPECT_EQ(motion->warnings.size(), 2u);  // scale left out, one number too many
}

TEST(Bvh, RefusesBadFilesWithOneSentence) {
  const auto sentence = [](const std::string& text) {
    const Result<JointMotion> motion = ParseBvh(text, "bad.bvh");
    return motion ? std::string("was read") : motion.error();
  };
  EXPECT_EQ(sentence(""), "bad.bvh: is not a BVH file: it does not begin with HIERARCHY");
  EXPECT_EQ(sentence(kSmall + "10 20 30 0 0 nan 0 90 0\n10 20 30 90 0 0 0 0 90\n"),
            "bad.bvh: frame 1, joint \"Hips\": \"nan\" stands where a number is expected");
  EXPECT_EQ(sentence(kSmall + "10.25 20.25 30.25 0 0 0 0 90 0\n10 20 30 90"),
            "bad.bvh: is cut off: it ends in frame 2 of 2");
  EXPECT_EQ(sentence(kSmall + "10 20 30 0 0 0 0 90 0\n10 20 30 90 0 0 0 0 9e30\n"),
            "bad.bvh: frame 2, joint \"Left Leg\": \"9e30\" stands where a number is expected");
  const auto with_frames = [&](const std::string& count) {
    std::string text = kSmall + kNumbers;
    return text.replace(text.find("Frames: 2") + 8, 1, count);
  };
  EXPECT_EQ(sentence(with_frames("2000000000")),
            "bad.bvh: is cut off: it is too short for the 2000000000 frames that it declares");
  for (const char* count : {"-1", "0", "1.5", "1e400", "nan", "many"}) {
    EXPECT_NE(sentence(with_frames(count)), "was read") << count;
  }
  // Many joints without channels must not multiply into memory.
  std::string wide = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 1 Xrotation";
  for (int i = 0; i < 5000; ++i) wide += " JOINT b { OFFSET 0 0 0 }";
  wide += " } MOTION Frames: 100000 Frame Time: 0.01\n";
  for (int i = 0; i < 100000; ++i) wide += "1 ";
  EXPECT_NE(sentence(wide).find("most of them without channels"), std::string::npos);
  std::string deep = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 0";
  for (int i = 0; i < 100000; ++i) deep += " JOINT b { OFFSET 0 0 0";
  EXPECT_NE(sentence(deep).find("nested deeper"), std::string::npos);
  EXPECT_NE(sentence("HIERARCHY JOINT a { }").find("wrong level"), std::string::npos);
  EXPECT_NE(sentence("HIERARCHY ROOT a { CHANNELS 99999999999 }").find("channels"),
            std::string::npos);
  EXPECT_NE(sentence("HIERARCHY ROOT a { CHANNELS 1 Wrotation }").find("Xrotation"),
            std::string::npos);
}

TEST(Bvh, RefusesEveryTruncation) {
  const std::string whole = kSmall + kNumbers;
  // The last number may lose digits without anyone knowing.
  for (std::size_t size = 0; size + 3 < whole.size(); ++size) {
    const Result<JointMotion> motion = ParseBvh(std::string_view(whole).substr(0, size), "cut.bvh");
    ASSERT_FALSE(motion) << size;
    EXPECT_TRUE(motion.error().starts_with("cut.bvh: ")) << motion.error();
  }
}

TEST(Bvh, WrittenMotionsReadBackToTheSameJointPositions) {
  const Body body = TemplateBody(1.83);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Pose> poses(120);
  for (std::size_t f = 0; f < poses.size(); ++f) {
    poses[f].root_ws = {normal(random), 1.0 + normal(random), normal(random)};
    for (std::size_t j = 0; j < kJointCount; ++j) {
      Quat q{normal(random), normal(random), normal(random), normal(random)};
      // Every third pose sits in the singularity of the written angles.
      if (f % 3 == 1) {
        q = glm::angleAxis(normal(random), Vec3(0, 0, 1)) *
            glm::angleAxis(f % 2 == 0 ? 0.5 * kPi : -0.5 * kPi, Vec3(1, 0, 0)) *
            glm::angleAxis(normal(random), Vec3(0, 1, 0));
      }
      poses[f].rotation_ls[j] = glm::normalize(q);
    }
  }
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "round_trip.bvh";
  const Result<void> written = WriteBvh(path, body, poses, 119.88);
  ASSERT_TRUE(written) << written.error();
  const Result<JointMotion> motion = ReadBvh(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_NEAR(motion->rate_hz, 119.88, 1e-3);
  ASSERT_EQ(motion->frame_count, poses.size());
  std::size_t compared = 0;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    const ModelPose pose = ForwardKinematics(body.skeleton, poses[f]);
    const std::vector<Vec3> read = Positions(*motion, f);
    for (std::size_t j = 0; j < read.size(); ++j) {
      const std::optional<HumanoidJoint> joint = JointNamed(motion->tree.joints[j].name);
      if (!joint) continue;
      ++compared;
      EXPECT_LT(glm::length(read[j] / 100.0 - pose.Position(*joint)), 1e-6);
    }
  }
  EXPECT_EQ(compared, poses.size() * kJointCount);
}

TEST(Bvh, WrittenAnglesHaveNoJumps) {
  const Body body = TemplateBody();
  std::vector<Pose> poses(400, CanonicalPose(body.skeleton));
  for (std::size_t f = 0; f < poses.size(); ++f) {
    // Two slow turns of the hips and a wave of the arm through the singular angle.
    const double t = static_cast<double>(f) / 100.0;
    poses[f].rotation_ls[Index(HumanoidJoint::kHips)] = glm::angleAxis(kPi * t, kUp);
    poses[f].rotation_ls[Index(HumanoidJoint::kLeftUpperArm)] =
        glm::angleAxis(1.8 * std::sin(t), Vec3(1, 0, 0)) * glm::angleAxis(0.3 * t, kUp);
  }
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "smooth.bvh";
  ASSERT_TRUE(WriteBvh(path, body, poses, 100.0));
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line) && !line.starts_with("Frame Time")) {
  }
  std::vector<double> before;
  double largest = 0.0;
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double x = 0.0; numbers >> x;) row.push_back(x);
    ASSERT_EQ(row.size(), 3u + 3u * kJointCount);
    for (std::size_t i = 3; i < row.size() && !before.empty(); ++i) {
      largest = std::max(largest, std::abs(row[i] - before[i]));
    }
    before = row;
  }
  std::filesystem::remove(path);
  ASSERT_EQ(before.size(), 3u + 3u * kJointCount);
  EXPECT_LT(largest, 20.0);
}

}  // namespace
}  // namespace ego
