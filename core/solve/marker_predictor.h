// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/markers/marker_take.h"
#include "core/skeleton/pose.h"
#include "core/solve/bound_marker.h"

namespace ego {

inline constexpr double kLeastToldSigma = 0.0005;  // of any marker that was told, metres

/// Tells where a marker must be from the markers around it: a Gaussian process on the neighbours'
/// places, seen from a rigid fit of them to their mean shape, learnt from frames of the same
/// performer that show them all (Rasmussen and Williams, Gaussian Processes for Machine Learning,
/// 2006, algorithm 2.1). What marker intercorrelations carry is known to fill gaps well
/// (Gloersen and Federolf, PLoS ONE 11, 2016); the local frame and the kernel make it so for bent
/// joints, too.
class MarkerPredictor {
 public:
  static constexpr std::size_t kNeighbours = 6;

  struct Prediction {
    Vec3 position_ws{0.0};
    double sigma = 0.0;         // of one axis, metres
    Quat frame_ws = kIdentity;  // how the neighbours are turned
  };

  /// Learns to predict `label` from `neighbours` (labels; 3 to kNeighbours of them) by the frames
  /// that show all of them. Nothing where too few do.
  static std::optional<MarkerPredictor> Learn(std::size_t marker, std::size_t label,
                                              std::span<const std::size_t> neighbours,
                                              std::span<const MarkerFrame> frames);

  std::size_t marker() const { return marker_; }  // index among the model's
  std::size_t label() const { return label_; }    // index into the frames' points

  /// Nothing where a neighbour is not visible. Follows the frame's turns and shifts. No allocation.
  std::optional<Prediction> Predict(const MarkerFrame& frame) const;

  static constexpr std::size_t kMaxFrames = 100;

 private:
  static constexpr std::size_t kFeatures = 3 * kNeighbours;
  using Feature = std::array<double, kFeatures>;

  struct Kernel {
    double length = 1.0;   // of features, metres
    double spread2 = 1.0;  // mean squared feature

    double operator()(const Feature& a, const Feature& b) const;
  };

  struct Told {
    Vec3 value{0.0};
    double variance = 0.0;  // relative
  };

  /// The trained Gaussian process.
  struct Process {
    std::vector<Vec3> weight;
    std::vector<double> factor;  // Cholesky, row-major, weight.size() squared

    /// `column`: the kernel of what is asked with all that was learnt, used up; `self`: with
    /// itself.
    Told Tell(std::span<double> column, double self) const;
  };
  /// From the frames `rows` of all, of which `kernel` is the square matrix.
  static Process Train(std::span<const double> kernel, std::span<const Vec3> target,
                       std::span<const std::size_t> rows);

  struct Local;
  std::optional<Local> Localise(const MarkerFrame& frame) const;

  std::size_t marker_ = 0;
  std::size_t label_ = 0;
  std::size_t count_ = 0;
  std::array<std::size_t, kNeighbours> neighbour_{};
  std::array<Vec3, kNeighbours> shape_{};  // mean, about its own centre
  Vec3 mean_{0.0};                         // of the marker, in the shape's frame
  Kernel kernel_;
  double variance_scale_ = 0.0;  // metres^2 per unit of the process's variance
  std::vector<Feature> seen_;
  Process process_;
};

/// Predictors for every marker that has neighbours to tell it, up to three per marker, which lean
/// on different neighbours; a marker's follow one another. `frames`: as diverse as the take;
/// `poses`: of the same frames, so that a marker that is not where the posture takes it teaches
/// nothing.
std::vector<MarkerPredictor> LearnPredictors(std::span<const BoundMarker> markers,
                                             std::span<const MarkerFrame> frames,
                                             std::span<const ModelPose> poses);

/// What the predictors of a marker say, the surer the more; nothing where none can tell.
std::optional<MarkerPredictor::Prediction> Tell(std::span<const MarkerPredictor> all,
                                                std::size_t marker, const MarkerFrame& frame);

}  // namespace ego
