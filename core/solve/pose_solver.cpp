// SPDX-License-Identifier: MIT
#include "core/solve/pose_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/solve/cold_pose.h"
#include "core/solve/dense.h"
#include "core/solve/posture_cost.h"

namespace ego {
namespace {

// A step is converged below these; smaller ones change no picture.
constexpr double kRotationTolerance = 4e-4;
constexpr double kTranslationTolerance = 5e-5;
// Longest step of any angle: beyond it the linear model means nothing.
constexpr double kMaxTurn = 0.6;

struct Problem {
  const MarkerModel& model;
  const MarkerFrame& frame;
  MarkerLoss loss;
  Priors priors;
};

double Cost(const Problem& problem, const Posture& posture) {
  return PriorCost(posture, problem.priors) + MarkerCost(problem.model, problem.frame,
                                                         Placed(problem.model.skeleton, posture),
                                                         problem.loss);
}

void LimitStep(std::array<double, kPoseDof>& step) {
  double largest = 0.0;
  for (std::size_t d = 3; d < kPoseDof; ++d) largest = std::max(largest, std::abs(step[d]));
  if (largest <= kMaxTurn) return;
  for (double& s : step) s *= kMaxTurn / largest;
}

bool IsSmall(const std::array<double, kPoseDof>& step) {
  for (std::size_t d = 0; d < kPoseDof; ++d) {
    if (std::abs(step[d]) > (d < 3 ? kTranslationTolerance : kRotationTolerance)) return false;
  }
  return true;
}

struct Descent {
  double cost = 0.0;
  int iterations = 0;
};

/// The loss of the last steps: half as steep at its shoulder, but ghosts lose all pull.
MarkerLoss Final(const MarkerLoss& loss) {
  return {loss.sigma, 2.0 * loss.outlier_factor, MarkerLoss::Kind::kGemanMcClure};
}

/// Levenberg-Marquardt from `posture`, which is left at the best place found.
Descent Minimise(const Problem& problem, int max_iterations, Posture& posture) {
  Descent descent;
  NormalEquations equations;
  std::array<double, kPoseDof * kPoseDof> factor;
  std::array<double, kPoseDof> step;
  double damping = 1e-4;
  bool linear = false;
  for (; descent.iterations < max_iterations; ++descent.iterations) {
    if (!linear) {
      equations.h.fill(0.0);
      equations.g.fill(0.0);
      const ModelPose pose = Placed(problem.model.skeleton, posture);
      descent.cost = AddPriors(posture, problem.priors, equations) +
                     AddMarkers(problem.model, problem.frame, pose, problem.loss, equations);
      linear = true;
    }
    factor = equations.h;
    for (std::size_t d = 0; d < kPoseDof; ++d) {
      double& diagonal = factor[d * kPoseDof + d];
      diagonal += damping * diagonal + 1e-6;
      step[d] = -equations.g[d];
    }
    CholeskyInPlace(factor.data(), kPoseDof, kPoseDof);
    SolveLower(factor.data(), kPoseDof, kPoseDof, step.data());
    SolveLowerTransposed(factor.data(), kPoseDof, kPoseDof, step.data());
    LimitStep(step);
    const Posture candidate = Moved(posture, step);
    const double cost = Cost(problem, candidate);
    if (cost <= descent.cost) {  // false for NaN
      const bool converged = IsSmall(step) || descent.cost - cost < 1e-6 * descent.cost;
      posture = candidate;
      descent.cost = cost;
      damping = std::max(1e-7, 0.2 * damping);
      linear = false;
      if (converged) {
        ++descent.iterations;
        break;
      }
    } else {
      if (IsSmall(step)) break;
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  return descent;
}

/// Visible, and not told from others.
bool IsSeen(const MarkerFrame& frame, std::size_t label) {
  return frame.visible[label] && (frame.told_sigma.empty() || frame.told_sigma[label] == 0.0);
}

std::size_t CountVisible(const MarkerModel& model, const MarkerFrame& frame) {
  std::size_t count = 0;
  for (const BoundMarker& marker : model.markers) count += IsSeen(frame, marker.label) ? 1u : 0u;
  return count;
}

/// `cap`: what one marker may count at most, so that a lone ghost does not look like a lost body.
double MeanResidual(const MarkerModel& model, const MarkerFrame& frame, const ModelPose& pose,
                    double cap = std::numeric_limits<double>::infinity()) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const BoundMarker& marker : model.markers) {
    if (!IsSeen(frame, marker.label)) continue;
    const Vec3 point = MarkerPosition(marker, pose);
    sum += std::min(cap, glm::distance(point, frame.position_ws[marker.label]));
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

// A marker this far from where the others put it, and from where the posture does, is another's or
// none's.
constexpr double kGhost = 0.1;

/// A frame whose markers may be replaced by what others tell, in memory that a state lends.
class ToldFrame {
 public:
  ToldFrame(const MarkerModel& model, const MarkerFrame& frame, PoseSolver::State& state)
      : model_(model), state_(state), frame_(frame) {}

  const MarkerFrame& frame() const { return frame_; }

  /// Lost markers, told from those around them.
  void FillLost() {
    const MarkerFrame seen = frame_;
    for (std::size_t m = 0; m < model_.markers.size(); ++m) {
      if (seen.visible[model_.markers[m].label]) continue;
      const auto told = Tell(model_.predictors, m, seen);
      if (told) Replace(model_.markers[m].label, *told, seen);
    }
  }

  /// Markers far from this posture, told from those around them where these agree with it.
  /// Returns whether there were any.
  bool ReplaceGhosts(const ModelPose& pose) {
    const MarkerFrame seen = frame_;
    bool any = false;
    for (std::size_t m = 0; m < model_.markers.size(); ++m) {
      const BoundMarker& marker = model_.markers[m];
      if (!IsSeen(seen, marker.label)) continue;
      const Vec3& at = seen.position_ws[marker.label];
      if (glm::distance(MarkerPosition(marker, pose), at) < kGhost) continue;
      const auto told = Tell(model_.predictors, m, seen);
      if (!told || glm::distance(told->position_ws, at) < kGhost) continue;
      Replace(marker.label, *told, seen);
      any = true;
    }
    return any;
  }

 private:
  void Replace(std::size_t label, const MarkerPredictor::Prediction& told,
               const MarkerFrame& seen) {
    if (frame_.position_ws.data() != state_.position_ws.data()) {
      state_.position_ws.assign(seen.position_ws.begin(), seen.position_ws.end());
      state_.visible.assign(seen.visible.begin(), seen.visible.end());
      state_.told_sigma.assign(seen.visible.size(), 0.0);
      std::copy(seen.told_sigma.begin(), seen.told_sigma.end(), state_.told_sigma.begin());
      frame_ = {seen.time_s, state_.position_ws, state_.visible, state_.told_sigma};
    }
    state_.position_ws[label] = told.position_ws;
    state_.visible[label] = 1;
    state_.told_sigma[label] = told.sigma;
  }

  const MarkerModel& model_;
  PoseSolver::State& state_;
  MarkerFrame frame_;
};

constexpr int kColdIterations = 30;
// Steps with the loss that still pulls from afar before the one that ignores ghosts.
constexpr int kApproach = 2;

}  // namespace

PoseSolver::PoseSolver(MarkerModel model, PoseSolverOptions options)
    : model_(std::move(model)), options_(options) {}

PoseSolverReport PoseSolver::Solve(const MarkerFrame& frame, State& state) const {
  if (!state.started) return SolveCold(frame, state);
  PoseSolverReport report;
  report.visible = CountVisible(model_, frame);
  if (report.visible < kMinMarkers) return report;

  const Posture previous = PostureFromPose(state.pose);
  ToldFrame told(model_, frame, state);
  told.FillLost();
  Problem problem{model_, told.frame(), {options_.sigma, options_.outlier_factor}, {}};
  if (options_.step_per_frame > 0.0) {
    problem.priors.previous = &previous;
    problem.priors.rotation_sigma = options_.step_per_frame;
  }
  Posture posture = previous;
  report.iterations = Minimise(problem, kApproach, posture).iterations;
  problem.loss = Final(problem.loss);
  report.iterations += Minimise(problem, options_.max_iterations, posture).iterations;
  if (told.ReplaceGhosts(Placed(model_.skeleton, posture))) {
    report.iterations += Minimise(problem, options_.max_iterations, posture).iterations;
  }
  report.mean_residual = MeanResidual(model_, frame, Placed(model_.skeleton, posture));
  report.solved = true;

  if (!(MeanResidual(model_, frame, Placed(model_.skeleton, posture), kGhost) <
        options_.restart_residual)) {
    State fresh;
    const PoseSolverReport cold = SolveCold(frame, fresh);
    // Judged without the temporal prior, which a restart rightly breaks.
    const Problem plain{model_, told.frame(), problem.loss, {}};
    if (cold.solved && Cost(plain, PostureFromPose(fresh.pose)) < 0.8 * Cost(plain, posture)) {
      state.pose = fresh.pose;
      report = cold;
      report.restarted = true;
      return report;
    }
  }
  state.pose = PoseFromPosture(posture);
  return report;
}

PoseSolverReport PoseSolver::SolveCold(const MarkerFrame& frame, State& state) const {
  PoseSolverReport report;
  report.visible = CountVisible(model_, frame);
  if (report.visible < kMinMarkers) return report;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const ColdGuess guess : kColdGuesses) {
    Posture posture = PostureFromPose(GuessPose(model_, frame, guess));
    ToldFrame told(model_, frame, state);
    told.FillLost();
    Problem problem{model_, told.frame(), {options_.sigma, options_.outlier_factor}, {}};
    for (const double factor : {12.0, 4.0, 1.0}) {
      problem.loss.sigma = factor * options_.sigma;
      report.iterations += Minimise(problem, kColdIterations, posture).iterations;
    }
    problem.loss = Final(problem.loss);
    Descent descent = Minimise(problem, kColdIterations, posture);
    report.iterations += descent.iterations;
    if (told.ReplaceGhosts(Placed(model_.skeleton, posture))) {
      descent = Minimise(problem, kColdIterations, posture);
      report.iterations += descent.iterations;
    }
    const double residual = MeanResidual(model_, frame, Placed(model_.skeleton, posture));
    if (!(descent.cost < best_cost)) continue;
    best_cost = descent.cost;
    state.pose = PoseFromPosture(posture);
    state.started = true;
    report.solved = true;
    report.mean_residual = residual;
    if (residual < 0.5 * options_.restart_residual) break;
  }
  return report;
}

}  // namespace ego
