// SPDX-License-Identifier: MIT
#pragma once

struct ImFont;

namespace ego {

class Window;

/// The faces at the window's content scale.
struct GuiFonts {
  ImFont* body = nullptr;     // 15
  ImFont* small = nullptr;    // 13
  ImFont* section = nullptr;  // 18
  ImFont* mono = nullptr;     // 13, for values
};

/// Dear ImGui on a window: its context, the studio's style and fonts, crisp at the content scale.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Begins a frame; rebuilds fonts and style when the content scale changed.
  void Begin();
  /// Ends the frame and draws it over the window's framebuffer.
  void End();

  float scale() const { return scale_; }
  const GuiFonts& fonts() const { return fonts_; }
  /// The one whose frame is being built.
  static const Gui& Current();

 private:
  void Rebuild(float scale);

  Window& window_;
  float scale_ = 0.0f;
  GuiFonts fonts_;
};

}  // namespace ego
