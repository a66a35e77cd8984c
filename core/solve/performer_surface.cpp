// SPDX-License-Identifier: MIT
#include "core/solve/performer_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/geometry/closest_point.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kTemplateHeight = 1.78;
constexpr double kMarkerRadius = 0.010;  // centre above the skin
constexpr double kStandoff = 0.015;      // centre of a marker above the crude mesh
constexpr double kReach = 0.12;          // how far a marker's pull spreads, template size
constexpr double kMaxPull = 0.030;       // farthest a trunk sample moves, template size
constexpr double kMaxHeadPull = 0.012;   // head markers sit on bands and caps
constexpr double kMinRadius = 0.85;      // of the template's limb radius
constexpr double kMaxRadius = 1.15;
constexpr double kMinFoot = 0.90;  // of the template's foot length
constexpr double kMaxFoot = 1.10;

struct PlacedMarker {
  const SetMarker* place = nullptr;
  Vec3 position_ms{0.0};  // fitted, canonical pose, performer's size
};

std::vector<PlacedMarker> PlaceMarkers(const SkeletonFit& fit, const MarkerSet& set) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(fit.model.skeleton);
  std::vector<PlacedMarker> placed;
  for (std::size_t i = 0; i < fit.model.markers.size(); ++i) {
    const BoundMarker& marker = fit.model.markers[i];
    placed.push_back(
        {&set.markers[fit.set_marker[i]], canonical[Index(marker.joint)] + marker.offset_ls});
  }
  return placed;
}

Vec3 Reflected(const Vec3& v) { return {-v.x, v.y, v.z}; }

/// Distance of a point from the crude trunk or head mesh in the canonical pose, positive outside.
double Standoff(const Body& body, const Vec3& point, bool head) {
  const std::size_t first = head ? kTrunkTriangleCount : 0;
  const std::size_t last = head ? kTriangleCount : kTrunkTriangleCount;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = first; t < last; ++t) {
    const SampleTriangle& corners = SampleTriangles()[t];
    const auto corner = [&](std::size_t k) { return body.surface.sample_ms[Index(corners[k])]; };
    const Triangle triangle = Triangle::Of(corner(0), corner(1), corner(2));
    const Vec3 away = point - AtBarycentric(triangle, ClosestOnTriangle(triangle, point));
    const double distance = glm::length(away);
    if (distance >= std::abs(nearest)) continue;
    nearest = glm::dot(away, triangle.normal) < 0.0 ? -distance : distance;
  }
  return nearest;
}

/// How far the surface should move outward for a marker that stands off this far. The crude mesh
/// cuts corners, so a marker may stand off by anything between its own thickness and what it
/// does on the template without the template being wrong.
double WantedPull(double standoff, double on_template) {
  const double least = std::min(kStandoff, on_template);
  const double most = std::max(kStandoff, on_template);
  return standoff - std::clamp(standoff, least, most);
}

/// Where the surface faces at a place of the template: away from the trunk's or head's axis.
Vec3 Outward(const Vec3& place, bool head) {
  Vec3 out = head ? place - Vec3{0.0, 1.66, 0.0} : Vec3{place.x, 0.0, place.z + 0.02};
  // Flat in depth: a trunk is wider than deep, so depth counts for more.
  if (!head) out.z *= 2.0;
  const double length = glm::length(out);
  return length < 1e-6 ? Vec3{0.0, 0.0, -1.0} : out / length;
}

void PullSamples(const std::vector<PlacedMarker>& markers, const Body& average, double scale,
                 Body& body) {
  struct Pull {
    Vec3 place;  // template
    double outward;
    double weight;
    bool head;
  };
  std::vector<Pull> pulls;
  for (const PlacedMarker& marker : markers) {
    const MarkerRegion region = marker.place->region;
    if (region != MarkerRegion::kTrunk && region != MarkerRegion::kHead) continue;
    // Shoulder markers ride on the clavicles and tell nothing of the trunk's girth.
    if (marker.place->joint == J::kLeftShoulder || marker.place->joint == J::kRightShoulder) {
      continue;
    }
    const bool head = region == MarkerRegion::kHead;
    const Vec3& place = marker.place->position_ms;
    const double outward = WantedPull(Standoff(body, marker.position_ms, head),
                                      scale * Standoff(average, place, head));
    const double weight = 1.0 / (marker.place->sigma * marker.place->sigma);
    pulls.push_back({place, outward, weight, head});
    pulls.push_back({Reflected(place), outward, weight, head});
  }
  if (pulls.empty()) return;
  // Pull of the template itself, so that a lone far marker moves its surroundings only in part.
  constexpr double kInertia = 1.0 / (0.04 * 0.04);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const bool head = IsHead(static_cast<SamplePoint>(i));
    const Vec3& place = average.surface.sample_ms[i];
    double sum = 0.0;
    double total = kInertia;
    for (const Pull& pull : pulls) {
      if (pull.head != head) continue;
      const double d = glm::distance(place, pull.place) / kReach;
      const double weight = pull.weight * std::exp(-0.5 * d * d);
      sum += weight * pull.outward;
      total += weight;
    }
    const double limit = scale * (head ? kMaxHeadPull : kMaxPull);
    const double outward = std::clamp(sum / total, -limit, limit);
    Vec3 out = Outward(place, head);
    if (Mirror(static_cast<SamplePoint>(i)) == static_cast<SamplePoint>(i)) out.x = 0.0;
    body.surface.sample_ms[i] += outward * out;
  }
}

