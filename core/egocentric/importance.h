// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace ego {

/// Proximity of appendix A, equation 1: inverse of the distance, saturated at `epsilon` > 0. Both
/// in metres. Where surfaces overlap (distance below zero) it stays saturated.
inline double Proximity(double distance, double epsilon) {
  return 1.0 / std::max(distance, epsilon);
}

/// Orthogonality of appendix A, equation 2: the cosine of normal and displacement, never below
/// `floor`. `along` is their dot product, `distance` the length of the displacement, metres.
/// `softness` (metres) lets the cosine approach one where the distance vanishes, so that a point on
/// the surface has the same value from whichever side it is reached. The published lower branch,
/// cos(epsilon), would give faces that look away full weight; a small floor is meant.
inline double Orthogonality(double along, double distance, double softness, double floor) {
  const double denominator = distance + softness;
  const double cosine = denominator > 1e-12 ? (along + softness) / denominator : 1.0;
  return std::max(cosine, floor);
}

}  // namespace ego
