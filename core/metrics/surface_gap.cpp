// SPDX-License-Identifier: MIT
#include "core/metrics/surface_gap.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/closest_point.h"

namespace ego {
namespace {

using J = HumanoidJoint;

/// Solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983).
double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

double MeshDistance(const MeasuredBody& body, const Vec3& p, std::size_t first, std::size_t end) {
  double nearest = 1e9;
  double winding = 0.0;
  Vec3 low{1e9};
  Vec3 high{-1e9};
  for (std::size_t t = first; t < end; ++t) {
    for (const SamplePoint s : SampleTriangles()[t]) {
      low = glm::min(low, body.sample_ws[Index(s)]);
      high = glm::max(high, body.sample_ws[Index(s)]);
    }
  }
  const bool may_be_inside =
      glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
  for (std::size_t t = first; t < end; ++t) {
    const SampleTriangle& s = SampleTriangles()[t];
    const Vec3& a = body.sample_ws[Index(s[0])];
    const Vec3& b = body.sample_ws[Index(s[1])];
    const Vec3& c = body.sample_ws[Index(s[2])];
    const Triangle triangle = Triangle::Of(a, b, c);
    nearest = std::min(nearest,
                       glm::distance(p, AtBarycentric(triangle, ClosestOnTriangle(triangle, p))));
    if (may_be_inside) winding += SolidAngle(a - p, b - p, c - p);
  }
  return winding > 2.0 * kPi ? -nearest : nearest;
}

double CapsuleDistance(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
  return glm::distance(p, glm::mix(a, b, ClosestOnSegment(p, a, b))) - radius;
}

}  // namespace

MeasuredBody::MeasuredBody(const Body& measured, const Pose& posture)
    : body(&measured),
      pose(ForwardKinematics(measured.skeleton, posture)),
      canonical(CanonicalPositions(measured.skeleton)) {
  PoseSamples(measured.skeleton, measured.surface, pose, sample_ws);
}

Vec3 MeasuredBody::Palm(std::size_t side) const {
  return PosePoint(canonical, pose, side == 0 ? J::kLeftHand : J::kRightHand,
                   body->surface.hand[side].palm_ms);
}
Vec3 MeasuredBody::Fingertip(std::size_t side) const {
  return PosePoint(canonical, pose, side == 0 ? J::kLeftHand : J::kRightHand,
                   body->surface.hand[side].fingertip_ms);
}
Vec3 MeasuredBody::HandEnd(std::size_t side) const {
  const HandSurface& hand = body->surface.hand[side];
  const J joint = side == 0 ? J::kLeftHand : J::kRightHand;
  const Vec3 along = hand.fingertip_ms - canonical[Index(joint)];
  return PosePoint(canonical, pose, joint,
                   hand.fingertip_ms - glm::dot(along, hand.palm_normal_ms) * hand.palm_normal_ms);
}
Vec3 MeasuredBody::Heel(std::size_t side) const {
  return PosePoint(canonical, pose, side == 0 ? J::kLeftFoot : J::kRightFoot,
                   body->surface.foot[side].heel_ms);
}
Vec3 MeasuredBody::Ball(std::size_t side) const {
  return PosePoint(canonical, pose, side == 0 ? J::kLeftFoot : J::kRightFoot,
                   body->surface.foot[side].ball_ms);
}
Vec3 MeasuredBody::ToeTip(std::size_t side) const {
  return PosePoint(canonical, pose, side == 0 ? J::kLeftToes : J::kRightToes,
                   body->surface.foot[side].toe_tip_ms);
}

double TrunkDistance(const MeasuredBody& body, const Vec3& p) {
  return MeshDistance(body, p, 0, kTrunkTriangleCount);
}
double HeadDistance(const MeasuredBody& body, const Vec3& p) {
  return MeshDistance(body, p, kTrunkTriangleCount, kTriangleCount);
}

double SurfaceGap(const MeasuredBody& body, Limb arm, const Vec3& p) {
  double gap = std::min(TrunkDistance(body, p), HeadDistance(body, p));
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    if (LimbOf(segment) == arm) continue;
    gap = std::min(gap, CapsuleDistance(p, body.pose.Position(StartJoint(segment)),
                                        body.pose.Position(EndJoint(segment)),
                                        body.body->surface.limb_radius[s]));
  }
  const MeasuredBone hand = BoneOf(body, arm, kSegmentCount);
  return std::min(gap, CapsuleDistance(p, hand.start, hand.end, hand.radius));
}

SurfacePlace NearestPlace(const MeasuredBody& body, Limb arm, const Vec3& p) {
  SurfacePlace nearest;
  double least = 1e9;
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    const SampleTriangle& s = SampleTriangles()[t];
    const Triangle triangle = Triangle::Of(body.sample_ws[Index(s[0])], body.sample_ws[Index(s[1])],
                                           body.sample_ws[Index(s[2])]);
    const Vec3 barycentric = ClosestOnTriangle(triangle, p);
    const double distance = glm::distance(p, AtBarycentric(triangle, barycentric));
    if (distance < least) {
      least = distance;
      nearest = {true, t, barycentric, 0.0};
    }
  }
  for (std::size_t k = 0; k <= kSegmentCount; ++k) {
    if (k < kSegmentCount && LimbOf(static_cast<LimbSegment>(k)) == arm) continue;
    const MeasuredBone bone = BoneOf(body, arm, k);
    const double axial = ClosestOnSegment(p, bone.start, bone.end);
    const double distance = glm::distance(p, glm::mix(bone.start, bone.end, axial)) - bone.radius;
    if (distance < least) {
      least = distance;
      nearest = {false, k, Vec3{0.0}, axial};
    }
  }
  return nearest;
}

MeasuredBone BoneOf(const MeasuredBody& body, Limb arm, std::size_t k) {
  if (k < kSegmentCount) {
    const auto segment = static_cast<LimbSegment>(k);
    return {body.pose.Position(StartJoint(segment)), body.pose.Position(EndJoint(segment)),
            body.body->surface.limb_radius[k]};
  }
  const std::size_t other = Index(Mirror(arm));
  return {body.pose.Position(JointsOf(Mirror(arm)).end), body.HandEnd(other),
          body.body->surface.hand[other].half_thickness};
}

Vec3 OnMesh(const MeasuredBody& body, const SurfacePlace& place) {
  Vec3 p{0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    p += place.barycentric[static_cast<int>(k)] *
         body.sample_ws[Index(SampleTriangles()[place.index][k])];
  }
  return p;
}

double ArmDepth(const MeasuredBody& body, Limb arm) {
  constexpr int kSteps = 8;
  double depth = 0.0;
  for (std::size_t part = 0; part < 2; ++part) {
    const auto segment = static_cast<LimbSegment>(2 * Index(arm) + part);
    const double radius = body.body->surface.limb_radius[Index(segment)];
    for (int k = part == 0 ? kSteps / 2 : 0; k <= kSteps; ++k) {
      const Vec3 p =
          glm::mix(body.pose.Position(StartJoint(segment)), body.pose.Position(EndJoint(segment)),
                   static_cast<double>(k) / kSteps);
      depth = std::max({depth, radius - TrunkDistance(body, p), radius - HeadDistance(body, p)});
    }
  }
  return depth;
}

}  // namespace ego
