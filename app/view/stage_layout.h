// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/pipeline/captured_motion.h"

namespace ego {

/// Where everyone stands on stage beside one another while a motion plays.
///
/// A motion may walk through a whole room, and each body by its own measure. So that nobody walks
/// into anybody, the figures stand in a line that travels with the performer: the anchor is the
/// performer's smoothed way over the ground (a constant for motions that stay in place), and each
/// figure's own anchor is put at its place in the line. The line lies square to the way the
/// performer mostly faces, so that "front" shows faces whatever way the take's room was set up.
class StageLayout {
 public:
  /// Beside each other as seen from the performer's front (first figure at the left) or as seen
  /// from the performer's left side.
  enum class Line { kSideways, kDepthwise };

  explicit StageLayout(const CapturedMotion& motion);

  /// Middle of the line on the ground, world space, y = 0. Clamped to the motion's frames.
  Vec3 Anchor(std::size_t frame) const;

  /// Angle about Y from +Z to the way the performer mostly faces, radians: the mean direction of
  /// the hips over the motion, or that of the first frame when the performer turns all around.
  double heading() const { return heading_; }

  struct Member {
    double height = 0.0;  // metres
    double girth = 0.0;   // metres: half its breadth beyond that of a slim adult of its height
    double scale = 1.0;   // of its root path, relative to the performer's
  };
  /// Writes for each figure, in the order of the line, what to add to its own positions.
  void Place(std::size_t frame, Line line, std::span<const Member> members,
             std::span<Vec3> offset_ws) const;

 private:
  std::vector<Vec2> anchor_;  // x and z; one entry when constant
  double heading_ = 0.0;
  double reach_sideways_ = 0.0;  // how far limbs reach from the anchor, shares of height
  double reach_depthwise_ = 0.0;
};

}  // namespace ego
