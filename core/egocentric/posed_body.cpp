// SPDX-License-Identifier: MIT
#include "core/egocentric/posed_body.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/lane_math.h"
#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

using J = HumanoidJoint;

Vec3 HandPointOffset(const Body& body, const std::array<Vec3, kJointCount>& canonical,
                     LimbPoint point) {
  const std::size_t side = IsLeft(LimbOf(point)) ? 0 : 1;
  const HandSurface& hand = body.surface.hand[side];
  const bool palm = point == LimbPoint::kLeftPalm || point == LimbPoint::kRightPalm;
  return (palm ? hand.palm_ms : hand.fingertip_ms) - canonical[Index(JointOf(point))];
}

double Thickness(const Body& body, LimbPoint point) {
  if (IsHandPoint(point)) return 0.0;
  const std::size_t limb = Index(LimbOf(point));
  const double upper = body.surface.limb_radius[2 * limb];
  const double lower = body.surface.limb_radius[2 * limb + 1];
  if (Index(point) % 2 == 0) return 0.5 * (upper + lower);
  return limb < 2 ? body.surface.hand[limb].half_thickness : lower;
}

/// Which triangles look up or down on the template, so that +Y says nothing about their plane: 1,
/// the others 0.
const std::array<Quad, kTriangleQuadCount>& LooksUpOrDown() {
  static const std::array<Quad, kTriangleQuadCount> kAll = [] {
    const Body body = TemplateBody();
    std::array<Quad, kTriangleQuadCount> all{};
    for (std::size_t t = 0; t < kTriangleCount; ++t) {
      const SampleTriangle& s = SampleTriangles()[t];
      const auto at = [&](std::size_t k) { return body.surface.sample_ms[Index(s[k])]; };
      const bool vertical = std::abs(Triangle::Of(at(0), at(1), at(2)).normal.y) > 0.8;
      all[t / 4][t % 4] = vertical ? 1.0 : 0.0;
    }
    return all;
  }();
  return kAll;
}

/// Corners of four triangles.
struct CornerQuad {
  QuadVectors a;
  QuadVectors b;
  QuadVectors c;
};
using Corners = std::array<CornerQuad, kTriangleQuadCount>;

template <class V>
EGO_LANES_INLINE void PlaceQuad(const CornerQuad& corner, const Quad& looks_up_or_down,
                                std::size_t first, const Mat3& hips, TriangleQuad& triangle,
                                TangentQuad& tangent) {
  const TriangleLanes<V> placed = MakeTriangles<V>(
      Load<V>(corner.a, first), Load<V>(corner.b, first), Load<V>(corner.c, first));
  const LaneMask<V> vertical = Load<V>(looks_up_or_down, first) > Splat<V>(0.5);
  const LaneVectors<V> up = Splat<V>(hips[1]);
  const LaneVectors<V> ahead = Splat<V>(hips[2]);
  const LaneVectors<V> axis = Select<V>(vertical, ahead, up);
  const LaneVectors<V> other = Select<V>(vertical, up, ahead);
  const auto across = [&](const LaneVectors<V>& v) __attribute__((always_inline)) {
    return v - Dot(v, placed.normal) * placed.normal;
  };
  const LaneVectors<V> along = UnitOr<V>(across(axis), UnitOr<V>(across(other), other));
  Store<V>(placed, triangle, first);
  Store<V>(along, tangent.along, first);
  Store<V>(Cross(placed.normal, along), tangent.third, first);
}

void PlaceInTwoLanes(const Corners& corners, PosedBody& posed) {
  for (std::size_t q = 0; q < kTriangleQuadCount; ++q) {
    for (const std::size_t first : {0, 2}) {
      PlaceQuad<Lanes>(corners[q], LooksUpOrDown()[q], first, posed.hips, posed.triangle[q],
                       posed.tangent[q]);
    }
  }
}

EGO_WIDE_LANES_TARGET
void PlaceInFourLanes(const Corners& corners, PosedBody& posed) {
  for (std::size_t q = 0; q < kTriangleQuadCount; ++q) {
    PlaceQuad<WideLanes>(corners[q], LooksUpOrDown()[q], 0, posed.hips, posed.triangle[q],
                         posed.tangent[q]);
  }
}

}  // namespace

