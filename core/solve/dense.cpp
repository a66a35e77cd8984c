// SPDX-License-Identifier: MIT
#include "core/solve/dense.h"

#include <cmath>
#include <limits>

namespace ego {

bool CholeskyInPlace(double* a, std::size_t n, std::size_t stride) {
  bool regular = true;
  for (std::size_t j = 0; j < n; ++j) {
    double* row_j = a + j * stride;
    // Rows are finished one after the other; each row uses only rows above it.
    for (std::size_t k = 0; k < j; ++k) {
      const double* row_k = a + k * stride;
      double sum0 = 0.0;
      double sum1 = 0.0;
      std::size_t i = 0;
      for (; i + 1 < k; i += 2) {
        sum0 += row_j[i] * row_k[i];
        sum1 += row_j[i + 1] * row_k[i + 1];
      }
      if (i < k) sum0 += row_j[i] * row_k[i];
      row_j[k] = (row_j[k] - (sum0 + sum1)) / row_k[k];
    }
    double pivot = row_j[j];
    for (std::size_t i = 0; i < j; ++i) pivot -= row_j[i] * row_j[i];
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
    double sum = x[i];
    for (std::size_t k = 0; k < i; ++k) sum -= row[k] * x[k];
    x[i] = sum / row[i];
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
