// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace ego {

/// How the fingers of a hand are bent away from the canonical, flat hand. Free of the hand's size
/// and of how its rig is built: what any hand with fingers can be given.
struct HandShape {
  /// Radians, positive towards the palm; a thumb's towards the other side of the palm.
  struct Digit {
    double bend = 0.0;  // at the knuckle; a thumb is laid under the palm
    double curl = 0.0;  // at the middle joint; the outer one takes two thirds of it

    friend bool operator==(const Digit&, const Digit&) = default;
  };
  static constexpr std::size_t kDigits = 5;
  std::array<Digit, kDigits> digit{};  // thumb, index, middle, ring, little

  friend bool operator==(const HandShape&, const HandShape&) = default;
};

/// The outer joint of a finger follows the middle one: the share that hand models use
/// (Rijpkema and Girard, Computer animation of knowledge-based human grasping, 1991).
inline constexpr double kOuterJointShare = 2.0 / 3.0;

}  // namespace ego
