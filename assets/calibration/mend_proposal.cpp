// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "assets/calibration/crude_mesh.h"
#include "assets/calibration/proposal_draft.h"

namespace ego {
namespace {

using S = SamplePoint;

SkinRegion RegionFor(S point) {
  switch (point) {
    case S::kPubis:
    case S::kSacrum:
    case S::kLeftHipSide:
    case S::kRightHipSide:
      return SkinRegion::kPelvis;
    case S::kLeftShoulderTop:
    case S::kRightShoulderTop:
      return SkinRegion::kShoulders;
    case S::kThroat:
      return SkinRegion::kHeadAndNeck;
    default:
      return IsHead(point) ? SkinRegion::kHead : SkinRegion::kTrunk;
  }
}

/// One side against the other: `mirrored` is the other side's place seen from this one.
void ReconcilePair(ProposalDraft& draft, CalibrationPoint& left, CalibrationPoint& right,
                   SkinRegion left_region, SkinRegion right_region) {
  if (left.state == PickState::kMissing || right.state == PickState::kMissing) return;
  const auto mirrored = [&](const Vec3& p) { return Vec3{2.0 * draft.middle_x - p.x, p.y, p.z}; };
  const Vec3 l = draft.probe.PositionOf(left.place);
  const Vec3 r = draft.probe.PositionOf(right.place);
  const double apart = glm::distance(l, mirrored(r));
  const double height = draft.template_body.height;
  if (apart < 0.01 * height) {
    // Each bears out the other.
    for (auto* point : {&left, &right}) {
      const double other = point == &left ? right.confidence : left.confidence;
      if (0.75 * other <= point->confidence) continue;
      point->confidence = 0.75 * other;
      if (point->confidence >= kDoubtBelow) point->state = PickState::kProposed;
    }
    return;
  }
  const auto follow = [&](CalibrationPoint& weak, const CalibrationPoint& strong, const Vec3& from,
                          SkinRegion region) {
    const auto hit = draft.probe.Nearest(region, mirrored(from));
    if (!hit) return;
    ProposalDraft::Put(weak, *hit, 0.75 * strong.confidence, "taken over from the other side");
  };
  if (left.confidence < kDoubtBelow && right.confidence > left.confidence + 0.15) {
    follow(left, right, r, left_region);
  } else if (right.confidence < kDoubtBelow && left.confidence > right.confidence + 0.15) {
    follow(right, left, l, right_region);
  } else {
    // The farther apart, the less either is believed; only one of them need be wrong.
    const double doubt = std::clamp((apart / height - 0.01) / 0.04, 0.0, 1.0);
    for (CalibrationPoint* point : {&left, &right}) {
      point->confidence *= 1.0 - 0.5 * doubt;
      if (point->confidence < kDoubtBelow) point->state = PickState::kDoubtful;
      if (doubt > 0.5) point->reason = "left and right differ";
    }
  }
}

}  // namespace

void ReconcileSides(ProposalDraft& draft) {
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    const auto left = static_cast<S>(i);
    const S right = Mirror(left);
    if (Index(right) <= i) continue;
    ReconcilePair(draft, draft.calibration.At(left), draft.calibration.At(right), RegionFor(left),
                  RegionFor(right));
  }
  auto& [left_hand, right_hand] = draft.calibration.hand;
  constexpr SkinRegion kLeft = SkinRegion::kLeftHand;
  constexpr SkinRegion kRight = SkinRegion::kRightHand;
  ReconcilePair(draft, left_hand.palm, right_hand.palm, kLeft, kRight);
  ReconcilePair(draft, left_hand.back_of_hand, right_hand.back_of_hand, kLeft, kRight);
  ReconcilePair(draft, left_hand.fingertip, right_hand.fingertip, kLeft, kRight);
  auto& [left_foot, right_foot] = draft.calibration.foot;
  constexpr SkinRegion kLeftSole = SkinRegion::kLeftFoot;
  constexpr SkinRegion kRightSole = SkinRegion::kRightFoot;
  ReconcilePair(draft, left_foot.heel, right_foot.heel, kLeftSole, kRightSole);
  ReconcilePair(draft, left_foot.ball, right_foot.ball, kLeftSole, kRightSole);
  ReconcilePair(draft, left_foot.toe_tip, right_foot.toe_tip, kLeftSole, kRightSole);

  for (const LimbSegment left : {LimbSegment::kLeftUpperArm, LimbSegment::kLeftForearm,
                                 LimbSegment::kLeftThigh, LimbSegment::kLeftCalf}) {
    SegmentCalibration& l = draft.calibration.At(left);
    SegmentCalibration& r = draft.calibration.At(static_cast<LimbSegment>(Index(left) + 2));
    const auto follow = [](SegmentCalibration& weak, const SegmentCalibration& strong) {
      weak.dots.clear();
      weak.radius = strong.radius;
      weak.confidence = 0.75 * strong.confidence;
      weak.state = weak.confidence < kDoubtBelow ? PickState::kDoubtful : PickState::kProposed;
      weak.reason = "taken over from the other side";
    };
    if (l.confidence < kDoubtBelow && r.confidence > l.confidence + 0.3) follow(l, r);
    if (r.confidence < kDoubtBelow && l.confidence > r.confidence + 0.3) follow(r, l);
  }
}

void MendTriangles(ProposalDraft& draft) {
  constexpr double kSound = 0.05;
  constexpr std::array<double, 4> kTowardsTemplate = {0.3, 0.5, 0.75, 1.0};
  const auto soundness = [&] {
    SamplePlaces places;
    for (std::size_t i = 0; i < kSampleCount; ++i) places[i] = draft.At(static_cast<S>(i));
    return Soundness(places, draft.template_body.surface.sample_ms);
  };
  for (const double share : kTowardsTemplate) {
    const std::array<double, kTriangleCount> sound = soundness();
    std::array<bool, kSampleCount> move{};
    bool any = false;
    for (std::size_t i = 0; i < kTriangleCount; ++i) {
      if (sound[i] > kSound) continue;
      any = true;
      double least = 2.0;
      for (const S p : SampleTriangles()[i]) {
        least = std::min(least, draft.calibration.At(p).confidence);
      }
      for (const S p : SampleTriangles()[i]) {
        move[Index(p)] = move[Index(p)] || draft.calibration.At(p).confidence < least + 0.1;
      }
    }
    if (!any) return;
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      if (!move[i]) continue;
      const auto p = static_cast<S>(i);
      const Vec3 wanted = glm::mix(draft.At(p), draft.TemplateAt(p), share);
      const double before = draft.calibration.At(p).confidence;
      draft.PutNearest(draft.calibration.At(p), RegionFor(p), wanted,
                       "moved, because the crude mesh would fold here");
      CalibrationPoint& point = draft.calibration.At(p);
      point.confidence = std::min(before, 0.45);
      if (point.state != PickState::kMissing) point.state = PickState::kDoubtful;
    }
  }
  const std::array<double, kTriangleCount> sound = soundness();
  for (std::size_t i = 0; i < kTriangleCount; ++i) {
    if (sound[i] > kSound) continue;
    for (const S p : SampleTriangles()[i]) {
      CalibrationPoint& point = draft.calibration.At(p);
      point.confidence = std::min(point.confidence, 0.2);
      if (point.state != PickState::kMissing) point.state = PickState::kDoubtful;
      point.reason = "the crude mesh folds here";
    }
  }
}

}  // namespace ego
