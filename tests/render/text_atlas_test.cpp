// SPDX-License-Identifier: MIT
#include "render/text_atlas.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace ego {
namespace {

std::vector<std::uint8_t> Inter() {
  std::ifstream in("/usr/share/fonts/opentype/inter/Inter-Medium.otf", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

long Ink(const TextAtlas& atlas) {
  return std::accumulate(atlas.Pixels().begin(), atlas.Pixels().end(), 0L);
}

TEST(TextAtlas, ReadsUtf8AndMarksWrongBytes) {
  std::string_view text = "a\xC3\xA5\xE2\x82\xAC\xF0\x9F\x98\x80\xFFz";
  EXPECT_EQ(NextCodepoint(text), U'a');
  EXPECT_EQ(NextCodepoint(text), U'\u00E5');
  EXPECT_EQ(NextCodepoint(text), U'\u20AC');
  EXPECT_EQ(NextCodepoint(text), U'\U0001F600');
  EXPECT_EQ(NextCodepoint(text), U'\uFFFD');
  EXPECT_EQ(NextCodepoint(text), U'z');
  EXPECT_TRUE(text.empty());
  for (std::string_view wrong : {"\xC0\x80", "\xED\xA0\x80", "\xE2\x82", "\x80", "\xF8\x88"}) {
    const std::size_t size = wrong.size();
    EXPECT_EQ(NextCodepoint(wrong), U'\uFFFD');
    EXPECT_EQ(wrong.size(), size - 1);
  }
}

TEST(TextAtlas, WithoutAFontABuiltInFaceStandsIn) {
  const std::vector<std::uint8_t> noise(5000, 0x5A);
  for (const std::span<const std::uint8_t> font :
       {std::span<const std::uint8_t>(), std::span<const std::uint8_t>(noise)}) {
    TextAtlas atlas(font);
    EXPECT_FALSE(atlas.HasFont());
    std::vector<TextAtlas::Quad> quads;
    const float one = atlas.Layout("Child", quads);
    EXPECT_EQ(quads.size(), 5u);
    EXPECT_GT(Ink(atlas), 0);
    EXPECT_GT(atlas.Layout("Child, the second", quads), one);
    EXPECT_GT(atlas.Layout("\xC3\x85", quads), 0.0f);
  }
}

TEST(TextAtlas, LaysGlyphsOutOnTheBaselineInOrder) {
  const std::vector<std::uint8_t> font = Inter();
  if (font.empty()) GTEST_SKIP() << "the font Inter is not installed";
  TextAtlas atlas(font);
  ASSERT_TRUE(atlas.HasFont());
  atlas.SetSize(30.0f);
  std::vector<TextAtlas::Quad> quads;
  const float width = atlas.Layout("H\xC3\x85pg", quads);
  ASSERT_EQ(quads.size(), 4u);
  EXPECT_NEAR(quads[0].max.y, 0.0f, 1.01f);
  EXPECT_NEAR(-quads[0].min.y, atlas.CapHeight(), 1.5f);
  EXPECT_LT(quads[1].min.y, quads[0].min.y - 2.0f);  // the ring
  EXPECT_GT(quads[2].max.y, 3.0f);                   // the descender
  for (std::size_t i = 1; i < quads.size(); ++i) EXPECT_GT(quads[i].min.x, quads[i - 1].min.x);
  EXPECT_GT(width, quads.back().max.x - 4.0f);
  EXPECT_TRUE(atlas.TakeChanged());
  EXPECT_FALSE(atlas.TakeChanged());
  quads.clear();
  atlas.Layout("gH", quads);
  EXPECT_FALSE(atlas.TakeChanged()) << "known glyphs need no new pixels";
}

TEST(TextAtlas, AFullAtlasLeavesGlyphsOutAndStaysWhole) {
  const std::vector<std::uint8_t> font = Inter();
  if (font.empty()) GTEST_SKIP() << "the font Inter is not installed";
  TextAtlas atlas(font);
  atlas.SetSize(200.0f);
  std::vector<TextAtlas::Quad> quads;
  for (char c = '!'; c < '~'; ++c) atlas.Layout(std::string(1, c), quads);
  EXPECT_LT(quads.size(), 93u);
  for (const TextAtlas::Quad& quad : quads) {
    EXPECT_GE(quad.uv_min.y, 0.0f);
    EXPECT_LE(quad.uv_max.x, 1.0f);
    EXPECT_LE(quad.uv_max.y, 1.0f);
  }
}

}  // namespace
}  // namespace ego
