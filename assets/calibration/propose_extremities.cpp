// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "assets/calibration/proposal_draft.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr Vec3 kDown{0.0, -1.0, 0.0};
constexpr double kPalmShare = 0.42;  // of the hand's length, from the wrist

struct Range {
  double low = 1e300;
  double high = -1e300;
  void Add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  bool Empty() const { return low > high; }
  double Size() const { return high - low; }
  double At(double share) const { return low + share * (high - low); }
};

/// Area-weighted middle of the faces that `use` accepts.
template <class Use>
bool MiddleOf(const std::vector<SkinProbe::Face>& faces, const Use& use, Vec3* middle) {
  Vec3 sum{0.0};
  double area = 0.0;
  for (const SkinProbe::Face& face : faces) {
    const Vec3 centroid = (face.corner_ms[0] + face.corner_ms[1] + face.corner_ms[2]) / 3.0;
    if (!use(centroid)) continue;
    sum += face.area * centroid;
    area += face.area;
  }
  if (area <= 0.0) return false;
  *middle = sum / area;
  return true;
}

void TemplateHand(ProposalDraft& draft, std::size_t side, const std::string& reason) {
  HandCalibration& hand = draft.calibration.hand[side];
  const HandSurface& usual = draft.template_body.surface.hand[side];
  const SkinRegion region =
      side == 0 ? RegionOf(LimbSegment::kLeftForearm) : RegionOf(LimbSegment::kRightForearm);
  draft.PutNearest(hand.palm, region, usual.palm_ms, reason);
  draft.PutNearest(hand.back_of_hand, region,
                   usual.palm_ms + Vec3{0.0, 2.0 * usual.half_thickness, 0.0}, reason);
  draft.PutNearest(hand.fingertip, region, usual.fingertip_ms, reason);
  hand.half_thickness = usual.half_thickness;
}

void ProposeHand(ProposalDraft& draft, std::size_t side) {
  const bool left = side == 0;
  const double sign = left ? 1.0 : -1.0;
  const J joint = left ? J::kLeftHand : J::kRightHand;
  const Vec3 wrist = draft.probe.Joint(joint);
  SkinRegion region = left ? SkinRegion::kLeftHand : SkinRegion::kRightHand;
  bool on_forearm = false;
  if (draft.probe.Faces(region).empty()) {
    region = RegionOf(left ? LimbSegment::kLeftForearm : LimbSegment::kRightForearm);
    on_forearm = true;
  }
  const auto& faces = draft.probe.Faces(region);
  const auto along = [&](const Vec3& p) { return sign * (p.x - wrist.x); };

  Range reach;
  for (const auto& face : faces) {
    for (const Vec3& p : face.corner_ms) {
      if (along(p) > 0.0) reach.Add(along(p));
    }
  }
  const double length = reach.Empty() ? 0.0 : reach.high;
  if (length < 0.02 * draft.trunk_length) {
    TemplateHand(draft, side, "no skin lies beyond the wrist");
    return;
  }
  HandCalibration& hand = draft.calibration.hand[side];
  const double trust = on_forearm ? 0.6 : 0.9;
  const std::string reason = on_forearm ? "the hand's skin follows the forearm" : "";

  Vec3 middle{0.0};
  const bool has_palm = MiddleOf(
      faces,
      [&](const Vec3& c) { return std::abs(along(c) - kPalmShare * length) < 0.15 * length; },
      &middle);
  if (!has_palm) middle = wrist;
  middle.x = wrist.x + sign * kPalmShare * length;
  const double gap = 0.15 * length;
  const auto palm = draft.probe.Outward(region, middle, kDown, gap);
  const auto back = draft.probe.Outward(region, middle, kUp, gap);
  if (palm && back) {
    ProposalDraft::Put(hand.palm, *palm, trust, reason);
    ProposalDraft::Put(hand.back_of_hand, *back, trust, reason);
  } else {
    const double half = 0.09 * length;
    draft.PutNearest(hand.palm, region, middle + half * kDown, "the hand is open here");
    draft.PutNearest(hand.back_of_hand, region, middle + half * kUp, "the hand is open here");
  }

  Vec3 tip{0.0};
  MiddleOf(
      faces, [&](const Vec3& c) { return along(c) > 0.93 * length; }, &tip);
  if (tip == Vec3{0.0}) tip = middle;
  tip.x = wrist.x + sign * 0.985 * length;
  auto fingertip = draft.probe.Outward(region, tip, kDown, gap);
  if (!fingertip) fingertip = draft.probe.Nearest(region, tip);
  ProposalDraft::Put(hand.fingertip, *fingertip, trust, reason);
}

