// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace ego {

/// An OpenGL 3.3 core context that needs neither a window nor an X server (EGL without a surface).
/// It is current on the thread that created it, until it is destroyed there. Draw with
/// StageRenderer::DrawImage: there is no default framebuffer.
class OffscreenContext {
 public:
  /// Fails with a sentence where the machine's driver offers no such context.
  static Result<OffscreenContext> Create();

  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

  /// What draws: the driver's own name for itself.
  const std::string& Renderer() const;

 private:
  struct Impl;
  explicit OffscreenContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
