// SPDX-License-Identifier: MIT
#include "core/egocentric/clearance.h"

#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

constexpr double kSmoothing = 0.005;  // heights
constexpr double kCull = 0.05;        // heights

double Width(const Body& body, SamplePoint a, SamplePoint b) {
  return glm::distance(body.surface.sample_ms[Index(a)], body.surface.sample_ms[Index(b)]);
}

}  // namespace

ArmSample SampleOf(const Body& body, const PosedBody& posed, Limb arm, std::size_t sample) {
  constexpr std::array<double, 3> kUpper = {0.5, 0.75, 1.0};
  constexpr std::array<double, 5> kLower = {0.2, 0.4, 0.6, 0.8, 1.0};
  const PosedCapsule& upper = posed.capsule[2 * Index(arm)];
  const PosedCapsule& lower = posed.capsule[2 * Index(arm) + 1];
  if (sample < 3) return {upper.At(kUpper[sample]), upper.radius};
  if (sample < kFirstContactSample) return {lower.At(kLower[sample - 3]), lower.radius};
  if (sample == kFirstContactSample) {
    return {lower.end, body.surface.hand[Index(arm)].half_thickness};
  }
  const LimbPoint point = sample == kFirstContactSample + 1 ? PalmPoint(arm) : FingertipPoint(arm);
  return {posed.point[Index(point)], 0.0};
}

BodyObstacles::BodyObstacles(const Body& body, const PosedBody& posed) : height_(body.height) {
  const std::span<const TrianglePair> all(posed.triangle);
  mesh_ = {all.first(kTrunkPairCount), all.subspan(kTrunkPairCount)};
  const std::span<const Vec3> sample(posed.sample);
  box_ = {Box::Of(sample.first(kTrunkSampleCount)), Box::Of(sample.subspan(kTrunkSampleCount))};
  width_ = {0.55 * Width(body, SamplePoint::kLeftWaistSide, SamplePoint::kRightWaistSide),
            0.55 * Width(body, SamplePoint::kLeftEar, SamplePoint::kRightEar)};
}

bool BodyObstacles::Distance(std::size_t obstacle, const ArmSample& sample,
                             SignedDistance& out) const {
  if (LowerBound(obstacle, sample) > kCull * height_) return false;
  out = SmoothMeshDistance(mesh_[obstacle], sample.center, kSmoothing * height_, width_[obstacle]);
  out.distance -= sample.radius;
  return true;
}

CapsuleObstacle::CapsuleObstacle(const PosedCapsule& posed)
    : capsule(&posed),
      axis(posed.end - posed.start),
      per_square(0.0),
      middle(0.5 * (posed.start + posed.end)),
      half_length(0.0) {
  const double square = glm::dot(axis, axis);
  if (!(square > 0.0)) return;
  per_square = 1.0 / square;
  half_length = 0.5 * std::sqrt(square);
}

CapsuleObstacles CapsuleObstaclesOf(const PosedBody& posed, Limb arm) {
  const auto other = [&](std::size_t slot) {
    return CapsuleObstacle(posed.capsule[Index(OtherSegment(arm, slot))]);
  };
  return {other(0),
          other(1),
          other(2),
          other(3),
          other(4),
          other(5),
          CapsuleObstacle(posed.hand[Index(Mirror(arm))])};
}

void MeasureClearance(const Body& performer, const PosedBody& posed, Limb arm,
                      EgocentricPose::ArmClearance& out) {
  const BodyObstacles obstacles(performer, posed);
  const CapsuleObstacles capsules = CapsuleObstaclesOf(posed, arm);
  const double per_height = 1.0 / performer.height;
  for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
    const ArmSample sample = SampleOf(performer, posed, arm, s);
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      Clearance& clearance = out[s][o];
      clearance = {};
      if (o < kFirstCapsuleObstacle) {
        SignedDistance measured;
        clearance.known = obstacles.Distance(o, sample, measured);
        clearance.distance = measured.distance * per_height;
        clearance.direction_ls = NormalizedOr(measured.gradient, Vec3{0.0}) * posed.hips;
        continue;
      }
      const CapsuleObstacle& obstacle = capsules[o - kFirstCapsuleObstacle];
      const PosedCapsule& capsule = *obstacle.capsule;
      const Vec3 from_axis = obstacle.FromAxis(sample.center);
      const double reach = glm::length(from_axis);
      const double filled = capsule.radius + sample.radius;
      clearance.known = true;
      clearance.trust = reach < filled ? Smoothstep(reach / filled) : 1.0;
      clearance.distance = (reach - filled) * per_height;
      clearance.direction_ls =
          (reach > 1e-12 ? from_axis / reach : capsule.frame[1]) * capsule.frame;
    }
  }
}

}  // namespace ego
