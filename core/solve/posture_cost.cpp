// SPDX-License-Identifier: MIT
#include "core/solve/posture_cost.h"

#include <cmath>

namespace ego {
namespace {

using J = HumanoidJoint;

// Spread of joint rotations about the neutral posture, degrees, per axis of the joint's frame.
// Measured trade-off on real takes: looser spines flip, tighter ones cost residual.
constexpr Vec3 BallSigmaDegrees(J joint) {
  switch (joint) {
    case J::kSpine:
    case J::kChest:
      return {20.0, 12.0, 12.0};  // x: bending forward, what the lower back does most
    case J::kUpperChest:
      return {12.0, 12.0, 12.0};
    case J::kNeck:
    case J::kHead:
      return {20.0, 20.0, 20.0};
    case J::kLeftShoulder:
    case J::kRightShoulder:
      return {5.0, 20.0, 20.0};  // x: about the clavicle itself
    case J::kLeftHand:
    case J::kRightHand:
      return {4.0, 25.0, 25.0};  // x: the forearm turns, not the wrist
    case J::kLeftFoot:
    case J::kRightFoot:
      return {25.0, 25.0, 25.0};
    case J::kLeftUpperArm:
    case J::kRightUpperArm:
      return {120.0, 120.0, 120.0};
    default:
      return {90.0, 90.0, 90.0};  // thighs
  }
}

constexpr bool IsEnd(J joint) {
  return joint == J::kNeck || joint == J::kHead || joint == J::kLeftHand ||
         joint == J::kRightHand || joint == J::kLeftFoot || joint == J::kRightFoot;
}

constexpr double kNeutralElbow = Radians(15.0);
constexpr double kNeutralKnee = Radians(5.0);
constexpr double kFlexionSigma = Radians(120.0);
constexpr double kPronationSigma = Radians(50.0);
constexpr double kKneeAxialSigma = Radians(8.0);
constexpr double kToesSigma = Radians(25.0);
// Soft limits: people reach 167 degrees of flexion and stretch knees a little beyond straight.
constexpr double kMinFlexion = 0.0;
constexpr double kMaxFlexion = Radians(165.0);
constexpr double kLimitSigma = Radians(3.0);

struct ScalarTerm {
  double gradient = 0.0;
  double curvature = 0.0;
  double cost = 0.0;

  void Add(double error, double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    gradient += weight * error;
    curvature += weight;
    cost += 0.5 * weight * error * error;
  }
};

ScalarTerm FlexionTerm(Limb limb, double angle, const Priors& priors) {
  ScalarTerm term;
  term.Add(angle - (IsArm(limb) ? kNeutralElbow : kNeutralKnee), kFlexionSigma);
  if (angle < kMinFlexion) term.Add(angle - kMinFlexion, kLimitSigma);
  if (angle > kMaxFlexion) term.Add(angle - kMaxFlexion, kLimitSigma);
  if (priors.previous != nullptr) {
    term.Add(angle - priors.previous->flexion[Index(limb)], priors.rotation_sigma);
  }
  return term;
}

ScalarTerm AxialTerm(Limb limb, double angle, const Priors& priors) {
  ScalarTerm term;
  term.Add(angle, IsArm(limb) ? kPronationSigma : kKneeAxialSigma);
  if (priors.previous != nullptr) {
    term.Add(angle - priors.previous->axial[Index(limb)], priors.rotation_sigma);
  }
  return term;
}

ScalarTerm ToesTerm(std::size_t foot, double angle, const Priors& priors) {
  ScalarTerm term;
  term.Add(angle, kToesSigma);
  if (priors.previous != nullptr) {
    term.Add(angle - priors.previous->toes[foot], priors.rotation_sigma);
  }
  return term;
}

void AddScalar(std::size_t dof, const ScalarTerm& term, NormalEquations& equations) {
  equations.g[dof] += term.gradient;
  equations.h[dof * kPoseDof + dof] += term.curvature;
}

/// Cost of a rotation's distance from `from`, and where wanted its normal equations.
double BallTerm(const Quat& from, const Quat& to, const Vec3& sigma, std::size_t first,
                NormalEquations* equations) {
  const Vec3 v = RotationVector(glm::conjugate(from) * to);
  const Vec3 weight = 1.0 / (sigma * sigma);
  if (equations != nullptr) {
    const Mat3 jacobian = RotationVectorJacobian(v);
    const Vec3 g = glm::transpose(jacobian) * (weight * v);
    for (int r = 0; r < 3; ++r) {
      const std::size_t row = first + static_cast<std::size_t>(r);
      equations->g[row] += g[r];
      for (int c = 0; c <= r; ++c) {
        const std::size_t column = first + static_cast<std::size_t>(c);
        equations->h[row * kPoseDof + column] += glm::dot(jacobian[r], weight * jacobian[c]);
      }
    }
  }
  return 0.5 * glm::dot(weight * v, v);
}

double AllPriors(const Posture& posture, const Priors& priors, NormalEquations* equations) {
  double cost = 0.0;
  const Posture& neutral = NeutralPosture();
  const Vec3 step_sigma{priors.rotation_sigma};
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    const DofRange range = DofsOf(joint);
    if (range.count != 3) continue;
    if (joint != J::kHips) {
      const double spread = IsEnd(joint) ? priors.end_spread : 1.0;
      const Vec3 sigma = BallSigmaDegrees(joint) * Radians(spread);
      cost +=
          BallTerm(neutral.rotation_ls[j], posture.rotation_ls[j], sigma, range.first, equations);
    }
    if (priors.previous != nullptr) {
      cost += BallTerm(priors.previous->rotation_ls[j], posture.rotation_ls[j], step_sigma,
                       range.first, equations);
    }
  }
  for (const Limb limb : kLimbs) {
    const DofRange range = DofsOf(JointsOf(limb).mid);
    const ScalarTerm flexion = FlexionTerm(limb, posture.flexion[Index(limb)], priors);
    const ScalarTerm axial = AxialTerm(limb, posture.axial[Index(limb)], priors);
    cost += flexion.cost + axial.cost;
    if (equations == nullptr) continue;
    AddScalar(range.first, flexion, *equations);
    AddScalar(range.first + 1, axial, *equations);
  }
  for (std::size_t i = 0; i < kToes.size(); ++i) {
    const ScalarTerm toes = ToesTerm(i, posture.toes[i], priors);
    cost += toes.cost;
    if (equations != nullptr) AddScalar(DofsOf(kToes[i]).first, toes, *equations);
  }
  if (priors.previous != nullptr) {
    const Vec3 shift = posture.root_ws - priors.previous->root_ws;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ScalarTerm term;
      term.Add(shift[static_cast<int>(axis)], priors.root_sigma);
      cost += term.cost;
      if (equations != nullptr) AddScalar(axis, term, *equations);
    }
  }
  return cost;
}

