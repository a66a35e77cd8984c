// SPDX-License-Identifier: MIT
#pragma once

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
  std::array<std::span<const TrianglePair>, 2> mesh_;
  std::array<Box, 2> box_;
  std::array<double, 2> width_;
  double height_;
};

/// The capsule of obstacles 2 to 8: the other limbs' segments by slot, then the other hand.
const PosedCapsule& ObstacleCapsule(const PosedBody& posed, Limb arm, std::size_t obstacle);

/// The performer's own clearance of all samples of an arm.
void MeasureClearance(const Body& performer, const PosedBody& posed, Limb arm,
                      EgocentricPose::ArmClearance& out);

}  // namespace ego
