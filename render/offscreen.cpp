// SPDX-License-Identifier: MIT
#include "render/offscreen.h"

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace ego {

struct OffscreenContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string renderer;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }
};

namespace {

Error Refusal(const char* step) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%x", static_cast<unsigned>(eglGetError()));
  return Error{std::string("Cannot draw without a window: ") + step + " (EGL error " + code.data() +
               "); an OpenGL 3.3 driver such as Mesa's llvmpipe is needed."};
}

bool HasClientExtension(std::string_view wanted) {
  const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all != nullptr && std::string_view(all).find(wanted) != std::string_view::npos;
}

}  // namespace

OffscreenContext::OffscreenContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

const std::string& OffscreenContext::Renderer() const { return impl_->renderer; }

Result<OffscreenContext> OffscreenContext::Create() {
  auto impl = std::make_unique<Impl>();
  if (!HasClientExtension("EGL_MESA_platform_surfaceless") ||
      !HasClientExtension("EGL_EXT_platform_base")) {
    return Refusal("the EGL library knows no surfaceless platform");
  }
  impl->display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (impl->display == EGL_NO_DISPLAY) return Refusal("no surfaceless EGL display");
  EGLint major = 0, minor = 0;
  if (eglInitialize(impl->display, &major, &minor) != EGL_TRUE) {
    impl->display = EGL_NO_DISPLAY;
    return Refusal("the EGL display does not start");
  }
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return Refusal("EGL offers no desktop OpenGL");
  constexpr std::array<EGLint, 7> kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                 3,
                                                 EGL_CONTEXT_MINOR_VERSION,
                                                 3,
                                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                 EGL_NONE};
  impl->context =
      eglCreateContext(impl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  if (impl->context == EGL_NO_CONTEXT) return Refusal("no OpenGL 3.3 core context");
  if (eglMakeCurrent(impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl->context) != EGL_TRUE) {
    return Refusal("the context cannot be used without a surface");
  }
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  impl->renderer = name != nullptr ? name : "unknown";
  return OffscreenContext(std::move(impl));
}

}  // namespace ego
