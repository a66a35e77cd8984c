// SPDX-License-Identifier: MIT
#include "core/solve/pose_gaps.h"

#include <array>
#include <cstddef>

namespace ego {
namespace {

/// Calls fill(frame, before, after, t) for each frame that is not known; t runs from 0 at
/// `before` to 1 at `after`. At an end of the take both are the one known neighbour.
template <class Known, class Fill>
void ForEachGap(std::size_t frames, Known known, Fill fill) {
  std::size_t next = 0;
  bool any = false;
  std::size_t before = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    if (known(f)) {
      before = f;
      any = true;
      continue;
    }
    if (next <= f) {
      next = f;
      while (next < frames && !known(next)) ++next;
    }
    if (!any && next == frames) return;
    if (!any) {
      fill(f, next, next, 0.0);
    } else if (next == frames) {
      fill(f, before, before, 0.0);
    } else {
      fill(f, before, next, static_cast<double>(f - before) / static_cast<double>(next - before));
    }
  }
}

}  // namespace

std::vector<std::uint8_t> ObservedJoints(const MarkerModel& model, const MarkerTake& take) {
  std::vector<std::uint8_t> observed(take.frame_count * kJointCount, 0);
  for (std::size_t f = 0; f < take.frame_count; ++f) {
    const MarkerFrame frame = take.Frame(f);
    std::uint8_t* row = observed.data() + f * kJointCount;
    for (const BoundMarker& marker : model.markers) {
      if (!frame.visible[marker.label]) continue;
      for (std::size_t j = Index(marker.joint);; j = Index(kParent[j])) {
        row[j] = 1;
        if (j == 0) break;
      }
    }
  }
  return observed;
}

void FillGaps(std::span<const std::uint8_t> observed, std::span<const std::uint8_t> solved,
              std::span<Pose> poses) {
  const std::size_t frames = poses.size();
  ForEachGap(
      frames, [&](std::size_t f) { return solved[f] != 0; },
      [&](std::size_t f, std::size_t before, std::size_t after, double t) {
        poses[f].root_ws = glm::mix(poses[before].root_ws, poses[after].root_ws, t);
      });
  for (std::size_t j = 0; j < kJointCount; ++j) {
    ForEachGap(
        frames, [&](std::size_t f) { return solved[f] != 0 && observed[f * kJointCount + j] != 0; },
        [&](std::size_t f, std::size_t before, std::size_t after, double t) {
          poses[f].rotation_ls[j] = glm::normalize(
              glm::slerp(poses[before].rotation_ls[j], poses[after].rotation_ls[j], t));
        });
    // A joint that no marker of the set watches keeps the solver's neutral guess, but a frame
    // that was not solved has none.
    bool ever = false;
    for (std::size_t f = 0; f < frames && !ever; ++f) ever = observed[f * kJointCount + j] != 0;
    if (ever) continue;
    ForEachGap(
        frames, [&](std::size_t f) { return solved[f] != 0; },
        [&](std::size_t f, std::size_t before, std::size_t after, double t) {
          poses[f].rotation_ls[j] = glm::normalize(
              glm::slerp(poses[before].rotation_ls[j], poses[after].rotation_ls[j], t));
        });
  }
}

}  // namespace ego
