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
using S = SamplePoint;

constexpr Vec3 kForward{0.0, 0.0, 1.0};
constexpr Vec3 kBackward{0.0, 0.0, -1.0};

// Heights of the points of an average head, from the chin (0) to the crown (1).
constexpr double kForeheadShare = 0.62;
constexpr double kBackShare = 0.52;
constexpr double kNoseShare = 0.36;
constexpr double kEarShare = 0.43;
constexpr double kCheekShare = 0.31;
constexpr double kThroatShare = -0.10;

double AreaMedian(const std::vector<SkinProbe::Face>& faces, int axis) {
  std::vector<std::pair<double, double>> value;
  double total = 0.0;
  for (const SkinProbe::Face& face : faces) {
    const double middle =
        (face.corner_ms[0][axis] + face.corner_ms[1][axis] + face.corner_ms[2][axis]) / 3.0;
    value.emplace_back(middle, face.area);
    total += face.area;
  }
  std::sort(value.begin(), value.end());
  double sum = 0.0;
  for (const auto& [middle, area] : value) {
    sum += area;
    if (sum >= 0.5 * total) return middle;
  }
  return 0.0;
}

class HeadProposer {
 public:
  explicit HeadProposer(ProposalDraft& draft) : draft_(draft) {}

  void Run();

 private:
  void FindCentre();
  void FindCrown();
  void FindChin();
  void FindNose();
  void FindThroat();
  double Y(double share) const { return chin_.y + share * (crown_.y - chin_.y); }
  double Height() const { return crown_.y - chin_.y; }
  std::optional<SkinHit> Cast(const Vec3& origin, const Vec3& direction, double* agreement) const;
  void Put(S point, const Vec3& origin, const Vec3& direction, double trust);

  ProposalDraft& draft_;
  Vec3 centre_{0.0};
  double size_ = 0.0;  // a rough radius
  Vec3 crown_{0.0};
  Vec3 chin_{0.0};
};

std::optional<SkinHit> HeadProposer::Cast(const Vec3& origin, const Vec3& direction,
                                          double* agreement) const {
  return draft_.probe.OutwardBundle(SkinRegion::kHead, origin, direction, 0.25 * size_,
                                    0.04 * size_, agreement);
}

void HeadProposer::Put(S point, const Vec3& origin, const Vec3& direction, double trust) {
  double agreement = 0.0;
  const auto hit = Cast(origin, direction, &agreement);
  CalibrationPoint& target = draft_.calibration.At(point);
  if (!hit) {
    draft_.PutNearest(target, SkinRegion::kHead, draft_.TemplateAt(point),
                      "no skin of the head lies in the direction where it should be");
    return;
  }
  double confidence = trust * (0.55 + 0.4 * agreement);
  std::string reason;
  if (agreement < 0.6) reason = "the skin is uneven or open here";
  if (hit->loose_layer) {
    confidence -= 0.1;
    reason = "a hat, hair or another loose piece lies over the skin here";
  }
  ProposalDraft::Put(target, *hit, confidence, reason);
}

/// The middle of the skull: the median of the head's skin, then the middle between the walls that
/// rays from there meet.
void HeadProposer::FindCentre() {
  const auto& faces = draft_.probe.Faces(SkinRegion::kHead);
  const double joint_y = draft_.probe.Joint(J::kHead).y;
  centre_ = {draft_.probe.Joint(J::kHead).x, AreaMedian(faces, 1), AreaMedian(faces, 2)};
  centre_.y = std::max(centre_.y, joint_y);
  size_ = 0.0;
  double area = 0.0;
  for (const SkinProbe::Face& face : faces) {
    size_ +=
        face.area *
        glm::distance(centre_, (face.corner_ms[0] + face.corner_ms[1] + face.corner_ms[2]) / 3.0);
    area += face.area;
  }
  size_ /= area;
  double agreement = 0.0;
  const auto front = Cast(centre_, kForward, &agreement);
  const auto back = Cast(centre_, kBackward, &agreement);
  if (front && back) centre_.z += 0.5 * (front->distance - back->distance);
}

void HeadProposer::FindCrown() {
  CalibrationPoint& crown = draft_.calibration.At(S::kCrown);
  Put(S::kCrown, centre_, kUp, 1.0);
  crown_ = draft_.probe.PositionOf(crown.place);
  if (crown_.y <= centre_.y) crown_.y = centre_.y + size_;
}

