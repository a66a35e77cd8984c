// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/calibrate/session.h"
#include "app/panels/frame_layout.h"
#include "render/stage_renderer.h"

namespace ego {

/// How the character is shown while it is calibrated.
struct CalibrateLook {
  bool edges = false;  // the mesh's edges over its skin
  bool xray = false;   // see-through skin
  bool crude = false;  // the surfaces that the method works with, over the skin
  bool limbs = true;   // dots and capsules of all limbs, not only of the one that is asked for
};

/// A camera with the rectangle of the window that it fills.
struct Lens {
  Camera camera;
  Rect rect;

  ViewportSize size() const {
    return {static_cast<int>(rect.width), static_cast<int>(rect.height)};
  }
  /// Window pixels; nothing for what lies behind the camera.
  std::optional<Vec2> ToWindow(const Vec3& position_ws) const;
  /// Pixels that a length spans at a place.
  double PixelsOf(double metres, const Vec3& position_ws) const;
  PickCone ConeAt(const Vec2& window_pixel, double radius_pixels) const;
};

/// The picture of the Calibrate workspace: one character, big, and the camera before it.
class CalibrateView {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Camera camera;

  /// Moves the camera there, in a moment that shows the way.
  void GlideTo(const Camera& camera, Time now);
  void StopGlide() { glide_.reset(); }
  /// True while the camera glides.
  bool Advance(Time now);
  bool gliding() const { return glide_.has_value(); }

  /// The whole character from the front.
  Camera WholeCharacter(const CalibrationSession& session, ViewportSize size) const;

  /// Draws into a rectangle of the window's framebuffer.
  void Draw(StageRenderer& renderer, const CalibrationSession& session, const CalibrateLook& look,
            const DrawTarget& target);
  /// The same magnified around a pixel of `lens`, as a picture of this many pixels across.
  Image DrawLoupe(StageRenderer& renderer, const CalibrationSession& session,
                  const CalibrateLook& look, const Lens& loupe);
  /// A small square picture of the character in its canonical pose or as it stands in its file.
  Image DrawSmall(StageRenderer& renderer, const CalibrationSession& session, ShownPose::Kind kind,
                  int side);
  /// What a loupe shows that lies on `rect`: what is around the pixel of `lens`, `zoom` times.
  static Lens LoupeOf(const Lens& lens, const Vec2& window_pixel, const Rect& rect, double zoom);

 private:
  struct Glide {
    Camera from, to;
    Time start;
  };
  struct Mesh {
    CharacterId id;
    std::shared_ptr<const Character> character;
  };
  std::optional<Figure> FigureOf(StageRenderer& renderer, const CalibrationSession& session,
                                 const CalibrateLook& look);

  std::optional<Glide> glide_;
  std::map<std::uint64_t, Mesh> meshes_;  // by avatar
};

}  // namespace ego
