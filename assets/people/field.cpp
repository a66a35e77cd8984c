// SPDX-License-Identifier: MIT
#include "assets/people/field.h"

#include "core/base/check.h"

namespace ego::field {

Profile::Profile(std::vector<Vec2> points) : point_(std::move(points)) {
  EGO_CHECK(point_.size() >= 2);
  const std::size_t n = point_.size();
  std::vector<double> width(n - 1);
  std::vector<double> secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    width[i] = point_[i + 1].x - point_[i].x;
    EGO_CHECK(width[i] > 0.0);
    secant[i] = (point_[i + 1].y - point_[i].y) / width[i];
  }
  slope_.assign(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secant[i - 1] * secant[i] <= 0.0) continue;
    const double w1 = 2.0 * width[i] + width[i - 1];
    const double w2 = width[i] + 2.0 * width[i - 1];
    slope_[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
  }
}

double Profile::operator()(double x) const {
  if (x <= point_.front().x) return point_.front().y;
  if (x >= point_.back().x) return point_.back().y;
  std::size_t i = 0;
  while (x > point_[i + 1].x) ++i;
  const double h = point_[i + 1].x - point_[i].x;
  const double t = (x - point_[i].x) / h;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * point_[i].y + t * h * slope_[i]) +
         t * t * ((1.0 + 2.0 * s) * point_[i + 1].y - s * h * slope_[i + 1]);
}

double Superellipse(double x, double z, double half_width, double half_depth, double exponent) {
  const double q = std::pow(
      std::pow(std::abs(x) / half_width, exponent) + std::pow(std::abs(z) / half_depth, exponent),
      1.0 / exponent);
  if (q < 1e-6) return -std::min(half_width, half_depth);
  return std::sqrt(x * x + z * z) * (1.0 - 1.0 / q);
}

}  // namespace ego::field
