// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/body/body.h"
#include "core/markers/marker_take.h"
#include "core/pipeline/captured_motion.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Who is on stage: a performer's motion and the bodies that follow it. Immutable and shared, so
/// that a frame can name the scene it was made of while the next scene is already playing.
struct StageScene {
  std::shared_ptr<const CapturedMotion> motion;  // never null; may have no frame
  struct Avatar {
    std::uint64_t id = 0;              // the caller's own; to find what is drawn for it
    std::shared_ptr<const Body> body;  // never null
  };
  std::vector<Avatar> avatars;
};

/// How long the steps of a frame took lately, microseconds of wall time.
struct StepTime {
  double p50_us = 0.0;
  double p99_us = 0.0;
};
struct StageTimings {
  StepTime solve;      // markers to the performer's pose; zero when the take was solved before
  StepTime normalize;  // RetargetMethod::SetPerformerPose
  StepTime adapt;      // RetargetMethod::Adapt, all avatars together
  StepTime frame;      // everything from the command check to the publication
};

/// All that is to be drawn of one instant. World space, metres; avatars stand where their own
/// motion puts them (the drawer sets them side by side).
struct StageFrame {
  std::shared_ptr<const StageScene> scene;  // null until the first scene
  std::size_t frame = 0;                    // of the take
  double time_s = 0.0;                      // frame / rate
  bool playing = false;

  Pose performer_pose;
  ModelPose performer;
  /// The take's markers of this frame, heights corrected by the take's floor offset; empty for
  /// skeleton motions.
  std::vector<Vec3> marker_ws;
  std::vector<std::uint8_t> marker_visible;

  struct Avatar {
    Pose pose;
    ModelPose model;
  };
  std::vector<Avatar> avatars;  // in the scene's order

  StageTimings timings;
  std::uint64_t sequence = 0;       // counts the frames made, without a gap
  std::uint64_t commands_done = 0;  // commands carried out before this frame was made
  std::uint64_t frames_missed = 0;  // frames of the take left out because the thread was late
};

}  // namespace ego
