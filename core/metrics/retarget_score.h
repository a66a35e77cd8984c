// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// What counts as a contact, a stance and a step; lengths at a height of 1.78 m, scaled with the
/// body.
struct ScoreSettings {
  double contact_gap = 0.015;    // metres: the performer touches below this gap
  double contact_depth = 0.010;  // metres: deeper is a wrong surface, not a contact
  double reached_gap = 0.01;     // share of height: a contact is recalled within this error
  double stance_height = 0.025;  // metres: a sole below this stands ...
  double stance_speed = 0.15;    // ... if slower than this, metres per second
};

/// Mean, largest and count of a quantity.
struct Statistic {
  double sum = 0.0;
  double max = 0.0;
  std::size_t count = 0;
  void Add(double value) {
    sum += value;
    max = count == 0 || value > max ? value : max;
    ++count;
  }
  double Mean() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

/// How well a kind of contact was kept: gaps are the difference of the avatar's and the
/// performer's surface gap, each in shares of its own height, absolute.
struct ContactScore {
  Statistic gap_error;       // shares of height
  std::size_t recalled = 0;  // contacts whose error stays below `reached_gap`
  /// The same where the avatar's arm can bring the point to its place in any posture at all
  /// (CanTouch); the others no method can keep.
  Statistic reachable_gap_error;
  std::size_t reachable_recalled = 0;
  /// 1 when there was nothing to keep.
  double Recall() const {
    return gap_error.count == 0
               ? 1.0
               : static_cast<double>(recalled) / static_cast<double>(gap_error.count);
  }
  /// The same among the reachable ones.
  double ReachableRecall() const {
    return reachable_gap_error.count == 0 ? 1.0
                                          : static_cast<double>(reachable_recalled) /
                                                static_cast<double>(reachable_gap_error.count);
  }
};

/// The score of one performer's motion on one avatar, grown frame by frame. A plain value:
/// construct one per avatar, `Accumulate` every frame in order, read it whenever wanted.
///
/// Measured with the surfaces of both bodies and nothing of the method: the gap of a point is its
/// distance to the nearest of trunk mesh, head mesh and the capsules of the other limbs, negative
/// inside a mesh or capsule.
struct RetargetScore {
  ContactScore wrist;  // the hand joint, thinner by the hand's half thickness
  ContactScore palm;
  ContactScore fingertip;
  Statistic arm_penetration;        // shares of height: arm capsules in trunk and head, beyond the
                                    // performer's own; one value per arm and frame
  Statistic foot_height_error;      // shares of height, stance frames
  Statistic foot_slide;             // shares of height per second beyond the performer's, same
  double largest_step = 0.0;        // radians: any joint's world rotation, from frame to frame
  double largest_added_step = 0.0;  // radians: the same, less the performer's step of that joint
  std::size_t largest_step_frame = 0;
  std::size_t largest_added_step_frame = 0;
  std::size_t frames = 0;

  // The previous frame, for steps and speeds.
  ModelPose last_performer;
  ModelPose last_avatar;
};

/// Adds one frame. `rate_hz` is the take's rate, above zero.
void Accumulate(const Body& performer, const Pose& performer_pose, const Body& avatar,
                const Pose& avatar_pose, double rate_hz, const ScoreSettings& settings,
                RetargetScore& score);

}  // namespace ego
