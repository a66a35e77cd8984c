// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/model/avatar_calibration.h"
#include "core/model/calibration_point.h"

namespace ego {

/// Undo and redo of a calibration, as far back as memory reaches: a step keeps only what it
/// changed.
class EditHistory {
 public:
  /// Remembers the way from one state to the next; nothing when they are equal. What was undone
  /// before is forgotten.
  void Push(std::string label, const AvatarCalibration& before, const AvatarCalibration& after);

  bool CanUndo() const { return at_ > 0; }
  bool CanRedo() const { return at_ < steps_.size(); }
  std::string UndoLabel() const { return CanUndo() ? steps_[at_ - 1].label : std::string(); }
  std::string RedoLabel() const { return CanRedo() ? steps_[at_].label : std::string(); }
  /// Brings `state`, which must be the one that the history stands at, one step back or forth.
  void Undo(AvatarCalibration& state);
  void Redo(AvatarCalibration& state);

 private:
  template <class Key, class Value>
  struct Change {
    Key key;
    Value before;
    Value after;
  };
  struct Step {
    std::string label;
    std::vector<Change<PointId, CalibrationPoint>> points;  // no dots
    std::vector<Change<LimbSegment, SegmentCalibration>> segments;
    std::array<double, 2> half_thickness_before{};
    std::array<double, 2> half_thickness_after{};
    std::vector<Change<std::size_t, std::optional<int>>> joints;
  };

  std::vector<Step> steps_;
  std::size_t at_ = 0;  // steps before this one are done
};

}  // namespace ego
