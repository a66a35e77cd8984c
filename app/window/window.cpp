// SPDX-License-Identifier: MIT
#include "app/window/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

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

void Window::InstallInputCallbacks() {
  using Kind = Event::Kind;
  glfwSetKeyCallback(handle_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    Of(w).waiting_.push_back({Kind::kKey, 0, 0, key, scancode, action, mods, 0});
  });
  glfwSetCharCallback(handle_, [](GLFWwindow* w, unsigned codepoint) {
    Of(w).waiting_.push_back({Kind::kText, 0, 0, 0, 0, 0, 0, codepoint});
  });
  glfwSetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int mods) {
    // GLFW would tell where the pointer is by now, not where it was when the button moved.
    Window& window = Of(w);
    if (!window.has_moved_) glfwGetCursorPos(w, &window.last_x_, &window.last_y_);
    window.waiting_.push_back(
        {Kind::kButton, window.last_x_, window.last_y_, button, 0, action, mods, 0});
  });
  glfwSetScrollCallback(handle_, [](GLFWwindow* w, double x, double y) {
    Of(w).waiting_.push_back({Kind::kScroll, x, y, 0, 0, 0, 0, 0});
  });
  glfwSetCursorPosCallback(handle_, [](GLFWwindow* w, double x, double y) {
    Window& window = Of(w);
    window.has_moved_ = true;
    window.last_x_ = x;
    window.last_y_ = y;
    window.waiting_.push_back({Kind::kMove, x, y, 0, 0, 0, 0, 0});
  });
  glfwSetCursorEnterCallback(handle_, [](GLFWwindow* w, int entered) {
    Of(w).waiting_.push_back({Kind::kEnter, 0, 0, 0, 0, entered, 0, 0});
  });
}

void Window::InstallCallbacks() {
  InstallInputCallbacks();
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
  glfwSetWindowCloseCallback(handle_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);
    Of(w).had_input_ = true;
    Of(w).close_requested_ = true;
  });
}

void Window::OnKey(const Event& event) {
  if (event.action == GLFW_RELEASE) {
    const auto& down = down_this_poll_;
    if (std::find(down.begin(), down.end(), event.key) != down.end()) {
      held_back_.push_back(event);
      return;
    }
  } else {
    presses_.push_back({event.key, (event.mods & GLFW_MOD_SHIFT) != 0,
                        (event.mods & GLFW_MOD_CONTROL) != 0, (event.mods & GLFW_MOD_ALT) != 0,
                        event.action == GLFW_REPEAT});
    down_this_poll_.push_back(event.key);
  }
  if (ImGui::GetCurrentContext()) {
    ImGui_ImplGlfw_KeyCallback(handle_, event.key, event.scancode, event.action, event.mods);
  }
}

// Dear ImGui's own handlers are told in the order in which things happened, but for the pointer,
// which Gui::Begin takes from here; without its context there is nobody to tell.
void Window::HandOut() {
  const bool gui = ImGui::GetCurrentContext() != nullptr;
  bool moved = false;
  while (!waiting_.empty()) {
    const Event event = waiting_.front();
    // What lies under the pointer must be known before a button goes down on it.
    if (event.kind == Event::Kind::kButton && event.action == GLFW_PRESS && moved) return;
    waiting_.pop_front();
    had_input_ = true;
    switch (event.kind) {
      case Event::Kind::kMove:
        pointer_.x = static_cast<float>(event.x);
        pointer_.y = static_cast<float>(event.y);
        pointer_.inside = true;
        moved = true;
        break;
      case Event::Kind::kEnter:
        pointer_.inside = event.action != 0;
        if (gui) ImGui_ImplGlfw_CursorEnterCallback(handle_, event.action);
        break;
      case Event::Kind::kButton:
        pointer_.x = static_cast<float>(event.x);
        pointer_.y = static_cast<float>(event.y);
        if (event.key < 0 || event.key >= static_cast<int>(pointer_.down.size())) break;
        pointer_.down[static_cast<std::size_t>(event.key)] = event.action == GLFW_PRESS;
        return;
      case Event::Kind::kScroll:
        if (gui) ImGui_ImplGlfw_ScrollCallback(handle_, event.x, event.y);
        break;
      case Event::Kind::kKey:
        OnKey(event);
        break;
      case Event::Kind::kText:
        if (gui) ImGui_ImplGlfw_CharCallback(handle_, event.codepoint);
        break;
    }
  }
}

void Window::Poll(double patience_s) {
  presses_.clear();
  dropped_.clear();
  down_this_poll_.clear();
  had_input_ = !held_back_.empty();
  if (ImGui::GetCurrentContext()) {
    for (const Event& up : held_back_) {
      ImGui_ImplGlfw_KeyCallback(handle_, up.key, up.scancode, GLFW_RELEASE, up.mods);
    }
  }
  held_back_.clear();
  if (patience_s > 0.0 && waiting_.empty()) {
    glfwWaitEventsTimeout(patience_s);
  } else {
    glfwPollEvents();
  }
  HandOut();
}

bool Window::TakeCloseRequest() { return std::exchange(close_requested_, false); }

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
