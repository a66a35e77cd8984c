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

/// Four samples side by side.
struct SampleQuad {
  QuadVectors center;
  Quad radius;
};
constexpr std::size_t kSampleQuadCount = (kClearanceSampleCount + 3) / 4;
using SampleQuads = std::array<SampleQuad, kSampleQuadCount>;

/// What four samples have to one capsule; see Clearance.
struct ClearanceQuad {
  Quad distance;  // metres
  Quad trust;
  QuadVectors direction_ls;
};

template <class V>
EGO_LANES_INLINE void MeasureCapsule(const CapsuleObstacle& obstacle, const SampleQuad& samples,
                                     std::size_t first, ClearanceQuad& out) {
  const PosedCapsule& capsule = *obstacle.capsule;
  const V zero{};
  const V one = Splat<V>(1.0);
  const LaneVectors<V> axis = Splat<V>(obstacle.axis);
  const LaneVectors<V> offset = Load<V>(samples.center, first) - Splat<V>(capsule.start);
  const V along = Min<V>(one, Max<V>(zero, Dot(offset, axis) * Splat<V>(obstacle.per_square)));
  const LaneVectors<V> from_axis = offset - along * axis;
  const V reach = Sqrt<V>(Dot(from_axis, from_axis));
  const V filled = Splat<V>(capsule.radius) + Load<V>(samples.radius, first);
  const LaneMask<V> is_away = reach > Splat<V>(1e-12);
  const LaneVectors<V> direction = Select<V>(
      is_away, (one / Select<V>(is_away, reach, one)) * from_axis, Splat<V>(capsule.frame[1]));
  const LaneMask<V> is_inside = reach < filled;
  const V x = Select<V>(is_inside, reach / Select<V>(is_inside, filled, one), one);
  Store<V>(reach - filled, out.distance, first);
  Store<V>(x * x * x * (x * (x * Splat<V>(6.0) - Splat<V>(15.0)) + Splat<V>(10.0)), out.trust,
           first);
  Store<V>(LaneVectors<V>{Dot(direction, Splat<V>(capsule.frame[0])),
                          Dot(direction, Splat<V>(capsule.frame[1])),
                          Dot(direction, Splat<V>(capsule.frame[2]))},
           out.direction_ls, first);
}

using CapsuleClearance =
    std::array<std::array<ClearanceQuad, kSampleQuadCount>, std::tuple_size_v<CapsuleObstacles>>;

void MeasureInTwoLanes(const CapsuleObstacles& capsules, const SampleQuads& samples,
                       CapsuleClearance& out) {
  for (std::size_t o = 0; o < capsules.size(); ++o) {
    for (std::size_t q = 0; q < samples.size(); ++q) {
      MeasureCapsule<Lanes>(capsules[o], samples[q], 0, out[o][q]);
      MeasureCapsule<Lanes>(capsules[o], samples[q], 2, out[o][q]);
    }
  }
}

EGO_WIDE_LANES_TARGET
void MeasureInFourLanes(const CapsuleObstacles& capsules, const SampleQuads& samples,
                        CapsuleClearance& out) {
  for (std::size_t o = 0; o < capsules.size(); ++o) {
    for (std::size_t q = 0; q < samples.size(); ++q) {
      MeasureCapsule<WideLanes>(capsules[o], samples[q], 0, out[o][q]);
    }
  }
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
  const std::span<const TriangleQuad> all(posed.triangle);
  mesh_ = {all.first(kTrunkQuadCount), all.subspan(kTrunkQuadCount)};
  box_ = posed.box;
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
                      EgocentricPose::ArmClearance& out, LaneWidth lanes) {
  const BodyObstacles obstacles(performer, posed);
  const double per_height = 1.0 / performer.height;
  SampleQuads samples;
  for (std::size_t s = 0; s < 4 * samples.size(); ++s) {
    // The last once more at the end: no harm.
    const ArmSample sample =
        SampleOf(performer, posed, arm, std::min(s, kClearanceSampleCount - 1));
    samples[s / 4].center.Set(s % 4, sample.center);
    samples[s / 4].radius[s % 4] = sample.radius;
    if (s >= kClearanceSampleCount) continue;
    for (std::size_t o = 0; o < kFirstCapsuleObstacle; ++o) {
      SignedDistance measured;
      const bool known = obstacles.Distance(o, sample, measured);
      out[s][o] = {measured.distance * per_height, known,
                   NormalizedOr(measured.gradient, Vec3{0.0}) * posed.hips, 1.0};
    }
  }

  const CapsuleObstacles capsules = CapsuleObstaclesOf(posed, arm);
  CapsuleClearance measured;
  if (lanes == LaneWidth::kFour) {
    MeasureInFourLanes(capsules, samples, measured);
  } else {
    MeasureInTwoLanes(capsules, samples, measured);
  }
  for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
    for (std::size_t o = 0; o < capsules.size(); ++o) {
      const ClearanceQuad& quad = measured[o][s / 4];
      out[s][kFirstCapsuleObstacle + o] = {quad.distance[s % 4] * per_height, true,
                                           quad.direction_ls.At(s % 4), quad.trust[s % 4]};
    }
  }
}

}  // namespace ego
