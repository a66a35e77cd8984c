// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/body/body.h"
#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/posed_body.h"
#include "core/geometry/mesh_distance.h"

namespace ego {

/// A sphere on an arm.
struct ArmSample {
  Vec3 center{0.0};
  double radius = 0.0;
};
ArmSample SampleOf(const Body& body, const PosedBody& posed, Limb arm, std::size_t sample);

/// Trunk and head of a posed body as obstacles; refers to `posed`.
struct BodyObstacles {
  BodyObstacles(const Body& body, const PosedBody& posed);
  /// Signed distance of a sphere's skin to obstacle 0 (trunk) or 1 (head). False, and nothing
  /// written, where it is farther than a twentieth of the body's height.
  bool Distance(std::size_t obstacle, const ArmSample& sample, SignedDistance& out) const;
  /// Never more than the distance from the sphere's skin to the mesh, at hardly any cost.
  double LowerBound(std::size_t obstacle, const ArmSample& sample) const {
    return box_[obstacle].Distance(sample.center) - sample.radius;
  }

 private:
  std::array<std::span<const TriangleQuad>, 2> mesh_;
  std::array<Box, 2> box_;
  std::array<double, 2> width_;
  double height_;
};

/// A capsule in place as an obstacle; refers to it.
struct CapsuleObstacle {
  explicit CapsuleObstacle(const PosedCapsule& posed);
  /// From the closest point of the axis to `p`.
  Vec3 FromAxis(const Vec3& p) const {
    const Vec3 offset = p - capsule->start;
    return offset - std::clamp(glm::dot(offset, axis) * per_square, 0.0, 1.0) * axis;
  }
  /// Whether `p` is farther from the axis than `distance`, as far as hardly any cost can tell.
  bool IsFartherThan(double distance, const Vec3& p) const {
    const Vec3 offset = p - middle;
    const double bound = distance + half_length;
    return glm::dot(offset, offset) > bound * bound;
  }

  const PosedCapsule* capsule;
  Vec3 axis;          // start to end
  double per_square;  // one over the square of its length, 0 where it has none
  Vec3 middle;
  double half_length;
};

/// Obstacles 2 to 8 of an arm: the other limbs' segments by slot, then the other hand.
inline constexpr std::size_t kFirstCapsuleObstacle = 2;
using CapsuleObstacles = std::array<CapsuleObstacle, kObstacleCount - kFirstCapsuleObstacle>;
CapsuleObstacles CapsuleObstaclesOf(const PosedBody& posed, Limb arm);

/// The performer's own clearance of all samples of an arm. The same bits for any `lanes`.
void MeasureClearance(const Body& performer, const PosedBody& posed, Limb arm,
                      EgocentricPose::ArmClearance& out, LaneWidth lanes = FastestLanes());

}  // namespace ego
