// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/math.h"
#include "core/skeleton/pose.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// The points a performer touches and an animator clicks (paper, section 4): the vertices of the
/// crude trunk and head meshes. Left and right partners are adjacent, left first.
enum class SamplePoint : std::uint8_t {
  // trunk, middle line
  kCollarNotch,
  kSternumBase,
  kNavel,
  kPubis,
  kNapeBase,
  kMidBack,
  kLowerBack,
  kSacrum,
  // trunk, pairs
  kLeftChest,
  kRightChest,
  kLeftBellySide,
  kRightBellySide,
  kLeftShoulderTop,
  kRightShoulderTop,
  kLeftShoulderBlade,
  kRightShoulderBlade,
  kLeftRibs,
  kRightRibs,
  kLeftWaistSide,
  kRightWaistSide,
  kLeftHipSide,
  kRightHipSide,
  // head, middle line
  kForehead,
  kCrown,
  kBackOfHead,
  kNoseTip,
  kChin,
  kThroat,
  // head, pairs
  kLeftEar,
  kRightEar,
  kLeftCheek,
  kRightCheek,
};
inline constexpr std::size_t kSampleCount = 32;
inline constexpr std::size_t kTrunkSampleCount = 22;
constexpr std::size_t Index(SamplePoint point) { return static_cast<std::size_t>(point); }

/// Stable name used in files ("leftBellySide").
std::string_view Name(SamplePoint point);
std::optional<SamplePoint> SamplePointNamed(std::string_view name);
/// One sentence for a person: where on the body the point lies.
std::string_view Description(SamplePoint point);
SamplePoint Mirror(SamplePoint point);
constexpr bool IsHead(SamplePoint point) { return Index(point) >= kTrunkSampleCount; }

/// Three samples, counter-clockwise seen from outside.
using SampleTriangle = std::array<SamplePoint, 3>;
inline constexpr std::size_t kTrunkTriangleCount = 40;
inline constexpr std::size_t kTriangleCount = 56;
/// The two closed crude meshes, trunk first, then head. Triangle 2k + 1 is the mirror image of
/// triangle 2k, with its first vertex the mirror of the first.
const std::array<SampleTriangle, kTriangleCount>& SampleTriangles();
/// Joint that carries most of a triangle: where its kinematic paths begin (section 5.2). The same
/// on every body.
HumanoidJoint ParentJoint(std::size_t triangle);

/// How a point of the surface follows the skeleton: linear blend skinning over up to four joints.
struct Attachment {
  std::array<HumanoidJoint, 4> joint{};
  std::array<double, 4> weight{1.0, 0.0, 0.0, 0.0};  // sums to one
};
/// The attachment that a sample has when nothing better (a mesh's own skin) is known.
const Attachment& TemplateAttachment(SamplePoint point);

/// Points of a hand, canonical pose, model space, metres. The hand is carried by its hand joint.
struct HandSurface {
  Vec3 palm_ms{0.0};                    // on the skin, middle of the palm
  Vec3 palm_normal_ms{0.0, -1.0, 0.0};  // outward, unit
  Vec3 fingertip_ms{0.0};               // tip of the middle finger, palm side
  double half_thickness = 0.0;          // half the hand's thickness at the palm: wrist to skin
};

/// Points of a foot, canonical pose, model space, metres. The foot is carried by its foot joint,
/// the toe tip by the toes joint.
struct FootSurface {
  Vec3 heel_ms{0.0};                    // lowest point of the heel
  Vec3 ball_ms{0.0};                    // lowest point under the ball
  Vec3 toe_tip_ms{0.0};
  Vec3 sole_normal_ms{0.0, -1.0, 0.0};  // outward, unit
};

/// The approximation of a body's skin (section 4.1): two crude meshes, eight capsules, hands, feet.
struct BodySurface {
  std::array<Vec3, kSampleCount> sample_ms{};           // canonical pose, model space, metres
  std::array<Attachment, kSampleCount> attachment{};
  std::array<double, kSegmentCount> limb_radius{};      // metres; capsule axis = the bone
  std::array<HandSurface, 2> hand{};                    // left, right
  std::array<FootSurface, 2> foot{};                    // left, right
};

/// Where the samples are when the skeleton is posed, world space.
void PoseSamples(const Skeleton& skeleton, const BodySurface& surface, const ModelPose& pose,
                 std::array<Vec3, kSampleCount>& sample_ws);

/// A point fixed to one joint, given in the canonical pose, model space, when posed.
inline Vec3 PosePoint(const std::array<Vec3, kJointCount>& canonical, const ModelPose& pose,
                      HumanoidJoint joint, const Vec3& point_ms) {
  return pose.Position(joint) + pose.Rotation(joint) * (point_ms - canonical[Index(joint)]);
}

}  // namespace ego