BodyConstants::BodyConstants(const Body& body) : canonical(CanonicalPositions(body.skeleton)) {
  bone_length[0] = 0.0;
  for (std::size_t j = 1; j < kJointCount; ++j) {
    bone_length[j] = glm::length(body.skeleton.offset[j]);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    hand_point_offset[k] =
        HandPointOffset(body, canonical, static_cast<LimbPoint>(kLimbJointCount + k));
    bone_length[kJointCount + k] = glm::length(hand_point_offset[k]);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const Limb limb = LimbOf(segment);
    const Vec3 axis =
        NormalizedOr(body.skeleton.offset[Index(EndJoint(segment))], CanonicalDirection(limb));
    const Vec3 rest = IsArm(limb) ? Vec3{0.0, 1.0, 0.0} : Vec3{0.0, 0.0, 1.0};
    const Vec3 across = NormalizedOr(Perpendicular(rest, axis), Vec3{0.0, 0.0, 1.0});
    segment_frame[s] = Mat3(axis, across, glm::cross(axis, across));
  }
  for (std::size_t p = 0; p < kLimbPointCount; ++p) {
    thickness[p] = Thickness(body, static_cast<LimbPoint>(p));
  }
}

double StandsOnBall(const Body& body, Limb leg, const Quat& foot_ws) {
  const FootSurface& foot = body.surface.foot[IsLeft(leg) ? 0 : 1];
  const double drop = (foot_ws * (foot.heel_ms - foot.ball_ms)).y;
  return Smoothstep(0.5 + drop / (0.08 * body.height));
}

SoleOffset MeasureSole(const Body& body, const BodyConstants& constants, Limb leg,
                       const Quat& foot_ws, double on_ball) {
  const FootSurface& foot = body.surface.foot[IsLeft(leg) ? 0 : 1];
  const Vec3& ankle = constants.canonical[Index(JointsOf(leg).end)];
  const Vec3 heel = foot_ws * (foot.heel_ms - ankle);
  const Vec3 ball = foot_ws * (foot.ball_ms - ankle);
  const double length = glm::distance(foot.heel_ms, foot.ball_ms);
  const Vec3 along{ball.x - heel.x, 0.0, ball.z - heel.z};
  const double level = glm::length(along);
  const Vec3 half = level > 1e-12 ? along * (0.5 * length / std::hypot(level, 0.1 * length)) *
                                        std::hypot(1.0, 0.1)
                                  : Vec3{0.0};
  return {glm::mix(heel + half, ball - half, on_ball), std::min(heel.y, ball.y)};
}

Vec2 StandingPlace(const Body& body, const BodyConstants& constants, Limb leg, const Quat& foot_ws,
                   const Quat& hips_ws) {
  const FootSurface& foot = body.surface.foot[IsLeft(leg) ? 0 : 1];
  const Vec3 middle = 0.5 * (foot.heel_ms + foot.ball_ms) - constants.canonical[0];
  const auto level = [](const Quat& rotation) {
    const Vec3 side = rotation * Vec3{1.0, 0.0, 0.0};
    const double length = std::hypot(side.x, side.z);
    return Vec2{side.x, side.z} * (std::hypot(1.0, 0.1) / std::hypot(length, 0.1));
  };
  const Vec2 side = level(foot_ws);
  const Vec2 ahead{-side.y, side.x};
  return Smoothstep(2.0 * glm::dot(side, level(hips_ws))) * (middle.x * side + middle.z * ahead);
}

void PlaceTriangles(const Body& body, const BodyConstants& constants, PosedBody& posed,
                    LaneWidth lanes) {
  std::array<Vec3, kSampleCount>& sample = posed.sample;
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const Attachment& a = body.surface.attachment[i];
    Vec3 sum{0.0};
    for (std::size_t k = 0; k < a.joint.size(); ++k) {
      if (a.weight[k] == 0.0) continue;
      sum += a.weight[k] *
             PosePoint(constants.canonical, posed.pose, a.joint[k], body.surface.sample_ms[i]);
    }
    sample[i] = sum;
  }
  const std::span<const Vec3> all(sample);
  posed.box = {Box::Of(all.first(kTrunkSampleCount)), Box::Of(all.subspan(kTrunkSampleCount))};
  posed.hips = glm::mat3_cast(posed.pose.rotation_ws[0]);
  Corners corners;
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    const SampleTriangle& s = SampleTriangles()[t];
    corners[t / 4].a.Set(t % 4, sample[Index(s[0])]);
    corners[t / 4].b.Set(t % 4, sample[Index(s[1])]);
    corners[t / 4].c.Set(t % 4, sample[Index(s[2])]);
  }
  if (lanes == LaneWidth::kFour) {
    PlaceInFourLanes(corners, posed);
  } else {
    PlaceInTwoLanes(corners, posed);
  }
}

