// SPDX-License-Identifier: MIT
#include "assets/takes/c3d.h"

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/c3d_writer.h"

namespace ego {
namespace {

using test::C3dFile;
using test::WriteC3d;
using Order = C3dFile::Order;

/// A standing person of few markers in mm with Z up, moving a little; two gaps.
C3dFile Person() {
  C3dFile file;
  file.labels = {"S:LFHD", "S:C7", "S:LASI", "S:LKNE", "S:LANK", "S:LHEE"};
  const double heights[] = {1650.0, 1500.0, 1000.0, 520.0, 90.0, 50.0};
  for (int f = 0; f < 7; ++f) {
    std::vector<C3dFile::Point> frame;
    for (int i = 0; i < 6; ++i) {
      frame.push_back({100.0 * i + 7.3 * f, -250.5 + 3.7 * i, heights[i] - 1.1 * f, 0.5});
    }
    if (f == 2) frame[3].residual = -1.0;
    if (f == 5) frame[0].residual = -1.0;
    file.frames.push_back(frame);
  }
  return file;
}

/// What a point in mm with Z up becomes.
Vec3 Stage(const C3dFile::Point& p) { return Vec3{p.x, p.z, -p.y} / 1000.0; }

void ExpectSame(const MarkerTake& take, const C3dFile& file, double tolerance) {
  ASSERT_EQ(take.frame_count, file.frames.size());
  ASSERT_EQ(take.labels, file.labels);
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    const MarkerFrame frame = take.Frame(f);
    EXPECT_DOUBLE_EQ(frame.time_s, static_cast<double>(f) / file.rate_hz);
    for (std::size_t i = 0; i < take.labels.size(); ++i) {
      const C3dFile::Point& p = file.frames[f][i];
      EXPECT_EQ(frame.visible[i] != 0, p.residual >= 0.0) << "frame " << f << " point " << i;
      if (p.residual < 0.0) continue;
      EXPECT_LT(glm::length(frame.position_ws[i] - Stage(p)), tolerance)
          << "frame " << f << " point " << i;
    }
  }
}

class C3dNumbers : public testing::TestWithParam<std::tuple<Order, bool>> {};

TEST_P(C3dNumbers, AreReadExactlyWithGapsAndAnalogDataBetween) {
  C3dFile file = Person();
  std::tie(file.order, file.integers) = GetParam();
  file.rate_hz = 120.0;
  file.scale = 0.0625;
  file.analog_per_frame = 7;
  file.first_frame = 286;
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "/somewhere/walk 1.c3d");
  ASSERT_TRUE(take) << take.error();
  EXPECT_EQ(take->name, "walk 1");
  EXPECT_DOUBLE_EQ(take->rate_hz, 120.0);
  EXPECT_TRUE(take->warnings.empty());
  // Floats carry 24 bits of 2 m, integers half a step along each axis.
  ExpectSame(*take, file, file.integers ? 0.0625e-3 * 0.8661 : 2e-7);
}

INSTANTIATE_TEST_SUITE_P(AllOrders, C3dNumbers,
                         testing::Combine(testing::Values(Order::kIntel, Order::kDec, Order::kSgi),
                                          testing::Bool()));

TEST(C3d, FindsUpFromTheMarkersWhateverTheScreenSays) {
  const C3dFile upright = Person();
  for (const bool sunk : {false, true}) {
    C3dFile file = Person();
    file.y_screen = "-Z";
    for (auto& frame : file.frames) {
      for (C3dFile::Point& p : frame) {
        // Y up, or -X up; the person keeps its shape and handedness.
        p = sunk ? C3dFile::Point{-p.z, p.y, p.x, p.residual}
                 : C3dFile::Point{p.x, p.z, -p.y, p.residual};
      }
    }
    const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
    ASSERT_TRUE(take) << take.error();
    ASSERT_EQ(take->warnings.size(), 1u);
    EXPECT_NE(take->warnings[0].find("-Z"), std::string::npos);
    const Vec3 a = take->Frame(0).position_ws[0];
    const Vec3 b = take->Frame(0).position_ws[5];
    const Vec3 a0 = Stage(upright.frames[0][0]);
    const Vec3 b0 = Stage(upright.frames[0][5]);
    EXPECT_NEAR(a.y - b.y, a0.y - b0.y, 1e-6);
    EXPECT_NEAR(glm::length(a - b), glm::length(a0 - b0), 1e-6);
    // Never mirrored: the sense of three difference vectors stays.
    const auto volume = [](const Vec3& o, const Vec3& p, const Vec3& q, const Vec3& r) {
      return glm::dot(p - o, glm::cross(q - o, r - o));
    };
    const auto at = [&](std::size_t i) { return take->Frame(6).position_ws[i]; };
    const auto was = [&](std::size_t i) { return Stage(upright.frames[6][i]); };
    EXPECT_NEAR(volume(at(0), at(1), at(2), at(4)), volume(was(0), was(1), was(2), was(4)), 1e-7);
  }
}

