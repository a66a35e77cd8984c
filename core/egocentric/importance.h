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

/// Importances of one point before normalisation: sum, largest, and the largest with the saturation
/// that counts for gamma (appendix C).
struct ImportanceTotal {
  double epsilon;
  double gamma_epsilon;
  double sum = 0.0;
  double max = 0.0;
  double priority = 0.0;

  /// Adds one and returns it; `gap` between the surfaces in metres.
  double Add(double gap, double orthogonality) { return Add(gap, orthogonality, epsilon); }
  double Add(double gap, double orthogonality, double saturation) {
    const double importance = Proximity(gap, saturation) * orthogonality;
    sum += importance;
    max = std::max(max, importance);
    priority = std::max(priority, Proximity(gap, gamma_epsilon) * orthogonality);
    return importance;
  }
};

}  // namespace ego
