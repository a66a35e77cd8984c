// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

struct GLFWwindow;

namespace ego {

/// A key that went down, or repeated while held.
struct KeyPress {
  int key = 0;  // GLFW_KEY_...
  bool shift = false;
  bool control = false;
  bool alt = false;
  bool repeated = false;
};

/// The one window with its OpenGL 3.3 core context, current on the creating thread. Collects what
/// happens between two polls, so that no press is lost however slow the drawing is.
class Window {
 public:
  /// Error: no display, or no such context; one sentence.
  static Result<std::unique_ptr<Window>> Open(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Collects new input. Waits for some for at most `patience_s` seconds (0: not at all).
  void Poll(double patience_s);
  /// Shows what was drawn.
  void Present();

  bool ShouldClose() const;
  void Close();
  void SetTitle(const std::string& title);

  /// Size of the framebuffer, pixels. May be zero while minimised.
  int width() const { return width_; }
  int height() const { return height_; }
  /// Of the monitor that the window is on.
  float content_scale() const { return content_scale_; }
  double refresh_hz() const;

  /// Key presses of the last poll, in order.
  const std::vector<KeyPress>& presses() const { return presses_; }
  /// Files dropped during the last poll.
  const std::vector<std::filesystem::path>& dropped() const { return dropped_; }
  /// True when anything at all happened in the last poll.
  bool had_input() const { return had_input_; }

  GLFWwindow* handle() const { return handle_; }

 private:
  Window() = default;
  void InstallCallbacks();
  static Window& Of(GLFWwindow* handle);
  void OnKey(int key, int scancode, int action, int mods);

  GLFWwindow* handle_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  float content_scale_ = 1.0f;
  bool had_input_ = false;
  std::vector<KeyPress> presses_;
  std::vector<std::filesystem::path> dropped_;

  // A key that goes down and up between two polls would never be seen down by the user interface:
  // its release is held back until the next poll.
  struct HeldBack {
    int key;
    int scancode;
    int mods;
  };
  std::vector<HeldBack> held_back_;
  std::vector<int> down_this_poll_;
};

}  // namespace ego
