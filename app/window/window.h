// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
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

/// Where the pointer is and which of its buttons are down.
struct Pointer {
  float x = 0.0f;  // pixels, origin at the top left
  float y = 0.0f;
  bool inside = false;         // of the window
  std::array<bool, 3> down{};  // left, right, middle
};

/// The one window with its OpenGL 3.3 core context, current on the creating thread. Collects what
/// happens between two polls and hands it out in order, so that no press is lost however slow the
/// drawing is: a poll ends at the first mouse button that goes down or up, with the pointer where
/// it was then, and the rest waits for the next one.
class Window {
 public:
  /// Error: no display, or no such context; one sentence.
  static Result<std::unique_ptr<Window>> Open(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes in new input. Waits for some for at most `patience_s` seconds (0: not at all).
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
  /// The pointer as of the last poll.
  const Pointer& pointer() const { return pointer_; }
  /// True when something has happened that no poll has handed out yet.
  bool has_waiting_input() const { return !waiting_.empty() || !held_back_.empty(); }
  /// Files dropped during the last poll.
  const std::vector<std::filesystem::path>& dropped() const { return dropped_; }
  /// True when anything at all happened in the last poll.
  bool had_input() const { return had_input_; }
  /// True once when the user asked to close the window since the last call; it then stays open
  /// until Close().
  bool TakeCloseRequest();

  GLFWwindow* handle() const { return handle_; }

 private:
  struct Event {
    enum class Kind { kMove, kEnter, kButton, kScroll, kKey, kText };
    Kind kind = Kind::kMove;
    double x = 0.0;  // place, or how far scrolled
    double y = 0.0;
    int key = 0;  // or button
    int scancode = 0;
    int action = 0;  // or whether the pointer entered
    int mods = 0;
    unsigned codepoint = 0;
  };

  Window() = default;
  void InstallCallbacks();
  void InstallInputCallbacks();
  static Window& Of(GLFWwindow* handle);
  void HandOut();
  void OnKey(const Event& event);

  GLFWwindow* handle_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  float content_scale_ = 1.0f;
  bool had_input_ = false;
  bool close_requested_ = false;
  Pointer pointer_;
  // Where the last move that arrived went, whether or not it was handed out.
  bool has_moved_ = false;
  double last_x_ = 0.0;
  double last_y_ = 0.0;
  std::deque<Event> waiting_;
  std::vector<KeyPress> presses_;
  std::vector<std::filesystem::path> dropped_;

  // A key that goes down and up between two polls would never be seen down by the user interface:
  // its release is held back until the next poll.
  std::vector<Event> held_back_;
  std::vector<int> down_this_poll_;
};

}  // namespace ego
