// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/character.h"

namespace ego {

/// A picture that Dear ImGui can show. Needs the window's context current, from the first Set to
/// the end.
class GuiTexture {
 public:
  GuiTexture() = default;
  ~GuiTexture();
  GuiTexture(GuiTexture&& other) noexcept;
  GuiTexture& operator=(GuiTexture&& other) noexcept;

  void Set(const Image& image);
  /// What ImGui::Image takes; null before the first Set.
  void* id() const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  unsigned name_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace ego
