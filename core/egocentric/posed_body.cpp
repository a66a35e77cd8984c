// SPDX-License-Identifier: MIT
#include "core/egocentric/posed_body.h"

#include <algorithm>
#include <cmath>

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

/// Whether a pair of triangles looks up or down on the template, so that +Y says nothing about its
/// plane.
const std::array<bool, kTrianglePairCount>& LooksUpOrDown() {
  static const std::array<bool, kTrianglePairCount> kAll = [] {
    const Body body = TemplateBody();
    std::array<bool, kTrianglePairCount> all{};
    for (std::size_t t = 0; t < kTrianglePairCount; ++t) {
      const SampleTriangle& s = SampleTriangles()[2 * t];
      const auto at = [&](std::size_t k) { return body.surface.sample_ms[Index(s[k])]; };
      all[t] = std::abs(Triangle::Of(at(0), at(1), at(2)).normal.y) > 0.8;
    }
    return all;
  }();
  return kAll;
}

TangentPair TangentFrames(bool vertical, const Lanes3& normal, const Mat3& hips) {
  const Vec3& along_first = vertical ? hips[2] : hips[1];
  const Vec3& otherwise = vertical ? hips[1] : hips[2];
  const Lanes3 first = Splat(along_first);
  const Lanes3 part = first - Dot(first, normal) * normal;
  const Lanes length = Sqrt<Lanes>(Dot(part, part));
  const LaneMask<Lanes> is_long = length > Splat(1e-12);
  TangentPair frame;
  frame.along = (Splat(1.0) / Select<Lanes>(is_long, length, Splat(1.0))) * part;
  for (std::size_t lane = 0; lane < kLaneCount<Lanes>; ++lane) {
    if (is_long[lane]) continue;
    const Vec3 along = NormalizedOr(Perpendicular(otherwise, normal.At(lane)), otherwise);
    frame.along.x[lane] = along.x;
    frame.along.y[lane] = along.y;
    frame.along.z[lane] = along.z;
  }
  frame.third = Cross(normal, frame.along);
  return frame;
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

void PlaceTriangles(const Body& body, const BodyConstants& constants, PosedBody& posed) {
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
  posed.hips = glm::mat3_cast(posed.pose.rotation_ws[0]);
  const std::array<bool, kTrianglePairCount>& vertical = LooksUpOrDown();
  const std::array<SampleTriangle, kTriangleCount>& corners = SampleTriangles();
  for (std::size_t t = 0; t < kTrianglePairCount; ++t) {
    const auto corner = [&](std::size_t k) {
      return Pair(sample[Index(corners[2 * t][k])], sample[Index(corners[2 * t + 1][k])]);
    };
    posed.triangle[t] = MakeTrianglePair(corner(0), corner(1), corner(2));
    posed.tangent[t] = TangentFrames(vertical[t], posed.triangle[t].normal, posed.hips);
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
  const Lanes3 both = Splat(by);
  for (TrianglePair& triangle : posed.triangle) {
    triangle.a += both;
    triangle.center += both;
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
  posed.bone_direction[0] = Vec3{0.0};
  for (std::size_t j = 1; j < kJointCount; ++j) {
    posed.bone_direction[j] = NormalizedOr(
        posed.pose.position_ws[j] - posed.pose.position_ws[Index(kParent[j])], Vec3{0.0});
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto point = static_cast<LimbPoint>(kLimbJointCount + k);
    posed.bone_direction[kJointCount + k] =
        NormalizedOr(posed.point[Index(point)] - posed.pose.Position(JointOf(point)), Vec3{0.0});
  }
}

}  // namespace ego
