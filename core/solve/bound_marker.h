// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/math.h"
#include "core/skeleton/pose.h"
#include "core/solve/posture.h"

namespace ego {

/// How skin follows the bones around it, as shares of what they do (0: rigid on its own bone).
enum class SkinShare : std::uint8_t {
  kWithParent,  // carried by the parent joint's bone: thigh skin held back by the pelvis
  kWithChild,   // carried by the child's bone: skin over the shoulder drawn along by the arm
  kOffTwist,    // of its own bone's twist about its length, not followed
};
inline constexpr std::size_t kSkinShareCount = 3;
using SkinShares = std::array<double, kSkinShareCount>;

/// How skin slides over its bone as joints turn, metres per radian in the bone's frame (soft tissue
/// artefact as a linear function of the joint angles: Camomilla et al., J. Biomech. 46, 2013):
/// first by its own joint, then by each joint that hangs on its bone. Of each, the three
/// axes of its turn, and the square of the turn: a hip bent far slides less per radian.
inline constexpr std::size_t kSlideJoints = 4;
inline constexpr std::size_t kSlidesPerJoint = 4;
inline constexpr std::size_t kSlideCount = kSlidesPerJoint * kSlideJoints;
using SkinSlides = std::array<Vec3, kSlideCount>;

/// The turn of a joint from the neutral posture as slides see it: its rotation vector for turns up
/// to a right angle (2 sin(a/2)), going back to zero at half a turn, so that it has no jump.
struct JointTurn {
  Vec3 value{0.0};
  Mat3 gradient{0.0};  // d value / d delta of q exp(delta)
};
JointTurn TurnOf(HumanoidJoint joint, const Quat& rotation_ls);

/// A marker's place on a performer's skeleton.
struct BoundMarker {
  std::size_t label = 0;                       // index into the frames' points
  HumanoidJoint joint = HumanoidJoint::kHips;  // carries it
  Vec3 offset_ls{0.0};                         // from the joint, canonical pose, metres
  HumanoidJoint child = HumanoidJoint::kHips;  // of `joint`; unused while its share is zero
  SkinShares share{};
  SkinSlides slide{};
  bool slides = false;            // any of `slide` is not zero
  Quat foot_rest_ls = kIdentity;  // of its foot, where its turn counts as none

  double Share(SkinShare which) const { return share[static_cast<std::size_t>(which)]; }
};

/// The same skin on a foot whose frame is turned: rotation_ls * conjugate(level) for what was
/// rotation_ls, and what hangs on it turned along. For markers of shin, foot and toes.
void TurnFootFrame(HumanoidJoint foot, const Quat& level, BoundMarker& marker);

/// Where a posed skeleton takes a marker: linear blend skinning between its bone and the two
/// beside it, less a share of its own bone's twist.
struct CarriedMarker {
  Vec3 point_ws{0.0};
  Vec3 own_ws{0.0};     // as its own bone alone takes it
  Vec3 parent_ws{0.0};  // as the parent's bone would; valid while there is a parent
  Vec3 child_ws{0.0};   // as the child's bone would; own_ws without a child
  Vec3 bone_ws{0.0};    // direction of its limb bone; zero elsewhere
  double twist = 0.0;   // sine of the bone's twist; zero outside limbs
  Vec3 slid_ws{0.0};    // how far it slid, a part of point_ws
};

CarriedMarker Carry(const BoundMarker& marker, const ModelPose& pose);

/// The joints whose turns make a marker on this one's bone slide: itself, then those that hang on
/// it. Hips where there is none, as they have no turn of their own.
const std::array<HumanoidJoint, kSlideJoints>& SlideJoints(HumanoidJoint joint);

/// The turns that a marker's slides are per radian of; zero where there is no such joint.
std::array<double, kSlideCount> SlideTurns(const BoundMarker& marker, const ModelPose& pose);

/// Position of a marker on a posed skeleton, world space.
Vec3 MarkerPosition(const BoundMarker& marker, const ModelPose& pose);

/// The degrees of freedom that move a marker, ascending.
std::span<const std::uint8_t> Chain(const BoundMarker& marker);

/// d(position) / d(dof), in the order of Chain(marker).
void MarkerJacobian(const BoundMarker& marker, const CarriedMarker& placed, const ModelPose& pose,
                    const std::array<Vec3, kPoseDof>& axis_ws,
                    std::array<Vec3, kPoseDof>& column_ws);

/// d(position) / d(offset_ls).
Mat3 OffsetJacobian(const BoundMarker& marker, const CarriedMarker& placed, const ModelPose& pose);

/// d(position) / d(share).
std::array<Vec3, kSkinShareCount> ShareJacobian(const BoundMarker& marker,
                                                const CarriedMarker& placed, const ModelPose& pose);

}  // namespace ego
