// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "app/stage/step_clock.h"
#include "core/baselines/retarget_method.h"
#include "core/pipeline/stage_frame.h"

namespace ego {

/// One frame of a scene in, the postures of everyone in it out. Knows no thread and no clock but
/// the one that measures its steps; what it makes of a frame depends on the scene, the method and
/// the frame alone.
class FrameMaker {
 public:
  /// Starts with the default method and no scene.
  FrameMaker();

  void SetScene(std::shared_ptr<const StageScene> scene);
  const std::shared_ptr<const StageScene>& scene() const { return scene_; }

  /// False, and nothing changes, when there is no method of that name.
  bool SetMethod(std::string_view name);
  std::string_view method_name() const { return method_->name(); }

  /// Number of frames of the scene's motion; zero without a scene.
  std::size_t frame_count() const;

  /// Fills the scene, frame, time, performer, markers, avatars and step times of `out`; the rest
  /// stays. The frame is clamped to the motion; nothing happens when that is empty. Allocates
  /// nothing once `out` has held a frame of the same scene.
  void Make(std::size_t frame, StageFrame& out);

 private:
  std::shared_ptr<const StageScene> scene_;
  std::unique_ptr<RetargetMethod> method_;
  StepClock normalize_;
  StepClock adapt_;
};

}  // namespace ego