double DistanceToBone(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 axis = b - a;
  const double t = glm::dot(point - a, axis) / std::max(1e-12, glm::dot(axis, axis));
  return glm::distance(point, a + std::clamp(t, 0.0, 1.0) * axis);
}

void FitRadii(const std::vector<PlacedMarker>& markers, const Body& average, double scale,
              Body& body) {
  const std::array<Vec3, kJointCount> from = CanonicalPositions(average.skeleton);
  const std::array<Vec3, kJointCount> to = CanonicalPositions(body.skeleton);
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    double seen = 0.0;
    double expected = 0.0;
    for (const PlacedMarker& marker : markers) {
      if (marker.place->region != MarkerRegion::kLimb) continue;
      for (const J joint : {StartJoint(segment), Mirror(StartJoint(segment))}) {
        if (marker.place->joint != joint) continue;
        const J end = joint == StartJoint(segment) ? EndJoint(segment) : Mirror(EndJoint(segment));
        seen +=
            DistanceToBone(marker.position_ms, to[Index(joint)], to[Index(end)]) - kMarkerRadius;
        expected += scale * (DistanceToBone(marker.place->position_ms, from[Index(joint)],
                                            from[Index(end)]) -
                             kMarkerRadius);
      }
    }
    if (expected <= 0.0) continue;
    // Half-way: wands, plates and clothes stand off the skin, and offsets are estimates themselves.
    const double factor = 0.5 * (1.0 + seen / expected);
    body.surface.limb_radius[s] *= std::clamp(factor, kMinRadius, kMaxRadius);
  }
}

void FitFeet(const std::vector<PlacedMarker>& markers, double scale, Body& body) {
  // Length from the hindmost to the foremost foot marker, compared with the template's places.
  double seen = 0.0;
  double expected = 0.0;
  for (const J foot : {J::kLeftFoot, J::kRightFoot}) {
    const PlacedMarker* hind = nullptr;
    const PlacedMarker* fore = nullptr;
    for (const PlacedMarker& marker : markers) {
      if (marker.place->region != MarkerRegion::kFoot || marker.place->joint != foot) continue;
      const auto z = [](const PlacedMarker* m) { return m->place->position_ms.z; };
      if (hind == nullptr || z(&marker) < z(hind)) hind = &marker;
      if (fore == nullptr || z(&marker) > z(fore)) fore = &marker;
    }
    if (hind == nullptr || fore->place->position_ms.z - hind->place->position_ms.z < 0.12) continue;
    seen += fore->position_ms.z - hind->position_ms.z;
    expected += scale * (fore->place->position_ms.z - hind->place->position_ms.z);
  }
  if (expected <= 0.0) return;
  const double factor = std::clamp(seen / expected, kMinFoot, kMaxFoot);
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
  for (std::size_t side = 0; side < 2; ++side) {
    const double ankle = canonical[Index(side == 0 ? J::kLeftFoot : J::kRightFoot)].z;
    FootSurface& foot = body.surface.foot[side];
    for (Vec3* point : {&foot.heel_ms, &foot.ball_ms, &foot.toe_tip_ms}) {
      point->z = ankle + factor * (point->z - ankle);
    }
  }
}

}  // namespace

Body PerformerBody(std::string name, const SkeletonFit& fit, const MarkerSet& set) {
  const Body average = TemplateBody(kTemplateHeight);
  const std::array<Vec3, kJointCount> from = CanonicalPositions(average.skeleton);
  const std::array<Vec3, kJointCount> to = CanonicalPositions(fit.model.skeleton);
  const double above_head_joint = kTemplateHeight - from[Index(J::kHead)].y;
  Body body = BodyFromSkeleton(std::move(name), fit.model.skeleton,
                               to[Index(J::kHead)].y + fit.scale * above_head_joint);
  const std::vector<PlacedMarker> markers = PlaceMarkers(fit, set);
  PullSamples(markers, average, fit.scale, body);
  FitRadii(markers, average, fit.scale, body);
  FitFeet(markers, fit.scale, body);
  return body;
}

}  // namespace ego