TEST(C3d, BelievesTheScreenAxisWhereLabelsSayNothing) {
  C3dFile file = Person();
  file.labels = {"a", "b", "c", "d", "e", "f"};
  file.y_screen = "+Y";
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  EXPECT_NEAR(take->Frame(0).position_ws[0].y, -0.2505, 1e-6);
}

TEST(C3d, ReadsUnitsByNameAndRepairsImpossibleOnes) {
  for (const auto& [unit, factor, warned] : {std::tuple{"MM", 1.0, false},
                                             {"m", 1e-3, false},
                                             {"cm", 0.1, false},
                                             {"in", 1.0 / 25.4, false},
                                             {"", 1.0, true},
                                             {"furlong", 1.0, true},
                                             {"m", 1.0, true}}) {
    C3dFile file = Person();
    // Twelve markers, so that the size of the person may be judged.
    for (const std::string& label : Person().labels) file.labels.push_back(label + "b");
    for (auto& frame : file.frames) {
      const std::vector<C3dFile::Point> half = frame;
      frame.insert(frame.end(), half.begin(), half.end());
      for (C3dFile::Point& p : frame) p = {p.x * factor, p.y * factor, p.z * factor, p.residual};
    }
    file.unit = unit;
    const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
    ASSERT_TRUE(take) << take.error();
    EXPECT_EQ(!take->warnings.empty(), warned) << unit << factor;
    EXPECT_NEAR(take->Frame(0).position_ws[0].y, 1.65, 1e-6) << unit << factor;
  }
}

TEST(C3d, TellsModelOutputsFromMarkers) {
  C3dFile file = Person();
  const std::vector<std::string> outputs = {
      "LHipAngles", "S:RKneeMoment", "R_HJC", "L.AnkleJointGround",
      "MidASIS",    "PELO",          "LFEO",  "LFEA",
      "LFEL",       "LFEP",          "Lean",  "Sway"};
  const std::vector<std::string> markers = {"LTOA", "LTOE", "T10", "C7x", "Hip1", "Middle", "*3"};
  for (const std::string& label : outputs) file.labels.push_back(label);
  for (const std::string& label : markers) file.labels.push_back(label);
  file.lists = {{"ANGLES", {"Lean"}}, {"MYKIND", {"Sway"}}, {"TYPE_GROUPS", {"MYKIND", "MINE"}}};
  for (auto& frame : file.frames) {
    const std::size_t more = outputs.size() + markers.size();
    for (std::size_t i = 0; i < more; ++i) {
      frame.push_back({static_cast<double>(i), 400.0, 700.0, 0.0});
    }
  }
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  EXPECT_EQ(take->ignored, outputs);
  std::vector<std::string> kept = Person().labels;
  kept.insert(kept.end(), markers.begin(), markers.end());
  EXPECT_EQ(take->labels, kept);
  // The kept markers have their own numbers, not those of the points left out.
  EXPECT_NEAR(take->Frame(3).position_ws[6].x, 0.012, 1e-6);
}

TEST(C3d, ReadsMoreThan255LabelsAndNumbersRepeatedOnes) {
  C3dFile file;
  for (int i = 0; i < 300; ++i) file.labels.push_back(std::string("M").append(std::to_string(i)));
  file.labels[270] = "M7";
  file.labels[280] = "";
  file.frames.resize(2);
  for (auto& frame : file.frames) {
    for (int i = 0; i < 300; ++i) frame.push_back({1.0 * i + 1.0, 0.0, 0.0, 0.0});
  }
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  ASSERT_EQ(take->labels.size(), 300u);
  EXPECT_EQ(take->labels[256], "M256");
  EXPECT_EQ(take->labels[270], "M7#2");
  EXPECT_EQ(take->labels[280], "*281");
  EXPECT_EQ(take->labels[299], "M299");
}

