// SPDX-License-Identifier: MIT
#include "core/egocentric/clearance.h"

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

const PosedCapsule& ObstacleCapsule(const PosedBody& posed, Limb arm, std::size_t obstacle) {
  return obstacle == kObstacleCount - 1 ? posed.hand[Index(Mirror(arm))]
                                        : posed.capsule[Index(OtherSegment(arm, obstacle - 2))];
}

void MeasureClearance(const Body& performer, const PosedBody& posed, Limb arm,
                      EgocentricPose::ArmClearance& out) {
  const BodyObstacles obstacles(performer, posed);
  for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
    const ArmSample sample = SampleOf(performer, posed, arm, s);
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      Clearance& clearance = out[s][o];
      clearance = {};
      if (o < 2) {
        SignedDistance measured;
        clearance.known = obstacles.Distance(o, sample, measured);
        clearance.distance = measured.distance / performer.height;
        continue;
      }
      const PosedCapsule& capsule = ObstacleCapsule(posed, arm, o);
      const Vec3 from_axis =
          sample.center - capsule.At(ClosestOnSegment(sample.center, capsule.start, capsule.end));
      const double reach = glm::length(from_axis);
      clearance.known = true;
      clearance.trust = Smoothstep(reach / (capsule.radius + sample.radius));
      clearance.distance = (reach - capsule.radius - sample.radius) / performer.height;
      clearance.direction_ls =
          glm::transpose(capsule.frame) * NormalizedOr(from_axis, capsule.frame[1]);
    }
  }
}

}  // namespace ego
