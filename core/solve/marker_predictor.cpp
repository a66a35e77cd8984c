// SPDX-License-Identifier: MIT
#include "core/solve/marker_predictor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/solve/dense.h"
#include "core/solve/rigid_fit.h"

namespace ego {
namespace {

// Fewer frames than this tell a place, but not how it moves.
constexpr std::size_t kMinFrames = 10;
// Rounds of the mean shape of all frames (generalised Procrustes).
constexpr int kShapeRounds = 3;
// Blocks of neighbouring frames, every fourth left out at a time, tell how well a marker that was
// lost for a while can be told.
constexpr std::size_t kBlocks = 12;
constexpr std::size_t kFolds = 4;
// Of the kernel, relative to the features' spread, and its noise relative to the signal. A search
// for the best of nine pairs per marker told no better.
constexpr double kLength = 1.5;
constexpr double kNoise = 1e-2;
constexpr double kLeastSpread = 0.001;
constexpr double kMostSigma = 0.02;  // what is less sure than this does more harm than good
// Seen this far from where the fitted posture takes it, a marker is not the one its label says.
constexpr double kWrong = 0.08;
// Candidates for neighbours, nearest first. Three choices: all the nearest, and two that share
// none of these, so that each has no use for what another lacks.
constexpr std::size_t kCandidates = 9;
constexpr std::array<std::array<std::size_t, MarkerPredictor::kNeighbours>, 3> kChoices = {
    {{0, 1, 2, 3, 4, 5}, {0, 2, 4, 6, 7, 8}, {1, 3, 5, 6, 7, 8}}};

/// How much the distance of two markers changes, with a little for how far apart they are. Nothing
/// where they are seldom seen together.
std::optional<double> Looseness(std::size_t label, std::size_t other,
                                std::span<const MarkerFrame> frames) {
  if (label == other) return std::nullopt;
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  double shown = 0.0;
  for (const MarkerFrame& frame : frames) {
    if (!frame.visible[label]) continue;
    shown += 1.0;
    if (!frame.visible[other]) continue;
    const double d = glm::distance(frame.position_ws[label], frame.position_ws[other]);
    sum += d;
    squares += d * d;
    count += 1.0;
  }
  if (count < static_cast<double>(kMinFrames) || count < 0.8 * shown) return std::nullopt;
  const double mean = sum / count;
  return std::sqrt(std::max(0.0, squares / count - mean * mean)) + 0.05 * mean;
}

}  // namespace

struct MarkerPredictor::Local {
  RigidTransform to_shape;
  Feature feature{};
};

double MarkerPredictor::Kernel::operator()(const Feature& a, const Feature& b) const {
  double dot = 0.0;
  double squared = 0.0;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    dot += a[i] * b[i];
    squared += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return 1.0 + dot / spread2 + std::exp(-0.5 * squared / (length * length));
}

MarkerPredictor::Process MarkerPredictor::Train(std::span<const double> kernel,
                                                std::span<const Vec3> target,
                                                std::span<const std::size_t> rows) {
  const std::size_t n = rows.size();
  Process process;
  process.factor.assign(n * n, 0.0);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      process.factor[r * n + c] = kernel[rows[r] * target.size() + rows[c]];
    }
    process.factor[r * n + r] += kNoise;
  }
  CholeskyInPlace(process.factor.data(), n, n);
  process.weight.resize(n);
  std::vector<double> column(n);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t r = 0; r < n; ++r) column[r] = target[rows[r]][axis];
    SolveLower(process.factor.data(), n, n, column.data());
    SolveLowerTransposed(process.factor.data(), n, n, column.data());
    for (std::size_t r = 0; r < n; ++r) process.weight[r][axis] = column[r];
  }
  return process;
}

MarkerPredictor::Told MarkerPredictor::Process::Tell(std::span<double> column, double self) const {
  Told told{Vec3{0.0}, self + kNoise};
  for (std::size_t i = 0; i < column.size(); ++i) told.value += column[i] * weight[i];
  SolveLower(factor.data(), column.size(), column.size(), column.data());
  for (const double c : column) told.variance -= c * c;
  told.variance = std::max(0.0, told.variance);
  return told;
}

