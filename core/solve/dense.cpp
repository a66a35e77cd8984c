// SPDX-License-Identifier: MIT
#include "core/solve/dense.h"

#include <cmath>
#include <limits>

namespace ego {
namespace {

/// Eight sums side by side: one alone would wait for itself at every term.
double Dot(const double* a, const double* b, std::size_t n) {
  double sum[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (std::size_t k = 0; i + k < n; ++k) sum[k] += a[i + k] * b[i + k];
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

}  // namespace

bool CholeskyInPlace(double* a, std::size_t n, std::size_t stride) {
  bool regular = true;
  for (std::size_t j = 0; j < n; ++j) {
    double* row_j = a + j * stride;
    // Rows are finished one after the other; each row uses only rows above it.
    for (std::size_t k = 0; k < j; ++k) {
      const double* row_k = a + k * stride;
      row_j[k] = (row_j[k] - Dot(row_j, row_k, k)) / row_k[k];
    }
    const double pivot = row_j[j] - Dot(row_j, row_j, j);
    if (pivot > 0.0) {
      row_j[j] = std::sqrt(pivot);
    } else {
      row_j[j] = std::numeric_limits<double>::infinity();
      regular = false;
    }
  }
  return regular;
}

void SolveLower(const double* l, std::size_t n, std::size_t stride, double* x) {
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = l + i * stride;
    x[i] = (x[i] - Dot(row, x, i)) / row[i];
  }
}

void SolveLowerTransposed(const double* l, std::size_t n, std::size_t stride, double* x) {
  for (std::size_t i = n; i-- > 0;) {
    const double* row = l + i * stride;
    x[i] /= row[i];
    for (std::size_t k = 0; k < i; ++k) x[k] -= row[k] * x[i];
  }
}

void SolveLowerMany(const double* l, std::size_t n, std::size_t stride, double* x,
                    std::size_t columns) {
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = l + i * stride;
    double* x_i = x + i * columns;
    for (std::size_t k = 0; k < i; ++k) {
      const double factor = row[k];
      if (factor == 0.0) continue;
      const double* x_k = x + k * columns;
      for (std::size_t c = 0; c < columns; ++c) x_i[c] -= factor * x_k[c];
    }
    const double inverse = 1.0 / row[i];
    for (std::size_t c = 0; c < columns; ++c) x_i[c] *= inverse;
  }
}

void SubtractGram(double* a, std::size_t stride, const double* y, std::size_t rows,
                  std::size_t columns) {
  for (std::size_t r = 0; r < rows; ++r) {
    const double* y_r = y + r * columns;
    for (std::size_t i = 0; i < columns; ++i) {
      const double factor = y_r[i];
      if (factor == 0.0) continue;
      double* a_i = a + i * stride;
      for (std::size_t k = 0; k <= i; ++k) a_i[k] -= factor * y_r[k];
    }
  }
}

}  // namespace ego