/// A marker that was told from others counts for less, the less sure it is.
MarkerLoss LossOf(const MarkerLoss& loss, const MarkerFrame& frame, std::size_t label) {
  if (frame.told_sigma.empty() || frame.told_sigma[label] == 0.0) return loss;
  MarkerLoss told = loss;
  told.sigma = std::hypot(loss.sigma, frame.told_sigma[label]);
  return told;
}

}  // namespace

double MarkerLoss::Cost(double squared_distance) const {
  const double k2 = outlier_factor * outlier_factor;
  const double ratio = squared_distance / (k2 * sigma * sigma);  // (r / c)^2
  return 0.5 * k2 * (kind == Kind::kCauchy ? std::log1p(ratio) : ratio / (1.0 + ratio));
}

double MarkerLoss::Weight(double squared_distance) const {
  const double variance = sigma * sigma;
  const double faded = 1.0 + squared_distance / (outlier_factor * outlier_factor * variance);
  return 1.0 / (variance * (kind == Kind::kCauchy ? faded : faded * faded));
}

double PriorCost(const Posture& posture, const Priors& priors) {
  return AllPriors(posture, priors, nullptr);
}

double AddPriors(const Posture& posture, const Priors& priors, NormalEquations& equations) {
  return AllPriors(posture, priors, &equations);
}

double MarkerCost(const MarkerModel& model, const MarkerFrame& frame, const ModelPose& pose,
                  const MarkerLoss& loss) {
  double cost = 0.0;
  for (const BoundMarker& marker : model.markers) {
    if (!frame.visible[marker.label]) continue;
    const Vec3 error = MarkerPosition(marker, pose) - frame.position_ws[marker.label];
    cost += LossOf(loss, frame, marker.label).Cost(glm::dot(error, error));
  }
  return cost;
}

double AddMarkers(const MarkerModel& model, const MarkerFrame& frame, const ModelPose& pose,
                  const MarkerLoss& loss, NormalEquations& equations) {
  std::array<Vec3, kPoseDof> axis_ws;
  std::array<Vec3, kPoseDof> column;
  DofAxes(pose, axis_ws);
  double cost = 0.0;
  for (const BoundMarker& marker : model.markers) {
    if (!frame.visible[marker.label]) continue;
    const CarriedMarker placed = Carry(marker, pose);
    const Vec3 error = placed.point_ws - frame.position_ws[marker.label];
    const double squared = glm::dot(error, error);
    const MarkerLoss own = LossOf(loss, frame, marker.label);
    const double weight = own.Weight(squared);
    cost += own.Cost(squared);
    MarkerJacobian(marker, placed, pose, axis_ws, column);
    const std::span<const std::uint8_t> chain = Chain(marker);
    for (std::size_t r = 0; r < chain.size(); ++r) {
      const Vec3 weighted = weight * column[r];
      equations.g[chain[r]] += glm::dot(weighted, error);
      double* row = equations.h.data() + chain[r] * kPoseDof;
      for (std::size_t c = 0; c <= r; ++c) row[chain[c]] += glm::dot(weighted, column[c]);
    }
  }
  return cost;
}

ModelPose Placed(const Skeleton& skeleton, const Posture& posture) {
  Pose pose;
  pose.root_ws = posture.root_ws;
  pose.rotation_ls = posture.rotation_ls;
  return ForwardKinematics(skeleton, pose);
}

const Posture& NeutralPosture() {
  static const Posture kNeutral = [] {
    Pose pose;
    pose.rotation_ls[Index(J::kLeftUpperArm)] = glm::angleAxis(Radians(-75.0), Vec3{0, 0, 1});
    pose.rotation_ls[Index(J::kRightUpperArm)] = glm::angleAxis(Radians(75.0), Vec3{0, 0, 1});
    for (const Limb limb : kLimbs) {
      pose.rotation_ls[Index(JointsOf(limb).mid)] =
          glm::angleAxis(IsArm(limb) ? kNeutralElbow : kNeutralKnee, FlexionAxis(limb));
    }
    return PostureFromPose(pose);
  }();
  return kNeutral;
}

}  // namespace ego