std::optional<MarkerPredictor::Local> MarkerPredictor::Localise(const MarkerFrame& frame) const {
  std::array<Vec3, kNeighbours> at;
  for (std::size_t k = 0; k < count_; ++k) {
    if (!frame.visible[neighbour_[k]]) return std::nullopt;
    at[k] = frame.position_ws[neighbour_[k]];
  }
  Local local;
  local.to_shape = FitRigid(std::span(at).first(count_), std::span(shape_).first(count_));
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec3 off = local.to_shape.rotation * at[k] + local.to_shape.translation - shape_[k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      local.feature[3 * k + axis] = off[static_cast<int>(axis)];
    }
  }
  return local;
}

std::optional<MarkerPredictor> MarkerPredictor::Learn(std::size_t marker, std::size_t label,
                                                      std::span<const std::size_t> neighbours,
                                                      std::span<const MarkerFrame> frames) {
  MarkerPredictor p;
  p.marker_ = marker;
  p.label_ = label;
  p.count_ = std::min(neighbours.size(), kNeighbours);
  if (p.count_ < 3) return std::nullopt;
  std::copy_n(neighbours.begin(), p.count_, p.neighbour_.begin());
  std::vector<const MarkerFrame*> whole;
  for (const MarkerFrame& frame : frames) {
    bool all = frame.visible[label] != 0;
    for (std::size_t k = 0; k < p.count_; ++k) all = all && frame.visible[p.neighbour_[k]] != 0;
    if (all) whole.push_back(&frame);
  }
  if (whole.size() < kMinFrames) return std::nullopt;
  if (whole.size() > kMaxFrames) {
    for (std::size_t i = 0; i < kMaxFrames; ++i) {
      whole[i] = whole[i * (whole.size() - 1) / (kMaxFrames - 1)];
    }
    whole.resize(kMaxFrames);
  }
  const std::size_t n = whole.size();

  for (std::size_t k = 0; k < p.count_; ++k)
    p.shape_[k] = whole[n / 2]->position_ws[p.neighbour_[k]];
  for (int round = 0; round < kShapeRounds; ++round) {
    std::array<Vec3, kNeighbours> sum{};
    for (const MarkerFrame* frame : whole) {
      const Local local = *p.Localise(*frame);
      for (std::size_t k = 0; k < p.count_; ++k) {
        sum[k] += local.to_shape.rotation * frame->position_ws[p.neighbour_[k]] +
                  local.to_shape.translation;
      }
    }
    for (std::size_t k = 0; k < p.count_; ++k) p.shape_[k] = sum[k] / static_cast<double>(n);
  }

  std::vector<Vec3> target(n);
  std::vector<Feature> seen(n);
  p.kernel_.spread2 = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Local local = *p.Localise(*whole[i]);
    seen[i] = local.feature;
    for (const double f : local.feature) p.kernel_.spread2 += f * f / static_cast<double>(n);
    target[i] = local.to_shape.rotation * whole[i]->position_ws[label] + local.to_shape.translation;
    p.mean_ += target[i] / static_cast<double>(n);
  }
  for (Vec3& t : target) t -= p.mean_;
  p.kernel_.spread2 = std::max(p.kernel_.spread2, kLeastSpread * kLeastSpread);

  p.kernel_.length = kLength * std::sqrt(p.kernel_.spread2);

  std::vector<double> kernel(n * n);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t k = 0; k <= r; ++k) {
      kernel[r * n + k] = kernel[k * n + r] = p.kernel_(seen[r], seen[k]);
    }
  }

  // How far off it is where it was not learnt from.
  double error = 0.0;
  double variance = 0.0;
  std::vector<std::size_t> rows;
  std::vector<double> column;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    rows.clear();
    const auto left_out = [&](std::size_t i) { return (i * kBlocks / n) % kFolds == fold; };
    for (std::size_t i = 0; i < n; ++i) {
      if (!left_out(i)) rows.push_back(i);
    }
    const Process part = Train(kernel, target, rows);
    column.resize(rows.size());
    for (std::size_t i = 0; i < n; ++i) {
      if (!left_out(i)) continue;
      for (std::size_t r = 0; r < rows.size(); ++r) column[r] = kernel[i * n + rows[r]];
      const Told told = part.Tell(column, kernel[i * n + i]);
      error += glm::dot(told.value - target[i], told.value - target[i]) / 3.0;
      variance += told.variance;
    }
  }
  p.variance_scale_ = error / variance;
  rows.resize(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  p.process_ = Train(kernel, target, rows);
  p.seen_ = std::move(seen);
  return p;
}

