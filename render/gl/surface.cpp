// SPDX-License-Identifier: MIT
#include "render/gl/surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ego::gl {
namespace {

Renderbuffer MakeStorage(GLenum format, int width, int height, int samples) {
  Renderbuffer buffer = Renderbuffer::Make();
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.Name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
                                   height);
  return buffer;
}

Image Halved(const Image& image) {
  Image half;
  half.width = std::max(1, image.width / 2);
  half.height = std::max(1, image.height / 2);
  half.rgba.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                   4u);
  const auto at = [&](int x, int y, int c) -> unsigned {
    x = std::min(x, image.width - 1);
    y = std::min(y, image.height - 1);
    return image.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x)) *
                          4u +
                      static_cast<std::size_t>(c)];
  };
  std::size_t out = 0;
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        const unsigned sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) +
                             at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
        half.rgba[out++] = static_cast<std::uint8_t>((sum + 2u) / 4u);
      }
    }
  }
  return half;
}

}  // namespace

bool ColorTarget::Resize(int width, int height, int samples) {
  if (framebuffer_ && width == width_ && height == height_ && samples == samples_) return true;
  GLint limit = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
  if (width <= 0 || height <= 0 || width > limit || height > limit) return false;
  framebuffer_ = Framebuffer::Make();
  color_ = MakeStorage(GL_RGBA8, width, height, samples);
  depth_ = MakeStorage(GL_DEPTH_COMPONENT24, width, height, samples);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.Name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.Name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.Name());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    framebuffer_ = {};
    return false;
  }
  width_ = width;
  height_ = height;
  samples_ = samples;
  return true;
}

bool ShadowTarget::Resize(int width, int height) {
  if (framebuffer_ && width == width_ && height == height_) return true;
  depth_ = Texture::Make();
  glBindTexture(GL_TEXTURE_2D, depth_.Name());
  // Sixteen bits tell a third of a millimetre on twenty metres, and are read faster than more.
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, width, height, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_SHORT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

  framebuffer_ = Framebuffer::Make();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.Name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.Name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    framebuffer_ = {};
    return false;
  }
  width_ = width;
  height_ = height;
  return true;
}

Texture MakeColorTexture(const Image& image) {
  constexpr std::array<std::uint8_t, 4> kWhite = {255, 255, 255, 255};
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  Image smaller;
  const Image* source = &image;
  while (source->width > limit || source->height > limit) {
    smaller = Halved(*source);
    source = &smaller;
  }
  const bool usable = source->width > 0 && source->height > 0 &&
                      source->rgba.size() == static_cast<std::size_t>(source->width) *
                                                 static_cast<std::size_t>(source->height) * 4u;
  Texture texture = Texture::Make();
  glBindTexture(GL_TEXTURE_2D, texture.Name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, usable ? source->width : 1,
               usable ? source->height : 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               usable ? source->rgba.data() : kWhite.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

}  // namespace ego::gl
