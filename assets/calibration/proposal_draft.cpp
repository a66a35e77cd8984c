// SPDX-License-Identifier: MIT
#include "assets/calibration/proposal_draft.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/avatar_body.h"

namespace ego {

using J = HumanoidJoint;

ProposalDraft::ProposalDraft(const Character& character, const SkinProbe& skin)
    : probe(skin), template_body(TemplateBodyOf(character)) {
  const auto middle = [&](J left, J right) { return 0.5 * (skin.Joint(left) + skin.Joint(right)); };
  const auto half_width = [&](J left, J right) {
    return 0.5 * std::abs(skin.Joint(left).x - skin.Joint(right).x);
  };
  hip_height = middle(J::kLeftUpperLeg, J::kRightUpperLeg).y;
  shoulder_height = middle(J::kLeftUpperArm, J::kRightUpperArm).y;
  shoulder_half_width = half_width(J::kLeftUpperArm, J::kRightUpperArm);
  hip_half_width = half_width(J::kLeftUpperLeg, J::kRightUpperLeg);
  trunk_length = std::max(shoulder_height - hip_height, 0.05 * template_body.height);
  middle_x = middle(J::kLeftUpperArm, J::kRightUpperArm).x;
  calibration.mesh_hash = MeshHash(character);
}

Vec3 ProposalDraft::At(SamplePoint p) const {
  const CalibrationPoint& point = calibration.At(p);
  return point.state == PickState::kMissing ? TemplateAt(p) : probe.PositionOf(point.place);
}

void ProposalDraft::Put(CalibrationPoint& point, const SkinHit& hit, double confidence,
                        std::string reason) {
  point.place = hit.place;
  point.confidence = std::clamp(confidence, 0.0, 1.0);
  point.state = point.confidence < kDoubtBelow ? PickState::kDoubtful : PickState::kProposed;
  point.reason = std::move(reason);
}

void ProposalDraft::PutNearest(CalibrationPoint& point, SkinRegion region, const Vec3& wanted,
                               std::string reason) const {
  // What belongs in the middle stays there: by turns the nearest skin and the middle plane.
  const bool in_middle = std::abs(wanted.x - middle_x) < 1e-6 * template_body.height;
  std::optional<SkinHit> hit = probe.Nearest(region, wanted);
  for (int round = 0; hit && in_middle && round < 12; ++round) {
    hit = probe.Nearest(region, {middle_x, hit->position_ms.y, hit->position_ms.z});
  }
  if (hit) {
    Put(point, *hit, 0.3, std::move(reason));
    return;
  }
  hit = probe.NearestAnywhere(wanted);
  if (hit) Put(point, *hit, 0.1, std::move(reason));
}

}  // namespace ego
