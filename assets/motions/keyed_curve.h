// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace ego {

/// The curve through keys that motions move on: between the second and the third of four keys a
/// quintic without acceleration at either. Its speed at a key is the weighted harmonic mean of the
/// slopes around it, zero where they differ in sign or one of them is zero (Fritsch and Butland
/// 1984): it rests where a value is held, turns without overshoot and passes through the other keys
/// without stopping.
struct KeyedCurve {
  std::array<double, 4> time{};  // seconds; equal neighbours mean rest at the inner one
  double now = 0.0;              // between time[1] and time[2]

  double At(const std::array<double, 4>& value) const {
    const double h = time[2] - time[1];
    if (h <= 0.0) return value[1];
    const double u = (now - time[1]) / h;
    const double u3 = u * u * u;
    const double slope = (value[2] - value[1]) / h;
    const double v1 = Speed(time[1] - time[0], value[1] - value[0], h, slope);
    const double v2 = Speed(time[3] - time[2], value[3] - value[2], h, slope);
    return value[1] + (value[2] - value[1]) * u3 * (10.0 - u * (15.0 - 6.0 * u)) +
           h * v1 * (u - u3 * (6.0 - u * (8.0 - 3.0 * u))) +
           h * v2 * u3 * (-4.0 + u * (7.0 - 3.0 * u));
  }

  /// `At` for anything that lists its numbers.
  template <std::size_t N>
  std::array<double, N> At(const std::array<std::array<double, N>, 4>& values) const {
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) {
      result[i] = At(std::array<double, 4>{values[0][i], values[1][i], values[2][i], values[3][i]});
    }
    return result;
  }

 private:
  static double Speed(double h0, double step, double h1, double d1) {
    if (h0 <= 0.0) return 0.0;
    const double d0 = step / h0;
    if (d0 * d1 <= 0.0) return 0.0;
    const double w0 = 2.0 * h1 + h0;
    const double w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  }
};

}  // namespace ego