std::optional<MarkerPredictor::Prediction> MarkerPredictor::Predict(
    const MarkerFrame& frame) const {
  const std::optional<Local> local = Localise(frame);
  if (!local) return std::nullopt;
  std::array<double, kMaxFrames> column;
  for (std::size_t i = 0; i < seen_.size(); ++i) column[i] = kernel_(local->feature, seen_[i]);
  const Told told =
      process_.Tell(std::span(column).first(seen_.size()), kernel_(local->feature, local->feature));
  const double sigma = std::max(kLeastToldSigma, std::sqrt(told.variance * variance_scale_));
  // Fades out where there is nothing to tell from.
  const double sure = (1.0 - told.variance) * (1.0 - sigma * sigma / (kMostSigma * kMostSigma));
  if (!(told.variance < 1.0) || !(sure > 0.0)) return std::nullopt;
  Prediction prediction;
  prediction.position_ws =
      glm::conjugate(local->to_shape.rotation) * (mean_ + told.value - local->to_shape.translation);
  prediction.sigma = sigma / sure;
  prediction.frame_ws = glm::conjugate(local->to_shape.rotation);
  return prediction;
}

std::vector<MarkerPredictor> LearnPredictors(std::span<const BoundMarker> markers,
                                             std::span<const MarkerFrame> frames,
                                             std::span<const ModelPose> poses) {
  // Frames without the markers that are not where the posture takes them.
  std::vector<std::vector<std::uint8_t>> visible;
  std::vector<MarkerFrame> honest;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    visible.emplace_back(frames[f].visible.begin(), frames[f].visible.end());
    for (const BoundMarker& marker : markers) {
      const Vec3& seen = frames[f].position_ws[marker.label];
      if (!(glm::distance(MarkerPosition(marker, poses[f]), seen) < kWrong)) {
        visible[f][marker.label] = 0;
      }
    }
    honest.push_back({frames[f].time_s, frames[f].position_ws, visible[f]});
  }
  std::vector<MarkerPredictor> predictors;
  std::vector<std::pair<double, std::size_t>> near;  // how loosely tied, label
  for (std::size_t m = 0; m < markers.size(); ++m) {
    near.clear();
    for (const BoundMarker& other : markers) {
      const std::optional<double> tie = Looseness(markers[m].label, other.label, honest);
      if (tie) near.emplace_back(*tie, other.label);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > kCandidates) near.resize(kCandidates);
    for (const auto& choice : kChoices) {
      std::vector<std::size_t> neighbours;
      for (const std::size_t k : choice) {
        if (k < near.size()) neighbours.push_back(near[k].second);
      }
      std::optional<MarkerPredictor> p =
          MarkerPredictor::Learn(m, markers[m].label, neighbours, honest);
      if (p) predictors.push_back(std::move(*p));
    }
  }
  return predictors;
}

std::optional<MarkerPredictor::Prediction> Tell(std::span<const MarkerPredictor> all,
                                                std::size_t marker, const MarkerFrame& frame) {
  MarkerPredictor::Prediction mean;
  double total = 0.0;
  for (const MarkerPredictor& predictor : all) {
    if (predictor.marker() != marker) continue;
    const std::optional<MarkerPredictor::Prediction> told = predictor.Predict(frame);
    if (!told) continue;
    const double weight = 1.0 / (told->sigma * told->sigma);
    mean.position_ws += weight * told->position_ws;
    // Not independent: together they are as sure as one of them is on average.
    mean.sigma += weight * told->sigma;
    total += weight;
    mean.frame_ws = told->frame_ws;
  }
  if (total == 0.0) return std::nullopt;
  mean.position_ws /= total;
  mean.sigma /= total;
  return mean;
}

}  // namespace ego