TEST(C3d, SurvivesOddParameterSections) {
  C3dFile file = Person();
  file.groups_last = true;
  file.locked_names = true;
  file.parameter_block = 77;
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  ExpectSame(*take, file, 2e-7);
}

TEST(C3d, CountsFramesBeyond16Bits) {
  C3dFile file;
  file.labels = {"A"};
  file.integers = true;
  file.frames.assign(70000, {{1.0, 2.0, 3.0, 0.0}});
  file.frames.back() = {{4.0, 5.0, 6.0, 0.0}};
  for (const bool fields : {true, false}) {
    file.write_trial_fields = fields;
    const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
    ASSERT_TRUE(take) << take.error();
    // Without the fields only the file's size tells; padding may add frames of zeros.
    ASSERT_GE(take->frame_count, 70000u);
    ASSERT_LE(take->frame_count, fields ? 70000u : 70064u);
    EXPECT_EQ(take->visible[69999], 1);
    EXPECT_NEAR(glm::length(take->position_ws[69999]), std::sqrt(77.0) / 1000.0, 1e-9);
  }
}

TEST(C3d, MakesImpossibleNumbersGaps) {
  C3dFile file = Person();
  file.frames[0][0].x = std::numeric_limits<double>::quiet_NaN();
  file.frames[1][1].z = std::numeric_limits<double>::infinity();
  file.frames[2][2].y = 3e30;
  file.frames[3][3] = {0.0, 0.0, 0.0, 0.0};
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  for (std::size_t f = 0; f < 4; ++f) EXPECT_EQ(take->Frame(f).visible[f], 0);
  for (const Vec3& p : take->position_ws) EXPECT_LT(glm::length(p), 10.0);
}

TEST(C3d, AssumesARateWhereNoneIsGiven) {
  C3dFile file = Person();
  file.rate_hz = 0.0;
  const Result<MarkerTake> take = ParseC3d(WriteC3d(file), "a.c3d");
  ASSERT_TRUE(take) << take.error();
  EXPECT_DOUBLE_EQ(take->rate_hz, 100.0);
  EXPECT_EQ(take->warnings.size(), 1u);
}

TEST(C3d, RefusesWhatIsNoTakeWithOneSentence) {
  const auto sentence = [](const std::vector<std::uint8_t>& bytes) {
    const Result<MarkerTake> take = ParseC3d(bytes, "bad.c3d");
    return take ? std::string("was read") : take.error();
  };
  EXPECT_EQ(sentence({}),
            "bad.c3d: is not a C3D file: its header does not begin with the C3D mark");
  std::vector<std::uint8_t> whole = WriteC3d(Person());
  std::vector<std::uint8_t> bytes = whole;
  bytes[1] = 0x51;
  EXPECT_NE(sentence(bytes).find("is not a C3D file"), std::string::npos);
  bytes = whole;
  bytes[512 + 3] = 12;
  EXPECT_NE(sentence(bytes).find("parameter section"), std::string::npos);

  C3dFile file = Person();
  file.declared_frames = 60000;
  EXPECT_NE(sentence(WriteC3d(file)).find("of 60000 frames are there"), std::string::npos);
  file.declared_frames = 4'000'000'000u;
  file.write_trial_fields = true;
  EXPECT_NE(sentence(WriteC3d(file)).find("of 4000000000 frames are there"), std::string::npos);
  file = Person();
  file.scale = 0.0;
  EXPECT_NE(sentence(WriteC3d(file)).find("SCALE"), std::string::npos);
  file = Person();
  file.labels = {"LHipAngles"};
  file.frames = {{{1.0, 2.0, 3.0, 0.0}}};
  EXPECT_NE(sentence(WriteC3d(file)).find("no markers"), std::string::npos);
}

TEST(C3d, RefusesEveryTruncation) {
  const std::vector<std::uint8_t> whole = WriteC3d(Person());
  // The last block is padding behind the last frame.
  const std::size_t data = 7 * 6 * 16;
  const std::size_t end = whole.size() - (512 - data % 512);
  for (std::size_t size = 0; size < end; size += 64) {
    const Result<MarkerTake> take = ParseC3d(std::span(whole).first(size), "cut.c3d");
    ASSERT_FALSE(take) << size;
    EXPECT_TRUE(take.error().starts_with("cut.c3d: ")) << take.error();
  }
}

}  // namespace
}  // namespace ego
