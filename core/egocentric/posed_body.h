// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/body/body.h"
#include "core/egocentric/kinematic_path.h"
#include "core/egocentric/limb_point.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/mesh_distance.h"
#include "core/geometry/triangle_quad.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A body's own constants: what follows from its skeleton and surface alone, made once per frame.
struct BodyConstants {
  explicit BodyConstants(const Body& body);

  std::array<Vec3, kJointCount> canonical;     // joint positions, canonical pose
  std::array<double, kBoneCount> bone_length;  // metres
  /// Bone frames of the limb segments in the canonical pose: columns axis, across, third. `across`
  /// is the part of +Y (arms) or +Z (legs) at right angles to the axis, so that the frames of
  /// partners are mirror images.
  std::array<Mat3, kSegmentCount> segment_frame;
  std::array<Vec3, 4> hand_point_offset;          // wrist to palm or fingertip, canonical pose
  std::array<double, kLimbPointCount> thickness;  // a limb point's own distance to the skin, metres
};

/// A capsule in place.
struct PosedCapsule {
  Vec3 start{0.0};
  Vec3 end{0.0};
  double radius = 0.0;
  Mat3 frame{1.0};  // bone frame: axis, across, third
  Vec3 At(double t) const { return start + t * (end - start); }
};

/// The triangles are treated four by four: two and their mirror images.
inline constexpr std::size_t kTriangleQuadCount = kTriangleCount / 4;
inline constexpr std::size_t kTrunkQuadCount = kTrunkTriangleCount / 4;
static_assert(kTrunkTriangleCount % 4 == 0 && kTriangleCount % 4 == 0);

/// Tangent frames of four triangles: normal (see TriangleFields), along, third. `along` is the part
/// of the hips' +Y (of +Z for faces that look up or down in the template) at right angles to the
/// normal, so that the frames of mirrored triangles are mirror images.
struct TangentQuad {
  QuadVectors along;
  QuadVectors third;
};

/// A posed body with everything that the egocentric coordinates refer to, world space.
struct PosedBody {
  ModelPose pose;
  Mat3 hips{1.0};  // rotation of the root, the frame of displacements from trunk and head
  std::array<Vec3, kSampleCount> sample;
  std::array<Box, 2> box;  // of trunk and head
  std::array<TriangleQuad, kTriangleQuadCount> triangle;
  std::array<TangentQuad, kTriangleQuadCount> tangent;
  std::array<PosedCapsule, kSegmentCount> capsule;
  /// The hands as capsules from wrist to fingertip (palm and fingertip of one hand refer to the
  /// other's).
  std::array<PosedCapsule, 2> hand;
  std::array<Vec3, kLimbPointCount> point;
};

/// Everything in place.
void PlaceBody(const Body& body, const BodyConstants& constants, const Pose& pose,
               PosedBody& posed);

/// Directions of the bones that paths run along: unit vectors, zero for a bone without length.
using BoneDirections = std::array<Vec3, kBoneCount>;
BoneDirections BoneDirectionsOf(const PosedBody& posed);

/// Everything moved without a turn.
void MovePosedBody(const Vec3& by, PosedBody& posed);

/// A foot seen from its ankle: where the sole would be if it lay flat around whatever it stands on.
struct SoleOffset {
  Vec3 middle{0.0};  // from the ankle to the middle between heel and ball, world axes
  double low = 0.0;  // height of the lowest of both over the ankle (negative), metres
};
/// The middle is taken from the heel where the foot stands on the heel (`on_ball` 0) and from the
/// ball where it stands on the ball (1): the foot then rolls without sliding whatever its length.
/// A foot that points straight down has no direction on the ground: the middle is then the heel's
/// or ball's own place.
SoleOffset MeasureSole(const Body& body, const BodyConstants& constants, Limb leg,
                       const Quat& foot_ws, double on_ball);
/// Where the middle of the sole is in the canonical pose, seen from the root's ground point (x, z),
/// turned as the foot now points. A foot that stands does not turn, so a place that is measured
/// from here stands still on any body, however wide its hips. Fades to zero where the foot points
/// more than 60 degrees away from the hips' heading, or lies on its edge, and says nothing of it.
Vec2 StandingPlace(const Body& body, const BodyConstants& constants, Limb leg, const Quat& foot_ws,
                   const Quat& hips_ws);

/// What a foot stands on, by how far it is pitched: 0 heel, 0.5 flat, 1 ball.
double StandsOnBall(const Body& body, Limb leg, const Quat& foot_ws);

/// Samples, triangles and their frames again, from joints already in `posed.pose`. The same bits
/// for any `lanes`.
void PlaceTriangles(const Body& body, const BodyConstants& constants, PosedBody& posed,
                    LaneWidth lanes = FastestLanes());

/// The capsules, points and hand of one limb again, from joints already in `posed.pose`.
void PlaceLimb(const Body& body, const BodyConstants& constants, Limb limb, PosedBody& posed);
/// The hand of an arm alone, when nothing but its rotation changed.
void PlaceHand(const Body& body, const BodyConstants& constants, Limb arm, PosedBody& posed);

}  // namespace ego
