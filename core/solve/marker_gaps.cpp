// SPDX-License-Identifier: MIT
#include "core/solve/marker_gaps.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

constexpr double kMemory = 0.3;  // after which a predictor's error is another, seconds

/// What one end of a gap shows: how far off a predictor is there, in its own frame.
struct End {
  bool known = false;
  Vec3 error{0.0};
};

struct Bridge {
  double before = 0.0;    // weight of the error before the gap
  double after = 0.0;     // and after it
  double variance = 1.0;  // of what is left, relative
};

/// Mean and variance of an Ornstein-Uhlenbeck process at time t of a gap of this length.
Bridge BridgeAt(const End& before, const End& after, double t, double length) {
  const auto decay = [](double time) { return std::exp(-time / kMemory); };
  const double from_before = decay(t);
  const double from_after = decay(length - t);
  if (before.known && after.known) {
    const double whole = 1.0 - decay(2.0 * length);
    const double a = from_before * (1.0 - decay(2.0 * (length - t))) / whole;
    const double b = from_after * (1.0 - decay(2.0 * t)) / whole;
    return {a, b, 1.0 - a * from_before - b * from_after};
  }
  if (before.known) return {from_before, 0.0, 1.0 - from_before * from_before};
  if (after.known) return {0.0, from_after, 1.0 - from_after * from_after};
  return {};
}

End EndAt(const MarkerPredictor& predictor, const MarkerFrame& frame) {
  const auto told = predictor.Predict(frame);
  if (!told) return {};
  const Vec3 error = frame.position_ws[predictor.label()] - told->position_ws;
  return {true, glm::conjugate(told->frame_ws) * error};
}

}  // namespace

FilledTake::FilledTake(const MarkerTake& take, std::span<const MarkerPredictor> predictors)
    : take_(take),
      position_ws_(take.position_ws),
      visible_(take.visible),
      told_sigma_(take.visible.size(), 0.0) {
  const std::size_t labels = take.labels.size();
  // Sums over a marker's predictors, until the marker's last one is done.
  std::vector<Vec3> position(take.frame_count, Vec3{0.0});
  std::vector<double> sigma(take.frame_count, 0.0);
  std::vector<double> total(take.frame_count, 0.0);
  for (std::size_t p = 0; p < predictors.size(); ++p) {
    const MarkerPredictor& predictor = predictors[p];
    const std::size_t label = predictor.label();
    const auto seen = [&](std::size_t f) { return take.visible[f * labels + label] != 0; };
    for (std::size_t begin = 0; begin < take.frame_count; ++begin) {
      if (seen(begin)) continue;
      std::size_t end = begin;
      while (end < take.frame_count && !seen(end)) ++end;
      const End before = begin > 0 ? EndAt(predictor, take.Frame(begin - 1)) : End{};
      const End after = end < take.frame_count ? EndAt(predictor, take.Frame(end)) : End{};
      const double length = static_cast<double>(end + 1 - begin) / take.rate_hz;
      for (std::size_t f = begin; f < end; ++f) {
        const auto told = predictor.Predict(take.Frame(f));
        if (!told) continue;
        const double t = static_cast<double>(f + 1 - begin) / take.rate_hz;
        const Bridge bridge = BridgeAt(before, after, t, length);
        const Vec3 error = bridge.before * before.error + bridge.after * after.error;
        const double left = std::max(kLeastToldSigma, told->sigma * std::sqrt(bridge.variance));
        const double weight = 1.0 / (left * left);
        position[f] += weight * (told->position_ws + told->frame_ws * error);
        sigma[f] += weight * left;
        total[f] += weight;
      }
      begin = end;
    }
    if (p + 1 < predictors.size() && predictors[p + 1].label() == label) continue;
    for (std::size_t f = 0; f < take.frame_count; ++f) {
      if (total[f] > 0.0) {
        position_ws_[f * labels + label] = position[f] / total[f];
        visible_[f * labels + label] = 1;
        told_sigma_[f * labels + label] = sigma[f] / total[f];
      }
      position[f] = Vec3{0.0};
      sigma[f] = 0.0;
      total[f] = 0.0;
    }
  }
}

MarkerFrame FilledTake::Frame(std::size_t index) const {
  const std::size_t n = take_.labels.size();
  MarkerFrame frame = take_.Frame(index);
  frame.position_ws = std::span(position_ws_).subspan(index * n, n);
  frame.visible = std::span(visible_).subspan(index * n, n);
  frame.told_sigma = std::span(told_sigma_).subspan(index * n, n);
  return frame;
}

}  // namespace ego
