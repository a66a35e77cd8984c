// SPDX-License-Identifier: MIT
#include "core/model/avatar_body.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace ego {
namespace {

using J = HumanoidJoint;

/// Crown's height above the head joint, as a share of the head joint's height over the ground, of
/// an average adult; and the widest range that a humanoid is believed to have.
constexpr double kCrownAboveHead = 0.18 / 1.60;
constexpr double kLeastCrownAboveHead = 0.06;
constexpr double kMostCrownAboveHead = 1.5;

/// Top of the skin that the head joint mostly carries; nothing when there is none.
std::optional<double> HeadTop(const Character& character, const std::vector<Mat4>& skin) {
  std::optional<double> top;
  for (const MeshPart& part : character.parts) {
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      if (JointShares(character, part, v)[Index(J::kHead)] < 0.5) continue;
      const double y = SkinVertex(part, skin, v).y;
      top = top ? std::max(*top, y) : y;
    }
  }
  return top;
}

}  // namespace

Body TemplateBodyOf(const Character& character) {
  const Skeleton& skeleton = character.rig.skeleton;
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  const double head = CanonicalPositions(skeleton)[Index(J::kHead)].y;
  const double top = HeadTop(character, skin).value_or(head * (1.0 + kCrownAboveHead));
  const double height =
      std::clamp(top, head * (1.0 + kLeastCrownAboveHead), head * (1.0 + kMostCrownAboveHead));
  return BodyFromSkeleton(character.name, skeleton, height);
}

Body MakeAvatarBody(const Character& character, const AvatarCalibration& calibration) {
  return MakeAvatarBody(character, calibration, TemplateBodyOf(character));
}

Body MakeAvatarBody(const Character& character, const AvatarCalibration& calibration,
                    const Body& template_body) {
  Body body = template_body;
  const std::vector<Mat4> skin = SkinMatrices(character, character.rig.canonical_global);
  const auto known = [&](const CalibrationPoint& point) {
    return point.state != PickState::kMissing && IsOn(character, point.place);
  };
  const auto take = [&](const CalibrationPoint& point, Vec3& position) {
    if (known(point)) position = PosePoint(character, skin, point.place);
  };

  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const CalibrationPoint& point = calibration.sample[i];
    if (!known(point)) continue;
    body.surface.sample_ms[i] = PosePoint(character, skin, point.place);
    body.surface.attachment[i] = AttachmentAt(character, point.place);
  }
  if (known(calibration.At(SamplePoint::kCrown))) {
    body.height = body.surface.sample_ms[Index(SamplePoint::kCrown)].y;
  }

  AvatarCalibration measured = calibration;
  UpdateThickness(character, measured);
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    if (measured.segment[s].radius > 0.0) {
      body.surface.limb_radius[s] = measured.segment[s].radius;
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    HandSurface& hand = body.surface.hand[side];
    take(calibration.hand[side].palm, hand.palm_ms);
    take(calibration.hand[side].fingertip, hand.fingertip_ms);
    if (measured.hand[side].half_thickness > 0.0) {
      hand.half_thickness = measured.hand[side].half_thickness;
    }
    FootSurface& foot = body.surface.foot[side];
    take(calibration.foot[side].heel, foot.heel_ms);
    take(calibration.foot[side].ball, foot.ball_ms);
    take(calibration.foot[side].toe_tip, foot.toe_tip_ms);
  }
  return body;
}

}  // namespace ego
