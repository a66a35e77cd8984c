// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/result.h"
#include "core/model/character.h"
#include "render/gl/handle.h"

namespace ego::gl {

/// A picture to draw into: colour and depth, multisampled when `samples` > 1.
class ColorTarget {
 public:
  /// Makes it this size, or keeps it when it is. False when the driver cannot.
  bool Resize(int width, int height, int samples);
  GLuint Name() const { return framebuffer_.Name(); }

 private:
  int width_ = 0, height_ = 0, samples_ = 0;
  Framebuffer framebuffer_;
  Renderbuffer color_;
  Renderbuffer depth_;
};

/// A depth picture that shaders compare with (sampler2DShadow); outside of it things are lit as at
/// its edge, where nothing is drawn.
class ShadowTarget {
 public:
  bool Resize(int width, int height);
  GLuint Name() const { return framebuffer_.Name(); }
  GLuint DepthTexture() const { return depth_.Name(); }

 private:
  int width_ = 0, height_ = 0;
  Framebuffer framebuffer_;
  Texture depth_;
};

/// An sRGB picture with all its mipmaps, repeated at the edges; halved until the driver takes it.
/// An empty or inconsistent picture gives one white texel.
Texture MakeColorTexture(const Image& image);

}  // namespace ego::gl
