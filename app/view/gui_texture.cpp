// SPDX-License-Identifier: MIT
#include "app/view/gui_texture.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <utility>

namespace ego {

GuiTexture::~GuiTexture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

GuiTexture::GuiTexture(GuiTexture&& other) noexcept
    : name_(std::exchange(other.name_, 0u)), width_(other.width_), height_(other.height_) {}

GuiTexture& GuiTexture::operator=(GuiTexture&& other) noexcept {
  std::swap(name_, other.name_);
  width_ = other.width_;
  height_ = other.height_;
  return *this;
}

void GuiTexture::Set(const Image& image) {
  if (name_ == 0) glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  width_ = image.width;
  height_ = image.height;
}

void* GuiTexture::id() const { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(name_)); }

}  // namespace ego
