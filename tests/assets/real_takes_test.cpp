// SPDX-License-Identifier: MIT
// Takes of real people that may lie beside the project: what the index there says of each file
// (counted by other programs) must be what the readers find.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/files/file_io.h"
#include "assets/takes/bvh.h"
#include "assets/takes/c3d.h"
#include "assets/takes/trc.h"
#include "core/markers/up_axis.h"
#include "core/pipeline/skeleton_capture.h"
#include "tests/support/shared_data.h"
#include "tests/support/take_laws.h"

namespace ego {
namespace {

struct Entry {
  const char* file;
  std::size_t points;  // markers and model outputs
  std::size_t most_markers;
  std::size_t frames;
  double rate_hz;
  double gap_per_cent;  // of the markers that are ever seen
};

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.file; }

constexpr Entry kEntries[] = {
    {"cmu_01_01.c3d", 42, 42, 2751, 120.0, 2.4},
    {"cmu_02_05.c3d", 41, 41, 1854, 120.0, 0.0},
    {"cmu_06_dribble_shoot.c3d", 41, 41, 494, 120.0, 0.0},
    {"cmu_135_02_karate.c3d", 41, 41, 5202, 120.0, 0.0},
    {"hdm05_mm_01-02_03.c3d", 44, 44, 3990, 120.0, 0.0},
    {"pycgm_subjB_ROM_static.c3d", 141, 39, 275, 100.0, 0.0},
    {"pycgm_robo_static.c3d", 137, 35, 560, 240.0, 0.0},
    {"btk_mocap36_optitrack.c3d", 36, 36, 1380, 100.0, 16.6},
    {"c3dorg_nexgen_test1.c3d", 40, 40, 721, 128.0, 0.0},
    {"c3dorg_mac_jump2.c3d", 51, 51, 264, 120.0, 0.0},
    {"ezc3d_qualisys_walk.c3d", 55, 55, 340, 200.0, 0.0},
    {"biomechzoo_HC030A_static.c3d", 311, 90, 300, 100.0, 0.0},
    {"biomechzoo_HC030A_straight.c3d", 291, 90, 197, 100.0, 0.0},
    {"gatech_nick_freeform.c3d", 53, 53, 1101, 120.0, 4.8},
    {"gatech_sehoon_squat.c3d", 53, 53, 2539, 120.0, 1.7},
    {"rajagopal_static_walk_1.trc", 64, 47, 287, 100.0, 0.0},
    {"rajagopal_motion_capture_walk.trc", 41, 41, 238, 100.0, 0.0},
    {"millard_neu_t169_f250f350.c3d", 38, 37, 101, 50.0, 0.0},
    {"millard_stoop1_t169_f620f800.c3d", 38, 37, 181, 50.0, 0.0},
    {"millard_stoop2_t169_f1395f1590.c3d", 38, 37, 196, 50.0, 0.0},
    {"millard_stoop3_t169_f2101f2300.c3d", 38, 37, 200, 50.0, 0.0},
};

class RealTake : public testing::TestWithParam<Entry> {};

/// Highest middle height that any upper-body marker keeps, and the lowest that a foot marker does.
double MedianHeight(const MarkerTake& take, const std::vector<std::string>& parts, bool highest) {
  double best = highest ? -1e9 : 1e9;
  const std::size_t n = take.labels.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string label = PlainLabel(take.labels[i]);
    const bool wanted = std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
      return label.find(part) != std::string::npos;
    });
    if (!wanted) continue;
    std::vector<double> heights;
    for (std::size_t f = 0; f < take.frame_count; ++f) {
      if (take.visible[f * n + i] != 0) heights.push_back(take.position_ws[f * n + i].y);
    }
    if (heights.empty()) continue;
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    best = highest ? std::max(best, *middle) : std::min(best, *middle);
  }
  return best;
}

TEST_P(RealTake, IsReadAsItsIndexSays) {
  const Entry& entry = GetParam();
  EGO_SHARED_DATA_OR_SKIP(path, std::string("markers/") + entry.file);
  const Result<MarkerTake> take = path.extension() == ".trc" ? ReadTrc(path) : ReadC3d(path);
  ASSERT_TRUE(take) << take.error();
  test::CheckTake(take, path.string());
  EXPECT_EQ(take->labels.size() + take->ignored.size(), entry.points);
  EXPECT_LE(take->labels.size(), entry.most_markers);
  EXPECT_GE(take->labels.size(), 30u);
  EXPECT_EQ(take->frame_count, entry.frames);
  EXPECT_DOUBLE_EQ(take->rate_hz, entry.rate_hz);

  const std::size_t n = take->labels.size();
  std::size_t gaps = 0;
  std::size_t places = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t seen = 0;
    for (std::size_t f = 0; f < take->frame_count; ++f) seen += take->visible[f * n + i];
    if (seen == 0) continue;
    gaps += take->frame_count - seen;
    places += take->frame_count;
  }
  EXPECT_NEAR(100.0 * static_cast<double>(gaps) / static_cast<double>(places), entry.gap_per_cent,
              0.06);

  // A person stands, walks or bends on a floor near zero: units and up axis are right.
  const double shoulders = MedianHeight(*take, {"SHO", "FSH", "SAJ", "C7", "SHOULDER"}, true);
  const double feet = MedianHeight(*take, {"HEE", "HEL", "TOE", "ANK", "FOOT", "FCC"}, false);
  EXPECT_GT(shoulders - feet, 0.95);
  EXPECT_LT(shoulders - feet, 1.65);
  EXPECT_NEAR(feet, 0.05, 0.10);
}

