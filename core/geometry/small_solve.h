// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace ego {

/// A symmetric positive definite system of a fixed small size, grown row by row: the normal
/// equations of weighted least squares.
template <std::size_t N>
struct NormalEquations {
  std::array<std::array<double, N>, N> matrix{};
  std::array<double, N> right{};

  /// Adds weight * (row . x - value)^2.
  void Add(const std::array<double, N>& row, double value, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      const double scaled = weight * row[i];
      for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += scaled * row[j];
      right[i] += scaled * value;
    }
  }
  /// Adds weight * x_i^2.
  void Damp(std::size_t i, double weight) { matrix[i][i] += weight; }

  /// The minimum, by Cholesky's factorisation. Every unknown must be damped.
  std::array<double, N> Solve() const {
    std::array<std::array<double, N>, N> l{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
        l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
      }
    }
    std::array<double, N> x = right;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
      x[i] /= l[i][i];
    }
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) x[i] -= l[k][i] * x[k];
      x[i] /= l[i][i];
    }
    return x;
  }
};

}  // namespace ego
