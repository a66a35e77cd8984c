// SPDX-License-Identifier: MIT
#include "assets/takes/trc.h"

#include <string>

#include <gtest/gtest.h>

namespace ego {
namespace {

const std::string kNames =
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\n";
const std::string kRows =
    "Frame#\tTime\tR.Heel\t\t\tC7\t\t\tS:Head\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n"
    "\n"
    "1\t0.00\t10.5\t20.25\t-3e1\t40\t1500\t60\t70\t1600\t90\n"
    "2\t0.02\t\t\t\t41\t1501\t61\t0\t0\t0\n"
    "3\t0.04\t11\t21\t31\tnan\t1502\t62\t72\t1602\n";

std::string Table(const std::string& values, const std::string& rows = kRows) {
  return "PathFileType\t4\t(X/Y/Z)\ta.trc\n" + kNames + values + "\n" + rows;
}

TEST(Trc, ReadsPositionsAndGaps) {
  const Result<MarkerTake> take =
      ParseTrc(Table("50.0\t50.0\t3\t3\tmm\t50.0\t1\t3"), "x/static 1.trc");
  ASSERT_TRUE(take) << take.error();
  EXPECT_EQ(take->name, "static 1");
  EXPECT_DOUBLE_EQ(take->rate_hz, 50.0);
  ASSERT_EQ(take->frame_count, 3u);
  EXPECT_EQ(take->labels, (std::vector<std::string>{"R.Heel", "C7", "S:Head"}));
  EXPECT_EQ(take->visible, (std::vector<std::uint8_t>{1, 1, 1, 0, 1, 0, 1, 0, 0}));
  EXPECT_LT(glm::length(take->position_ws[0] - Vec3(0.0105, 0.02025, -0.03)), 1e-12);
  EXPECT_LT(glm::length(take->position_ws[4] - Vec3(0.041, 1.501, 0.061)), 1e-12);
  EXPECT_TRUE(take->warnings.empty());
}

TEST(Trc, FindsHeaderValuesBehindShiftedTabsInAnyLineEnding) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c :
         Table("  100.0\t\t  100.0\t\t    3\t\t     3\t\t mm\t  100.0\t      1\t  3")) {
      if (c == '\n') {
        text += end;
      } else {
        text += c;
      }
    }
    const Result<MarkerTake> take = ParseTrc(text, "a.trc");
    ASSERT_TRUE(take) << take.error();
    EXPECT_DOUBLE_EQ(take->rate_hz, 100.0);
    EXPECT_EQ(take->frame_count, 3u);
    EXPECT_NEAR(take->position_ws[4].y, 1.501, 1e-12);
  }
}

TEST(Trc, ReadsOtherUnitsAndSeparators) {
  const Result<MarkerTake> metres = ParseTrc(
      "x\nDataRate Units NumFrames\n60 m 1\nFrame# Time L.Toe Head\n1 0 1 0.1 3 0.5 1.6 2.5\n",
      "a.trc");
  ASSERT_TRUE(metres) << metres.error();
  EXPECT_EQ(metres->labels, (std::vector<std::string>{"L.Toe", "Head"}));
  EXPECT_LT(glm::length(metres->position_ws[1] - Vec3(0.5, 1.6, 2.5)), 1e-12);

  const Result<MarkerTake> inches = ParseTrc(
      "x\nDataRate,Units,NumFrames\n60,in,1\nFrame#,Time,LTOE,,,HEAD,,\n,,X1,Y1,Z1,X2,Y2,Z2\n"
      "1,0,10,1,30,5,66,6\n",
      "a.trc");
  ASSERT_TRUE(inches) << inches.error();
  EXPECT_NEAR(inches->position_ws[1].y, 66 * 0.0254, 1e-12);
}

TEST(Trc, TurnsTablesWithZUp) {
  const std::string rows =
      "Frame#\tTime\tR.Heel\t\t\tHead\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
      "1\t0\t10\t20\t30\t40\t50\t1600\n";
  const Result<MarkerTake> take =
      ParseTrc(Table("50.0\t50.0\t1\t2\tmm\t50.0\t1\t1", rows), "a.trc");
  ASSERT_TRUE(take) << take.error();
  EXPECT_LT(glm::length(take->position_ws[1] - Vec3(0.04, 1.6, -0.05)), 1e-12);
}

TEST(Trc, TakesTheRateFromTheTimeColumnWhenTheHeaderHasNone) {
  const Result<MarkerTake> take = ParseTrc(Table("0\t0\t3\t3\tmm\t0\t1\t3"), "a.trc");
  ASSERT_TRUE(take) << take.error();
  EXPECT_NEAR(take->rate_hz, 50.0, 1e-9);
  EXPECT_EQ(take->warnings.size(), 1u);
}

TEST(Trc, RefusesBadTablesWithOneSentence) {
  const auto sentence = [](const std::string& text) {
    const Result<MarkerTake> take = ParseTrc(text, "bad.trc");
    return take ? std::string("was read") : take.error();
  };
  const std::string good = "50.0\t50.0\t3\t3\tmm\t50.0\t1\t3";
  EXPECT_EQ(sentence(""),
            "bad.trc: is not a TRC table: the line that begins with \"Frame#\" is missing");
  EXPECT_EQ(sentence(Table("50.0\t50.0\t2000000000\t3\tmm\t50.0\t1\t3")),
            "bad.trc: is cut off: 3 of 2000000000 frames are there");
  EXPECT_EQ(sentence(Table(good, kRows + "4\t0.06\t1\toops\n")),
            "bad.trc: line 10: \"oops\" stands where a number is expected");
  EXPECT_EQ(sentence(Table(good, "Frame#\tTime\n1\t0\n")),
            "bad.trc: names no markers in its \"Frame#\" line");
  EXPECT_NE(sentence(Table(good, "Frame#\tTime\tA\n")).find("no frames"), std::string::npos);
}

TEST(Trc, RefusesTruncationsThatLoseRows) {
  const std::string whole = Table("50.0\t50.0\t3\t3\tmm\t50.0\t1\t3");
  const std::size_t third_row = whole.find("\n3\t0.04") + 1;
  for (std::size_t size = 0; size < third_row; size += 8) {
    const Result<MarkerTake> take = ParseTrc(std::string_view(whole).substr(0, size), "cut.trc");
    ASSERT_FALSE(take) << size;
    EXPECT_TRUE(take.error().starts_with("cut.trc: ")) << take.error();
  }
}

}  // namespace
}  // namespace ego
