// SPDX-License-Identifier: MIT
#include "assets/calibration/edit_history.h"

namespace ego {

void EditHistory::Push(std::string label, const AvatarCalibration& before,
                       const AvatarCalibration& after) {
  if (before == after) return;
  Step step;
  step.label = std::move(label);
  for (const PointId id : PickOrder()) {
    const CalibrationPoint& old_point = *Find(before, id);
    const CalibrationPoint& new_point = *Find(after, id);
    if (!(old_point == new_point)) step.points.push_back({id, old_point, new_point});
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    if (before.segment[s] == after.segment[s]) continue;
    step.segments.push_back({static_cast<LimbSegment>(s), before.segment[s], after.segment[s]});
  }
  for (std::size_t side = 0; side < 2; ++side) {
    step.half_thickness_before[side] = before.hand[side].half_thickness;
    step.half_thickness_after[side] = after.hand[side].half_thickness;
  }
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (before.joint_override[j] == after.joint_override[j]) continue;
    step.joints.push_back({j, before.joint_override[j], after.joint_override[j]});
  }
  steps_.resize(at_);
  steps_.push_back(std::move(step));
  ++at_;
}

void EditHistory::Undo(AvatarCalibration& state) {
  if (!CanUndo()) return;
  const Step& step = steps_[--at_];
  for (const auto& change : step.points) *Find(state, change.key) = change.before;
  for (const auto& change : step.segments) state.At(change.key) = change.before;
  for (const auto& change : step.joints) state.joint_override[change.key] = change.before;
  for (std::size_t side = 0; side < 2; ++side) {
    state.hand[side].half_thickness = step.half_thickness_before[side];
  }
}

void EditHistory::Redo(AvatarCalibration& state) {
  if (!CanRedo()) return;
  const Step& step = steps_[at_++];
  for (const auto& change : step.points) *Find(state, change.key) = change.after;
  for (const auto& change : step.segments) state.At(change.key) = change.after;
  for (const auto& change : step.joints) state.joint_override[change.key] = change.after;
  for (std::size_t side = 0; side < 2; ++side) {
    state.hand[side].half_thickness = step.half_thickness_after[side];
  }
}

}  // namespace ego
