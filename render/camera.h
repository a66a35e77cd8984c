// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "core/base/math.h"

namespace ego {

/// Size of a picture in pixels. Pixel coordinates have their origin at the top left corner, x to
/// the right and y down; the centre of the first pixel is (0.5, 0.5).
struct ViewportSize {
  int width = 0;
  int height = 0;
};

/// An axis-aligned box, world space, metres. Empty until a point is added.
struct Box3 {
  Vec3 min{1e300};
  Vec3 max{-1e300};

  bool IsEmpty() const { return !(min.x <= max.x); }
  void Add(const Vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void Add(const Box3& box) {
    if (box.IsEmpty()) return;
    Add(box.min);
    Add(box.max);
  }
  Vec3 Center() const { return 0.5 * (min + max); }
};

/// The views that keys 1, 3 and 7 give, and the one that a stage opens with.
enum class StandardView { kThreeQuarter, kFront, kSide, kTop };

/// A camera on an orbit around a target, never rolled. A value: what the user does makes a new
/// state of it; drawing only reads it. Angles in radians.
struct Camera {
  /// Vertical field of view of a 35 mm lens on 36 x 24 mm.
  static constexpr double kLens35 = 0.66027;

  Vec3 target_ws{0.0, 0.95, 0.0};
  double yaw = 0.34;       // 0: before the stage, looking along -Z; positive: from the left (+X)
  double pitch = 0.10;     // positive: from above, within +-pi/2
  double distance = 5.0;   // from the target, metres
  double fov_y = kLens35;  // of the picture's height

  Vec3 Position() const;
  /// Unit vectors of the picture in world space; Forward points from the camera to the target.
  Vec3 Right() const;
  Vec3 Up() const;
  Vec3 Forward() const;

  /// World to view space: x right, y up, looking along -z.
  Mat4 View() const;
  /// View to clip space, OpenGL's convention. The near and far plane follow the distance.
  Mat4 Projection(ViewportSize size) const;
  double Near() const;
  double Far() const;

  /// Pixel of a world point and its distance along Forward (metres); nothing for points behind
  /// the near plane or an empty viewport.
  std::optional<Vec3> Project(const Vec3& point_ws, ViewportSize size) const;
  /// Unit direction, world space, from Position() through a pixel.
  Vec3 RayThrough(const Vec2& pixel, ViewportSize size) const;
  /// Metres that one pixel spans at the target's distance.
  double MetresPerPixel(ViewportSize size) const;

  /// Turns around the target by a mouse drag in pixels: a drag across the whole height is half a
  /// turn. The pitch stops at the poles.
  void Orbit(const Vec2& drag, ViewportSize size);
  /// Moves the target with the mouse: what is under the pointer at the target's distance stays
  /// under it.
  void Pan(const Vec2& drag, ViewportSize size);
  /// One step of the wheel is 12 %; positive steps come closer. What is under the cursor at the
  /// target's distance stays there.
  void Zoom(double steps, const Vec2& cursor, ViewportSize size);

  /// Keeps the direction and moves so that the whole box is in the picture with this margin on
  /// every side, as a share of the picture. An empty box changes nothing.
  void Frame(const Box3& box, ViewportSize size, double margin = 0.08);
  /// Keeps the target and the distance and looks from a standard direction.
  void Look(StandardView view);
};

}  // namespace ego
