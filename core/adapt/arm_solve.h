// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "core/adapt/adapt_state.h"
#include "core/geometry/small_solve.h"

namespace ego {

/// One damped least-squares step of both arms at once (Levenberg 1944; Wampler 1986 for
/// manipulators): the least turn of shoulders, elbows and hands that fulfils wishes about points on
/// the arms,
///   x = (sum w J^T J + D)^-1 sum w J^T value.
/// What one arm wants of the other is one row over the joints of both, so that hands meet half way
/// without either being first, and whatever else holds one of them holds the other too.
class ArmSolve {
 public:
  explicit ArmSolve(const AdaptState& state);

  /// Part of an arm that a point moves with.
  enum class Part : std::uint8_t { kUpperArm, kForearm, kHand };
  struct Point {
    Limb arm;
    Part part;
    Vec3 at_ws{0.0};
  };
  /// Asks a point to move by `value` metres along `direction`.
  void Ask(const Point& point, const Vec3& direction, double value, double weight);
  /// The same relative to a point of the other arm.
  void AskApart(const Point& point, const Point& other, const Vec3& direction, double value,
                double weight);
  bool empty() const { return empty_; }

  /// Asks a wrist to stay.
  void HoldWrist(Limb arm, double weight);

  struct Move {
    LimbPosture posture;
    Quat hand_ws = kIdentity;
  };
  /// Where both arms go.
  std::array<Move, 2> Solve() const;

 private:
  /// Turn of the shoulder (3), flexion of the elbow, turn of the hand (3).
  static constexpr std::size_t kUnknowns = 7;
  using Gradient = std::array<double, kUnknowns>;

  /// How a point of one arm moves with its joints.
  struct Lever {
    Lever(const AdaptState& state, Limb arm);
    /// Of direction . point, by the unknowns.
    Gradient Along(Part part, const Vec3& point, const Vec3& direction) const;

    const LimbChain* chain;
    LimbPosture posture;
    LimbPlacement placed;
    Vec3 axis_ls;
    Vec3 hinge;
    Quat hand_ws;
    bool hand_can_turn;
    double hand_length;
  };
  Move Moved(const Lever& lever, const double* x) const;

  std::array<Lever, 2> lever_;
  std::array<NormalEquations<kUnknowns>, 2> own_;
  /// What couples the arms, rows of the left one.
  std::array<std::array<double, kUnknowns>, kUnknowns> cross_{};
  bool coupled_ = false;
  bool empty_ = true;
};

}  // namespace ego
