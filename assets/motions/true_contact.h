// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/motions/motion_script.h"
#include "core/skeleton/humanoid.h"

namespace ego {

/// What is known about one touch of a scripted motion: which face of which hand or foot lies on
/// which place of the skin or on a plate, and when.
struct TrueContact {
  double from_s = 0.0;
  double to_s = 0.0;     // equal to `from_s` for a touch that lasts an instant
  std::size_t side = 0;  // 0: left hand or foot; 1: right
  bool foot = false;
  TouchFace face = TouchFace::kPalm;
  HumanoidJoint of = HumanoidJoint::kLeftHand;  // the joint that carries the face
  HumanoidJoint on = HumanoidJoint::kChest;     // the joint of the part that is touched
  /// Not skin but a level plate is touched, its surface this high; `on` and `places` say nothing.
  std::optional<double> plate_ws;
  /// The place at instants of the contact; more than one where the face slides.
  struct Instant {
    double time = 0.0;
    BodyPlace place;
  };
  std::vector<Instant> places;

  /// "left palm on the right forearm", "right fingertips on the navel".
  std::string Sentence() const;
  bool Slides() const;
};

/// Where the place of a contact is at an instant within it: slid linearly in eased time, as the
/// player does.
BodyPlace PlaceAt(const TrueContact& contact, double time);

}  // namespace ego