void PlaceLimb(const Body& body, const BodyConstants& constants, Limb limb, PosedBody& posed) {
  const LimbJoints joints = JointsOf(limb);
  for (std::size_t part = 0; part < 2; ++part) {
    const auto segment = static_cast<LimbSegment>(2 * Index(limb) + part);
    PosedCapsule& capsule = posed.capsule[Index(segment)];
    capsule.start = posed.pose.Position(StartJoint(segment));
    capsule.end = posed.pose.Position(EndJoint(segment));
    capsule.radius = body.surface.limb_radius[Index(segment)];
    capsule.frame = glm::mat3_cast(posed.pose.Rotation(StartJoint(segment))) *
                    constants.segment_frame[Index(segment)];
  }
  posed.point[Index(MidPoint(limb))] = posed.pose.Position(joints.mid);
  posed.point[Index(EndPoint(limb))] = posed.pose.Position(joints.end);
  if (IsArm(limb)) PlaceHand(body, constants, limb, posed);
}

void PlaceHand(const Body& body, const BodyConstants& constants, Limb arm, PosedBody& posed) {
  const HumanoidJoint joint = JointsOf(arm).end;
  const Vec3& wrist = posed.pose.Position(joint);
  const Mat3 rotation = glm::mat3_cast(posed.pose.Rotation(joint));
  for (const LimbPoint point : {PalmPoint(arm), FingertipPoint(arm)}) {
    posed.point[Index(point)] =
        wrist + rotation * constants.hand_point_offset[Index(point) - kLimbJointCount];
  }
  PosedCapsule& hand = posed.hand[Index(arm)];
  hand.start = wrist;
  // In the middle of the hand's thickness, so that the palm lies on the capsule.
  const Vec3& tip = constants.hand_point_offset[Index(FingertipPoint(arm)) - kLimbJointCount];
  hand.end = wrist + rotation * Perpendicular(tip, body.surface.hand[Index(arm)].palm_normal_ms);
  hand.radius = body.surface.hand[Index(arm)].half_thickness;
  hand.frame = rotation * constants.segment_frame[2 * Index(arm) + 1];
}

void MovePosedBody(const Vec3& by, PosedBody& posed) {
  for (Vec3& p : posed.pose.position_ws) p += by;
  for (Vec3& p : posed.sample) p += by;
  for (Box& box : posed.box) box = {box.low + by, box.high + by};
  const auto move_four = [&](QuadVectors& four) {
    for (std::size_t k = 0; k < 4; ++k) {
      four.x[k] += by.x;
      four.y[k] += by.y;
      four.z[k] += by.z;
    }
  };
  for (TriangleQuad& triangle : posed.triangle) {
    move_four(triangle.a);
  }
  const auto move = [&](PosedCapsule& capsule) {
    capsule.start += by;
    capsule.end += by;
  };
  for (PosedCapsule& capsule : posed.capsule) move(capsule);
  for (PosedCapsule& hand : posed.hand) move(hand);
  for (Vec3& p : posed.point) p += by;
}

void PlaceBody(const Body& body, const BodyConstants& constants, const Pose& pose,
               PosedBody& posed) {
  posed.pose = ForwardKinematics(body.skeleton, pose);
  PlaceTriangles(body, constants, posed);
  for (const Limb limb : kLimbs) PlaceLimb(body, constants, limb, posed);
}

BoneDirections BoneDirectionsOf(const PosedBody& posed) {
  BoneDirections direction;
  direction[0] = Vec3{0.0};
  for (std::size_t j = 1; j < kJointCount; ++j) {
    direction[j] = NormalizedOr(
        posed.pose.position_ws[j] - posed.pose.position_ws[Index(kParent[j])], Vec3{0.0});
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto point = static_cast<LimbPoint>(kLimbJointCount + k);
    direction[kJointCount + k] =
        NormalizedOr(posed.point[Index(point)] - posed.pose.Position(JointOf(point)), Vec3{0.0});
  }
  return direction;
}

}  // namespace ego
