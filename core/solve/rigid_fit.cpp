// SPDX-License-Identifier: MIT
#include "core/solve/rigid_fit.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace ego {
namespace {

using Symmetric4 = std::array<std::array<double, 4>, 4>;

/// Eigenvector of the largest eigenvalue, by cyclic Jacobi rotations.
std::array<double, 4> LargestEigenvector(Symmetric4 a) {
  Symmetric4 vectors{};
  for (std::size_t i = 0; i < 4; ++i) vectors[i][i] = 1.0;
  constexpr int kSweeps = 16;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
        const double c = std::cos(theta);
        const double s = std::sin(theta);
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = a[k][p];
          const double kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double pk = a[p][k];
          const double qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = vectors[k][p];
          const double vq = vectors[k][q];
          vectors[k][p] = c * vp - s * vq;
          vectors[k][q] = s * vp + c * vq;
        }
      }
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (a[i][i] > a[best][best]) best = i;
  }
  return {vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]};
}

}  // namespace

RigidTransform FitRigid(std::span<const Vec3> from, std::span<const Vec3> to) {
  RigidTransform fit;
  if (from.empty()) return fit;
  Vec3 from_mean{0.0};
  Vec3 to_mean{0.0};
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i];
    to_mean += to[i];
  }
  from_mean /= static_cast<double>(from.size());
  to_mean /= static_cast<double>(from.size());
  Mat3 s{0.0};  // s[r][c] = sum of from_r * to_c
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = from[i] - from_mean;
    const Vec3 b = to[i] - to_mean;
    for (int r = 0; r < 3; ++r) s[r] += a[r] * b;
  }
  const Symmetric4 n = {{
      {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
      {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
      {s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
      {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]},
  }};
  const std::array<double, 4> q = LargestEigenvector(n);
  fit.rotation = glm::normalize(Quat{q[0], q[1], q[2], q[3]});
  fit.translation = to_mean - fit.rotation * from_mean;
  return fit;
}

}  // namespace ego