/// The chin: of the skin in the middle below the face, the most forward and downward.
void HeadProposer::FindChin() {
  const double joint = draft_.probe.Joint(J::kHead).y;
  const double half = crown_.y - centre_.y;
  // The joint sits between chin and neck, on some rigs as low as the shoulders.
  const double bottom = joint - 0.3 * (crown_.y - joint);
  constexpr int kSteps = 80;
  double best = -1e300;
  std::optional<SkinHit> found;
  for (int i = 0; i < kSteps; ++i) {
    const double y = bottom + (centre_.y - bottom) * (i + 0.5) / kSteps;
    const auto hit =
        draft_.probe.Outward(SkinRegion::kHead, {centre_.x, y, centre_.z}, kForward, 0.25 * size_);
    if (!hit) continue;
    const double score = hit->position_ms.z - hit->position_ms.y;
    if (score > best) {
      best = score;
      found = hit;
    }
  }
  CalibrationPoint& chin = draft_.calibration.At(S::kChin);
  if (found) {
    ProposalDraft::Put(chin, *found, 0.8, "");
  } else {
    draft_.PutNearest(chin, SkinRegion::kHead, draft_.TemplateAt(S::kChin),
                      "no skin of the face lies below its middle");
  }
  chin_ = draft_.probe.PositionOf(chin.place);
  if (chin_.y > centre_.y - 0.2 * half) chin_.y = centre_.y - half;
}

/// The tip of the nose: what stands out most from the line between forehead and chin.
void HeadProposer::FindNose() {
  constexpr int kSteps = 60;
  const double forehead_z = draft_.At(S::kForehead).z;
  const double chin_z = chin_.z;
  double best = -1e300;
  double protrusion = 0.0;
  std::optional<SkinHit> found;
  for (int i = 0; i < kSteps; ++i) {
    const double share = 0.16 + 0.40 * (i + 0.5) / kSteps;
    const auto hit = draft_.probe.Outward(SkinRegion::kHead, {centre_.x, Y(share), centre_.z},
                                          kForward, 0.25 * size_);
    if (!hit) continue;
    const double line = glm::mix(chin_z, forehead_z, share / kForeheadShare);
    // A face without a nose has a flat score, which its usual height then decides.
    const double away = share - kNoseShare;
    const double score = hit->position_ms.z - 0.4 * line - 0.5 * Height() * away * away;
    if (score > best) {
      best = score;
      protrusion = hit->position_ms.z - line;
      found = hit;
    }
  }
  CalibrationPoint& nose = draft_.calibration.At(S::kNoseTip);
  if (!found) {
    Put(S::kNoseTip, {centre_.x, Y(kNoseShare), centre_.z}, kForward, 0.5);
    return;
  }
  const bool stands_out = protrusion > 0.03 * Height();
  ProposalDraft::Put(nose, *found, stands_out ? 0.9 : 0.6,
                     stands_out ? "" : "no nose stands out of the face");
}

/// Under the chin, half-way back to the middle of the head; where the neck is in the way, the
/// nearest skin to where that would be.
void HeadProposer::FindThroat() {
  const double z = glm::mix(centre_.z, chin_.z, 0.45);
  double agreement = 0.0;
  const auto under =
      draft_.probe.OutwardBundle(SkinRegion::kHeadAndNeck, {centre_.x, Y(0.16), z},
                                 {0.0, -1.0, 0.0}, 0.1 * size_, 0.04 * size_, &agreement);
  CalibrationPoint& throat = draft_.calibration.At(S::kThroat);
  if (under && under->position_ms.y > Y(-0.3) && under->normal_ms.y < -0.2) {
    ProposalDraft::Put(throat, *under, 0.55 + 0.35 * agreement, "");
    return;
  }
  const auto hit = draft_.probe.Nearest(SkinRegion::kHeadAndNeck, {centre_.x, Y(kThroatShare), z});
  if (hit) ProposalDraft::Put(throat, *hit, 0.6, "");
}

void HeadProposer::Run() {
  if (draft_.probe.Faces(SkinRegion::kHead).empty()) {
    for (std::size_t i = kTrunkSampleCount; i < kSampleCount; ++i) {
      draft_.PutNearest(draft_.calibration.sample[i], SkinRegion::kHeadAndNeck,
                        draft_.template_body.surface.sample_ms[i],
                        "no skin follows the head joint");
    }
    return;
  }
  FindCentre();
  FindCrown();
  FindChin();
  const Vec3 axis{centre_.x, 0.0, centre_.z};
  const auto at = [&](double share) { return axis + Vec3{0.0, Y(share), 0.0}; };
  Put(S::kForehead, at(kForeheadShare), kForward, 1.0);
  Put(S::kBackOfHead, at(kBackShare), kBackward, 1.0);
  FindNose();
  for (const double sign : {1.0, -1.0}) {
    const S ear = sign > 0.0 ? S::kLeftEar : S::kRightEar;
    const S cheek = sign > 0.0 ? S::kLeftCheek : S::kRightCheek;
    Put(ear, at(kEarShare), {sign, 0.0, 0.0}, 1.0);
    Put(cheek, at(kCheekShare), glm::normalize(Vec3{sign * 0.055, 0.0, 0.08}), 1.0);
  }
  FindThroat();
}

}  // namespace

void ProposeHead(ProposalDraft& draft) { HeadProposer(draft).Run(); }

}  // namespace ego
