// SPDX-License-Identifier: MIT
#include "app/stage/frame_maker.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"

namespace ego {
namespace {

void CopyMarkers(const CapturedMotion& motion, std::size_t frame, StageFrame& out) {
  if (!motion.markers || frame >= motion.markers->frame_count) {
    out.marker_ws.clear();
    out.marker_visible.clear();
    return;
  }
  const MarkerFrame markers = motion.markers->Frame(frame);
  out.marker_ws.assign(markers.position_ws.begin(), markers.position_ws.end());
  out.marker_visible.assign(markers.visible.begin(), markers.visible.end());
  for (Vec3& p : out.marker_ws) p.y += motion.floor_offset;
}

}  // namespace

FrameMaker::FrameMaker() : method_(MakeRetargetMethod(RetargetMethodNames().front())) {
  EGO_CHECK(method_ != nullptr);
}

void FrameMaker::SetScene(std::shared_ptr<const StageScene> scene) {
  EGO_CHECK(!scene || scene->motion);
  scene_ = std::move(scene);
  normalize_.Clear();
  adapt_.Clear();
}

bool FrameMaker::SetMethod(std::string_view name) {
  std::unique_ptr<RetargetMethod> method = MakeRetargetMethod(name);
  if (!method) return false;
  method_ = std::move(method);
  normalize_.Clear();
  adapt_.Clear();
  return true;
}

std::size_t FrameMaker::frame_count() const { return scene_ ? scene_->motion->poses.size() : 0; }

void FrameMaker::Make(std::size_t frame, StageFrame& out) {
  if (frame_count() == 0) return;
  const CapturedMotion& motion = *scene_->motion;
  frame = std::min(frame, motion.poses.size() - 1);
  out.scene = scene_;
  out.frame = frame;
  out.time_s = motion.rate_hz > 0.0 ? static_cast<double>(frame) / motion.rate_hz : 0.0;
  out.performer_pose = motion.poses[frame];
  out.performer = ForwardKinematics(motion.performer.skeleton, out.performer_pose);
  CopyMarkers(motion, frame, out);

  const auto start = StepClock::Clock::now();
  method_->SetPerformerPose(motion.performer, out.performer_pose);
  const auto normalized = StepClock::Clock::now();
  out.avatars.resize(scene_->avatars.size());
  for (std::size_t i = 0; i < out.avatars.size(); ++i) {
    const Body& body = *scene_->avatars[i].body;
    method_->Adapt(body, out.avatars[i].pose);
    out.avatars[i].model = ForwardKinematics(body.skeleton, out.avatars[i].pose);
  }
  const auto adapted = StepClock::Clock::now();
  normalize_.Add(normalized - start);
  adapt_.Add(adapted - normalized);
  out.timings.normalize = normalize_.Summary();
  out.timings.adapt = adapt_.Summary();
}

}  // namespace ego
