// SPDX-License-Identifier: MIT
#pragma once

namespace ego {

/// A rectangle of the window, pixels, origin at the top left.
struct Rect {
  float x = 0.0f;
  float y = 0.0f;
  float width = 0.0f;
  float height = 0.0f;
};

/// How the window is divided: sizes at scale 1 as the user left them, and what is folded away.
struct FrameLayout {
  float left = 280.0f;
  float right = 320.0f;
  float timeline = 140.0f;
  bool show_left = true;
  bool show_right = true;
  bool show_timeline = true;

  // Where everything is, in pixels; written by Divide.
  Rect bar;
  Rect left_rail;
  Rect viewport;
  Rect inspector;
  Rect timeline_panel;
  Rect status;

  /// Divides a window of this size. Panels give way before the viewport does.
  void Divide(float window_width, float window_height, float scale);
  /// Folds everything away, or brings everything back when anything is folded.
  void ToggleAll();
};

}  // namespace ego
