// SPDX-License-Identifier: MIT
#include "app/window/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>

namespace ego {

Result<std::unique_ptr<Window>> Window::Open(const std::string& title, int width, int height) {
  if (!glfwInit()) {
    return Error{"no display to open a window on (egostudio render draws without one)"};
  }
  std::unique_ptr<Window> window(new Window);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  if (const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor())) {
    width = std::min(width, mode->width);
    height = std::min(height, mode->height);
  }
  window->handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window->handle_) {
    return Error{"this display offers no OpenGL 3.3 to draw with (egostudio render needs none)"};
  }
  glfwSetWindowSizeLimits(window->handle_, 960, 600, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window->handle_, window.get());
  glfwMakeContextCurrent(window->handle_);
  glfwSwapInterval(1);
  glfwGetFramebufferSize(window->handle_, &window->width_, &window->height_);
  glfwGetWindowContentScale(window->handle_, &window->content_scale_, nullptr);
  window->InstallCallbacks();
  return window;
}

Window::~Window() {
  if (handle_) glfwDestroyWindow(handle_);
  glfwTerminate();
}

Window& Window::Of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

// Dear ImGui's handlers are called from ours; without its context there is nobody to tell.
void Window::InstallCallbacks() {
  glfwSetKeyCallback(handle_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    Of(w).OnKey(key, scancode, action, mods);
  });
  glfwSetCharCallback(handle_, [](GLFWwindow* w, unsigned codepoint) {
    Of(w).had_input_ = true;
    if (ImGui::GetCurrentContext()) ImGui_ImplGlfw_CharCallback(w, codepoint);
  });
  glfwSetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int mods) {
    Of(w).had_input_ = true;
    if (ImGui::GetCurrentContext()) ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
  });
  glfwSetScrollCallback(handle_, [](GLFWwindow* w, double x, double y) {
    Of(w).had_input_ = true;
    if (ImGui::GetCurrentContext()) ImGui_ImplGlfw_ScrollCallback(w, x, y);
  });
  glfwSetCursorPosCallback(handle_, [](GLFWwindow* w, double, double) { Of(w).had_input_ = true; });
  glfwSetCursorEnterCallback(handle_, [](GLFWwindow* w, int entered) {
    Of(w).had_input_ = true;
    if (ImGui::GetCurrentContext()) ImGui_ImplGlfw_CursorEnterCallback(w, entered);
  });
  glfwSetWindowFocusCallback(handle_, [](GLFWwindow* w, int focused) {
    Of(w).had_input_ = true;
    if (ImGui::GetCurrentContext()) ImGui_ImplGlfw_WindowFocusCallback(w, focused);
  });
  glfwSetFramebufferSizeCallback(handle_, [](GLFWwindow* w, int width, int height) {
    Of(w).had_input_ = true;
    Of(w).width_ = width;
    Of(w).height_ = height;
  });
  glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* w) { Of(w).had_input_ = true; });
  glfwSetWindowContentScaleCallback(handle_, [](GLFWwindow* w, float scale, float) {
    Of(w).had_input_ = true;
    Of(w).content_scale_ = scale;
  });
  glfwSetDropCallback(handle_, [](GLFWwindow* w, int count, const char** paths) {
    Of(w).had_input_ = true;
    for (int i = 0; i < count; ++i) Of(w).dropped_.emplace_back(paths[i]);
  });
}

void Window::OnKey(int key, int scancode, int action, int mods) {
  had_input_ = true;
  if (action == GLFW_RELEASE) {
    if (std::find(down_this_poll_.begin(), down_this_poll_.end(), key) != down_this_poll_.end()) {
      held_back_.push_back({key, scancode, mods});
      return;
    }
  } else {
    presses_.push_back({key, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0,
                        (mods & GLFW_MOD_ALT) != 0, action == GLFW_REPEAT});
    down_this_poll_.push_back(key);
  }
  if (ImGui::GetCurrentContext()) {
    ImGui_ImplGlfw_KeyCallback(handle_, key, scancode, action, mods);
  }
}

void Window::Poll(double patience_s) {
  presses_.clear();
  dropped_.clear();
  down_this_poll_.clear();
  had_input_ = !held_back_.empty();
  if (ImGui::GetCurrentContext()) {
    for (const HeldBack& up : held_back_) {
      ImGui_ImplGlfw_KeyCallback(handle_, up.key, up.scancode, GLFW_RELEASE, up.mods);
    }
  }
  held_back_.clear();
  if (patience_s > 0.0) {
    glfwWaitEventsTimeout(patience_s);
  } else {
    glfwPollEvents();
  }
}

void Window::Present() { glfwSwapBuffers(handle_); }
bool Window::ShouldClose() const { return glfwWindowShouldClose(handle_) != 0; }
void Window::Close() { glfwSetWindowShouldClose(handle_, GLFW_TRUE); }
void Window::SetTitle(const std::string& title) { glfwSetWindowTitle(handle_, title.c_str()); }

double Window::refresh_hz() const {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode && mode->refreshRate > 0 ? static_cast<double>(mode->refreshRate) : 60.0;
}

}  // namespace ego
