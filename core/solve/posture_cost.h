// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/base/math.h"
#include "core/markers/marker_take.h"
#include "core/solve/pose_solver.h"
#include "core/solve/posture.h"

namespace ego {

/// Soft loss of a marker's error r: quadratic near zero, r^2 / (2 sigma^2); beyond
/// c = outlier_factor * sigma the pull fades.
struct MarkerLoss {
  enum class Kind {
    kCauchy,        // 1/2 c^2 log(1 + r^2 / c^2) / sigma^2: fades as 1 / r, still finds far ones
    kGemanMcClure,  // 1/2 c^2 r^2 / (c^2 + r^2) / sigma^2: fades as 1 / r^3, ghosts lose all pull
  };
  double sigma = 0.008;
  double outlier_factor = 5.0;
  Kind kind = Kind::kCauchy;

  double Cost(double squared_distance) const;
  /// Weight of the squared error in the equivalent least squares.
  double Weight(double squared_distance) const;
};

/// What is known of a posture beforehand.
struct Priors {
  const Posture* previous = nullptr;     // of the frame before; null: no temporal prior
  double rotation_sigma = Radians(8.0);  // how far a joint goes from it
  double root_sigma = 0.05;              // metres
  /// Widens the spread of wrists, ankles, neck and head about neutral. They are held for the sake
  /// of frames that hardly show them; in the global fit that would pull joint centres along.
  double end_spread = 1.0;
};

/// Normal equations of one posture: H step = -g. Lower triangle, row-major.
struct NormalEquations {
  std::array<double, kPoseDof * kPoseDof> h{};
  std::array<double, kPoseDof> g{};
};

/// Cost of the priors of a posture: what markers see badly stays near its neutral place, elbows
/// and knees do not over-stretch, joints stay near the previous frame's.
double PriorCost(const Posture& posture, const Priors& priors);
/// Adds the priors' part; returns PriorCost.
double AddPriors(const Posture& posture, const Priors& priors, NormalEquations& equations);

/// Cost of the visible markers.
double MarkerCost(const MarkerModel& model, const MarkerFrame& frame, const ModelPose& pose,
                  const MarkerLoss& loss);
/// Adds the markers' part (Gauss-Newton with the loss's weights); returns MarkerCost.
double AddMarkers(const MarkerModel& model, const MarkerFrame& frame, const ModelPose& pose,
                  const MarkerLoss& loss, NormalEquations& equations);

/// Forward kinematics of a posture.
ModelPose Placed(const Skeleton& skeleton, const Posture& posture);

/// The neutral posture of the priors: arms hanging, elbows a little bent. Root at the origin.
const Posture& NeutralPosture();

}  // namespace ego