INSTANTIATE_TEST_SUITE_P(Markers, RealTake, testing::ValuesIn(kEntries));

TEST(RealTakes, CutShortGiveOneSentence) {
  EGO_SHARED_DATA_OR_SKIP(path, "markers/millard_neu_t169_f250f350.c3d");
  const Result<std::vector<std::uint8_t>> bytes = ReadFile(path);
  ASSERT_TRUE(bytes);
  for (std::size_t size = 0; size + 512 < bytes->size(); size += 64) {
    const Result<MarkerTake> take = ParseC3d(std::span(*bytes).first(size), "cut.c3d");
    EXPECT_FALSE(take) << size;
    test::CheckTake(take, "cut.c3d");
  }
}

class RealMotion : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(RealMotion, IsReadAsItsIndexSays) {
  const auto& [file, frames] = GetParam();
  EGO_SHARED_DATA_OR_SKIP(path, std::string("bvh/") + file);
  const Result<JointMotion> motion = ReadBvh(path);
  ASSERT_TRUE(motion) << motion.error();
  test::CheckMotion(motion, path.string());
  EXPECT_EQ(motion->frame_count, frames);
  EXPECT_DOUBLE_EQ(motion->rate_hz, 120.0);
  EXPECT_TRUE(motion->warnings.empty());
  const auto is_end = [](const JointTree::Joint& joint) { return joint.name.ends_with("_end"); };
  const std::vector<JointTree::Joint>& joints = motion->tree.joints;
  EXPECT_EQ(static_cast<std::size_t>(std::count_if(joints.begin(), joints.end(), is_end)) + 43u,
            joints.size());
}

TEST_P(RealMotion, IsCapturedWithEveryJointInItsPlace) {
  using J = HumanoidJoint;
  EGO_SHARED_DATA_OR_SKIP(path, std::string("bvh/") + GetParam().first);
  const Result<JointMotion> motion = ReadBvh(path);
  ASSERT_TRUE(motion) << motion.error();
  const Result<CapturedMotion> captured = CaptureFromJointMotion(*motion);
  ASSERT_TRUE(captured) << captured.error();
  const Body& performer = captured->performer;
  EXPECT_GT(performer.height, 1.5);
  EXPECT_LT(performer.height, 1.9);
  EXPECT_LT(std::abs(captured->floor_offset), 0.06);

  const std::vector<std::pair<J, const char*>> joints = {{J::kHips, "hip"},
                                                         {J::kHead, "head"},
                                                         {J::kLeftHand, "lHand"},
                                                         {J::kRightHand, "rHand"},
                                                         {J::kLeftLowerArm, "lForeArm"},
                                                         {J::kLeftLowerLeg, "lShin"},
                                                         {J::kRightLowerLeg, "rShin"},
                                                         {J::kLeftFoot, "lFoot"},
                                                         {J::kRightFoot, "rFoot"}};
  const std::size_t n = motion->tree.joints.size();
  std::size_t on_floor = 0;
  std::size_t looked_at = 0;
  for (std::size_t f = 0; f < motion->frame_count; f += 25) {
    // Where the file has its joints: matrices down the tree, centimetres.
    std::vector<Mat4> global(n);
    for (std::size_t j = 0; j < n; ++j) {
      Mat4 local = glm::mat4_cast(motion->rotation_ls[f * n + j]);
      local[3] = Vec4(motion->translation_ls[f * n + j], 1.0);
      const int parent = motion->tree.joints[j].parent;
      global[j] = parent < 0 ? local : global[static_cast<std::size_t>(parent)] * local;
    }
    const auto in_file = [&](std::string_view name) {
      for (std::size_t j = 0; j < n; ++j) {
        if (motion->tree.joints[j].name == name) return 0.01 * Vec3(global[j][3]);
      }
      return Vec3{1e9};
    };
    const ModelPose pose = ForwardKinematics(performer.skeleton, captured->poses[f]);
    for (const auto& [a, name_a] : joints) {
      EXPECT_NEAR(pose.Position(a).y, in_file(name_a).y + captured->floor_offset, 1e-6) << name_a;
      for (const auto& [b, name_b] : joints) {
        EXPECT_NEAR(glm::length(pose.Position(a) - pose.Position(b)),
                    glm::length(in_file(name_a) - in_file(name_b)), 1e-6)
            << name_a << " " << name_b << " frame " << f;
      }
    }
    const double ankle = std::min(pose.Position(J::kLeftFoot).y, pose.Position(J::kRightFoot).y);
    const std::array<Vec3, kJointCount> canonical = CanonicalPositions(performer.skeleton);
    on_floor += std::abs(ankle - canonical[Index(J::kLeftFoot)].y) < 0.04 ? 1 : 0;
    ++looked_at;
  }
  EXPECT_GT(on_floor, looked_at / 2);
}

INSTANTIATE_TEST_SUITE_P(Bvh, RealMotion,
                         testing::Values(std::pair{"cmu_02_05.bvh", 1855u},
                                         std::pair{"cmu_13_09.bvh", 1103u},
                                         std::pair{"cmu_13_16.bvh", 2276u},
                                         std::pair{"cmu_12_03.bvh", 566u},
                                         std::pair{"cmu_02_10.bvh", 2646u}));

}  // namespace
}  // namespace ego
