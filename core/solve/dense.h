// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ego {

// Dense symmetric systems as the solver needs them. Matrices are row-major in the caller's memory,
// `stride` doubles from row to row; only the lower triangle of a symmetric matrix is read.

/// A = L L^T in place (lower triangle). A pivot that is not positive (a singular direction) is
/// replaced by infinity: that unknown gets the answer zero. Returns false when that happened.
bool CholeskyInPlace(double* a, std::size_t n, std::size_t stride);

/// x := L^-1 x.
void SolveLower(const double* l, std::size_t n, std::size_t stride, double* x);

/// x := L^-T x.
void SolveLowerTransposed(const double* l, std::size_t n, std::size_t stride, double* x);

/// X := L^-1 X for a matrix of `columns` right-hand sides, row-major, contiguous.
void SolveLowerMany(const double* l, std::size_t n, std::size_t stride, double* x,
                    std::size_t columns);

/// A := A - Y^T Y (lower triangle of A, order `columns`), Y with `rows` rows, contiguous.
void SubtractGram(double* a, std::size_t stride, const double* y, std::size_t rows,
                  std::size_t columns);

}  // namespace ego
