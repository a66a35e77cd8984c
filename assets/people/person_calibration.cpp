// SPDX-License-Identifier: MIT
#include "assets/people/person_calibration.h"

#include "core/base/check.h"
#include "core/model/mesh_bvh.h"
#include "core/model/mesh_point.h"

namespace ego {
namespace {

CalibrationPoint Picked(const MeshBvh& skin, const Vec3& point_ms) {
  const auto hit = skin.Nearest(point_ms);
  EGO_CHECK(hit.has_value());
  CalibrationPoint point;
  point.place = hit->place;
  point.state = PickState::kPicked;
  point.confidence = 1.0;
  return point;
}

}  // namespace

AvatarCalibration CalibrationOf(const Person& person) {
  const MeshBvh skin(person.character, CanonicalMesh(person.character));
  const BodySurface& surface = person.body.surface;
  AvatarCalibration calibration;
  calibration.mesh_hash = MeshHash(person.character);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    calibration.sample[i] = Picked(skin, surface.sample_ms[i]);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    calibration.segment[s].radius = surface.limb_radius[s];
    calibration.segment[s].state = PickState::kPicked;
    calibration.segment[s].confidence = 1.0;
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const HandSurface& hand = surface.hand[side];
    calibration.hand[side].palm = Picked(skin, hand.palm_ms);
    // Across the hand at its measured thickness.
    calibration.hand[side].back_of_hand =
        Picked(skin, hand.palm_ms - 2.0 * hand.half_thickness * hand.palm_normal_ms);
    calibration.hand[side].fingertip = Picked(skin, hand.fingertip_ms);
    calibration.hand[side].half_thickness = hand.half_thickness;
    const FootSurface& foot = surface.foot[side];
    calibration.foot[side].heel = Picked(skin, foot.heel_ms);
    calibration.foot[side].ball = Picked(skin, foot.ball_ms);
    calibration.foot[side].toe_tip = Picked(skin, foot.toe_tip_ms);
  }
  return calibration;
}

}  // namespace ego
