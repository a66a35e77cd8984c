// SPDX-License-Identifier: MIT
#include "render/text_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <stb_truetype.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace ego {
namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr int kBuiltInHeight = 12;  // pixels of its line; capitals are 7 high

}  // namespace

struct TextAtlas::Font {
  std::vector<std::uint8_t> bytes;
  stbtt_fontinfo info{};
  float cap_height_per_em = 0.7f;
};

TextAtlas::TextAtlas(std::span<const std::uint8_t> font)
    : pixels_(static_cast<std::size_t>(kSide) * kSide, std::uint8_t{0}) {
  if (font.size() < 1024) return;
  auto loaded = std::make_unique<Font>();
  loaded->bytes.assign(font.begin(), font.end());
  const int offset = stbtt_GetFontOffsetForIndex(loaded->bytes.data(), 0);
  if (offset < 0 || stbtt_InitFont(&loaded->info, loaded->bytes.data(), offset) == 0) return;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  if (stbtt_GetCodepointBox(&loaded->info, 'H', &x0, &y0, &x1, &y1) != 0) {
    loaded->cap_height_per_em =
        static_cast<float>(y1) * stbtt_ScaleForMappingEmToPixels(&loaded->info, 1.0f);
  }
  font_ = std::move(loaded);
  SetSize(size_);
}
TextAtlas::TextAtlas(TextAtlas&&) noexcept = default;
TextAtlas& TextAtlas::operator=(TextAtlas&&) noexcept = default;
TextAtlas::~TextAtlas() = default;

bool TextAtlas::HasFont() const { return font_ != nullptr; }

void TextAtlas::SetSize(float pixels) {
  pixels = std::clamp(pixels, 4.0f, 200.0f);
  if (font_) {
    scale_ = stbtt_ScaleForMappingEmToPixels(&font_->info, pixels);
  } else {
    scale_ = std::max(1.0f, std::round(pixels / static_cast<float>(kBuiltInHeight)));
  }
  if (pixels == size_ && !glyphs_.empty()) return;
  size_ = pixels;
  glyphs_.clear();
  std::fill(pixels_.begin(), pixels_.end(), std::uint8_t{0});
  pen_ = glm::ivec2{1};
  row_height_ = 0;
  changed_ = true;
}

float TextAtlas::CapHeight() const {
  return font_ ? font_->cap_height_per_em * size_ : 7.0f * scale_;
}

bool TextAtlas::TakeChanged() { return std::exchange(changed_, false); }

float TextAtlas::Layout(std::string_view utf8, std::vector<Quad>& quads) {
  float x = 0.0f;
  int previous = 0;
  while (!utf8.empty()) {
    const Glyph& glyph = Get(NextCodepoint(utf8));
    if (font_ && previous != 0) {
      x += scale_ *
           static_cast<float>(stbtt_GetGlyphKernAdvance(&font_->info, previous, glyph.index));
    }
    previous = glyph.index;
    if (glyph.size.x > 0 && glyph.size.y > 0) {
      const glm::vec2 corner = glm::vec2{std::round(x), 0.0f} + glyph.offset;
      const float side = static_cast<float>(kSide);
      quads.push_back({corner, corner + glm::vec2(glyph.size), glm::vec2(glyph.corner) / side,
                       glm::vec2(glyph.corner + glyph.size) / side});
    }
    x += glyph.advance;
  }
  return x;
}

const TextAtlas::Glyph& TextAtlas::Get(char32_t codepoint) {
  const auto [it, is_new] = glyphs_.try_emplace(codepoint);
  if (is_new && font_) Rasterise(codepoint, it->second);
  if (is_new && !font_) RasteriseBuiltIn(codepoint, it->second);
  return it->second;
}

bool TextAtlas::Reserve(glm::ivec2 size, glm::ivec2& corner) {
  if (pen_.x + size.x + 1 > kSide) {
    pen_ = {1, pen_.y + row_height_ + 1};
    row_height_ = 0;
  }
  if (size.x + 2 > kSide || pen_.y + size.y + 1 > kSide) return false;
  corner = pen_;
  pen_.x += size.x + 1;
  row_height_ = std::max(row_height_, size.y);
  changed_ = true;
  return true;
}

void TextAtlas::Rasterise(char32_t codepoint, Glyph& glyph) {
  const stbtt_fontinfo* info = &font_->info;
  glyph.index = stbtt_FindGlyphIndex(info, static_cast<int>(codepoint));
  int advance = 0, bearing = 0;
  stbtt_GetGlyphHMetrics(info, glyph.index, &advance, &bearing);
  glyph.advance = scale_ * static_cast<float>(advance);
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetGlyphBitmapBox(info, glyph.index, scale_, scale_, &x0, &y0, &x1, &y1);
  const glm::ivec2 size{x1 - x0, y1 - y0};
  if (size.x <= 0 || size.y <= 0 || !Reserve(size, glyph.corner)) return;
  glyph.size = size;
  glyph.offset = {static_cast<float>(x0), static_cast<float>(y0)};
  stbtt_MakeGlyphBitmap(info,
                        &pixels_[static_cast<std::size_t>(glyph.corner.y * kSide + glyph.corner.x)],
                        size.x, size.y, kSide, scale_, scale_, glyph.index);
}

void TextAtlas::RasteriseBuiltIn(char32_t codepoint, Glyph& glyph) {
  std::array<char, 2> text = {'?', '\0'};
  if (codepoint >= 32 && codepoint < 127) text[0] = static_cast<char>(codepoint);
  const int zoom = static_cast<int>(scale_);
  glyph.advance = static_cast<float>(zoom * stb_easy_font_width(text.data()));
  struct Vertex {
    float x, y, z;
    std::array<unsigned char, 4> color;
  };
  std::array<Vertex, 256> vertices;
  const int quads = stb_easy_font_print(0.0f, 0.0f, text.data(), nullptr, vertices.data(),
                                        static_cast<int>(sizeof(vertices)));
  const glm::ivec2 size{zoom * 10, zoom * kBuiltInHeight};
  if (quads <= 0 || !Reserve(size, glyph.corner)) return;
  glyph.size = size;
  glyph.offset = {0.0f, -7.0f * scale_};
  for (int q = 0; q < quads; ++q) {
    const Vertex& low = vertices[static_cast<std::size_t>(4 * q)];
    const Vertex& high = vertices[static_cast<std::size_t>(4 * q + 2)];
    const int x1 = std::min(zoom * static_cast<int>(high.x), size.x);
    const int y1 = std::min(zoom * static_cast<int>(high.y), size.y);
    for (int y = zoom * static_cast<int>(low.y); y < y1; ++y) {
      for (int x = zoom * static_cast<int>(low.x); x < x1; ++x) {
        pixels_[static_cast<std::size_t>((glyph.corner.y + y) * kSide + glyph.corner.x + x)] = 255;
      }
    }
  }
}

char32_t NextCodepoint(std::string_view& utf8) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  char32_t value = length == 1 ? first : first & (0xFFu >> (length + 1));
  bool good = length != 0 && length <= utf8.size();
  for (std::size_t i = 1; good && i < length; ++i) {
    good = (byte(i) & 0xC0u) == 0x80u;
    value = (value << 6) | (byte(i) & 0x3Fu);
  }
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  if (!good || value < kLeast[length] || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000)) {
    utf8.remove_prefix(1);
    return kReplacement;
  }
  utf8.remove_prefix(length);
  return value;
}

}  // namespace ego
