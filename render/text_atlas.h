// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace ego {

/// Glyphs of one font at one size, rasterised when first asked for, in one grey picture.
class TextAtlas {
 public:
  /// Bytes of a TrueType or OpenType font (copied). Empty or unreadable: a plain built-in face,
  /// printable ASCII only.
  explicit TextAtlas(std::span<const std::uint8_t> font);
  TextAtlas(TextAtlas&&) noexcept;
  TextAtlas& operator=(TextAtlas&&) noexcept;
  ~TextAtlas();

  static constexpr int kSide = 1024;

  /// Size of the type in pixels (the em). A change forgets all glyphs.
  void SetSize(float pixels);

  struct Quad {
    glm::vec2 min, max;        // pixels from the start of the baseline, y down
    glm::vec2 uv_min, uv_max;  // in the atlas
  };
  /// Appends the quads of a line of UTF-8 text; returns its width in pixels. Bytes that are no
  /// UTF-8 and characters the font lacks appear as its sign for a missing glyph.
  float Layout(std::string_view utf8, std::vector<Quad>& quads);
  /// Height of capital letters in pixels, for centring.
  float CapHeight() const;

  bool HasFont() const;
  /// One byte of coverage per pixel, kSide * kSide; first row at the top.
  std::span<const std::uint8_t> Pixels() const { return pixels_; }
  /// True once after every change of the pixels.
  bool TakeChanged();

 private:
  struct Font;
  struct Glyph {
    glm::vec2 offset{0.0f};  // of the picture's top left corner from the pen
    glm::ivec2 corner{0}, size{0};
    float advance = 0.0f;
    int index = 0;
  };
  const Glyph& Get(char32_t codepoint);
  void Rasterise(char32_t codepoint, Glyph& glyph);
  void RasteriseBuiltIn(char32_t codepoint, Glyph& glyph);
  bool Reserve(glm::ivec2 size, glm::ivec2& corner);

  std::unique_ptr<Font> font_;
  float size_ = 15.0f;
  float scale_ = 1.0f;
  std::map<char32_t, Glyph> glyphs_;
  std::vector<std::uint8_t> pixels_;
  glm::ivec2 pen_{1};
  int row_height_ = 0;
  bool changed_ = true;
};

/// The next character of a UTF-8 text, which is shortened by it; U+FFFD for a wrong byte.
char32_t NextCodepoint(std::string_view& utf8);

}  // namespace ego