void ProposeFoot(ProposalDraft& draft, std::size_t side) {
  const bool left = side == 0;
  const Vec3 ankle = draft.probe.Joint(left ? J::kLeftFoot : J::kRightFoot);
  const Vec3 toes = draft.probe.Joint(left ? J::kLeftToes : J::kRightToes);
  SkinRegion region = left ? SkinRegion::kLeftFoot : SkinRegion::kRightFoot;
  double trust = 0.9;
  std::string reason;
  if (draft.probe.Faces(region).empty()) {
    region = RegionOf(left ? LimbSegment::kLeftCalf : LimbSegment::kRightCalf);
    trust = 0.5;
    reason = "no skin follows the foot joint";
  }
  FootCalibration& foot = draft.calibration.foot[side];
  const FootSurface& usual = draft.template_body.surface.foot[side];
  const auto& faces = draft.probe.Faces(region);
  Range height;
  for (const auto& face : faces) {
    for (const Vec3& p : face.corner_ms) height.Add(p.y);
  }
  if (height.Empty()) {
    draft.PutNearest(foot.heel, region, usual.heel_ms, "no skin follows the leg");
    draft.PutNearest(foot.ball, region, usual.ball_ms, "no skin follows the leg");
    draft.PutNearest(foot.toe_tip, region, usual.toe_tip_ms, "no skin follows the leg");
    return;
  }
  // The sole's length: of what lies near the ground, so that a wide boot's top does not count.
  const double sole_top = height.low + 0.4 * std::max(ankle.y - height.low, 0.25 * height.Size());
  Range depth;
  for (const auto& face : faces) {
    for (const Vec3& p : face.corner_ms) {
      if (p.y <= sole_top) depth.Add(p.z);
    }
  }
  const double length = depth.Size();
  const auto middle_at = [&](double z, double half) {
    Vec3 middle{0.0};
    const bool found = MiddleOf(
        faces, [&](const Vec3& c) { return c.y <= sole_top && std::abs(c.z - z) < half; }, &middle);
    return found ? middle.x : ankle.x;
  };
  const auto put_under = [&](CalibrationPoint& point, double z) {
    const Vec3 above{middle_at(z, 0.12 * length), sole_top, z};
    auto hit = draft.probe.Outward(region, above, kDown, 0.1 * length);
    double confidence = trust;
    if (!hit || hit->position_ms.y > sole_top) {
      hit = draft.probe.Nearest(region, {above.x, height.low, z});
      confidence *= 0.7;
    }
    ProposalDraft::Put(point, *hit, confidence, reason);
  };
  put_under(foot.heel, depth.At(0.10));
  const bool has_toes = glm::distance(toes, ankle) > 0.1 * length;
  const double ball = has_toes ? std::clamp(toes.z, depth.At(0.6), depth.At(0.8)) : depth.At(0.72);
  put_under(foot.ball, ball);
  Vec3 foremost{0.0, 0.0, -1e300};
  for (const auto& face : faces) {
    for (const Vec3& p : face.corner_ms) {
      if (p.y <= ankle.y && p.z > foremost.z) foremost = p;
    }
  }
  if (foremost.z < depth.high) foremost = {ankle.x, height.low, depth.high};
  const auto tip =
      draft.probe.Nearest(region, {middle_at(depth.high, 0.1 * length), foremost.y, foremost.z});
  ProposalDraft::Put(foot.toe_tip, *tip, trust, reason);
}

}  // namespace

void ProposeHands(ProposalDraft& draft) {
  for (std::size_t side = 0; side < 2; ++side) ProposeHand(draft, side);
}

void ProposeFeet(ProposalDraft& draft) {
  for (std::size_t side = 0; side < 2; ++side) ProposeFoot(draft, side);
}

}  // namespace ego
