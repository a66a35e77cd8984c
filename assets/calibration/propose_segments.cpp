// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "assets/calibration/proposal_draft.h"

namespace ego {
namespace {

constexpr std::array<double, 3> kRings = {0.25, 0.5, 0.75};  // along the bone
constexpr int kSpokes = 8;

struct Dot {
  SkinHit hit;
  double radius;
};

/// A radius that needs no skin: the template's, which knows the bone's length.
void TakeTemplate(ProposalDraft& draft, LimbSegment segment, std::string reason) {
  SegmentCalibration& target = draft.calibration.At(segment);
  target.dots.clear();
  target.radius = draft.template_body.surface.limb_radius[Index(segment)];
  target.state = PickState::kDoubtful;
  target.confidence = 0.25;
  target.reason = std::move(reason);
}

void ProposeSegment(ProposalDraft& draft, LimbSegment segment) {
  const Vec3 start = draft.probe.Joint(StartJoint(segment));
  const Vec3 end = draft.probe.Joint(EndJoint(segment));
  const double length = glm::distance(start, end);
  if (!(length > 1e-4 * draft.template_body.height)) {
    TakeTemplate(draft, segment, "the bone has no length");
    return;
  }
  const Vec3 axis = (end - start) / length;
  // Spokes in mirrored pairs: forward first, then away from the body on either side.
  const Vec3 forward = glm::normalize(Vec3{0.0, 0.0, 1.0} - axis.z * axis);
  Vec3 side = glm::cross(axis, forward);
  const bool left = IsLeft(LimbOf(segment));
  if (left) side = -side;

  std::vector<Dot> dots;
  int lost = 0;
  for (const double share : kRings) {
    const Vec3 origin = start + share * (end - start);
    for (int k = 0; k < kSpokes; ++k) {
      const double angle = 2.0 * kPi * k / kSpokes;
      const Vec3 direction = std::cos(angle) * forward + std::sin(angle) * side;
      const auto hit =
          draft.probe.Outward(RegionOf(segment), origin, direction, 0.35 * draft.Gap());
      // Beyond the body's middle it is the other leg's cloth, or the trunk.
      const bool crosses =
          hit && (left ? hit->position_ms.x < draft.middle_x : hit->position_ms.x > draft.middle_x);
      if (!hit || crosses) {
        ++lost;
        continue;
      }
      dots.push_back({*hit, hit->distance});
    }
  }
  const int all = static_cast<int>(kRings.size()) * kSpokes;
  if (dots.size() < 6) {
    TakeTemplate(draft, segment, "hardly any skin lies around the bone");
    return;
  }
  std::vector<double> radii;
  for (const Dot& dot : dots) radii.push_back(dot.radius);
  std::sort(radii.begin(), radii.end());
  const double median = radii[radii.size() / 2];

  SegmentCalibration& target = draft.calibration.At(segment);
  double spread = 0.0;
  for (const Dot& dot : dots) {
    if (dot.radius > 1.7 * median || dot.radius < 0.4 * median) {
      ++lost;
      continue;
    }
    CalibrationPoint point;
    ProposalDraft::Put(point, dot.hit, 0.9, "");
    target.dots.push_back(point);
    spread += std::abs(dot.radius - median);
  }
  spread /= static_cast<double>(target.dots.size()) * median;
  target.confidence = std::clamp(0.95 - 0.8 * lost / all - 0.5 * spread, 0.05, 1.0);
  if (lost > all / 3) target.reason = "much of the ring around the bone is open or another piece";
  const double usual = draft.template_body.surface.limb_radius[Index(segment)];
  if (median > 2.5 * usual || median < 0.35 * usual) {
    target.confidence *= 0.6;
    target.reason = median > usual ? "very thick for a bone of this length: perhaps cloth"
                                   : "very thin for a bone of this length";
  }
  target.state = target.confidence < kDoubtBelow ? PickState::kDoubtful : PickState::kProposed;
}

}  // namespace

void ProposeSegments(ProposalDraft& draft) {
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    ProposeSegment(draft, static_cast<LimbSegment>(s));
  }
}

}  // namespace ego
