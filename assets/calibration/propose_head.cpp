// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
  void MeasureFace(double face_y);
  void FindCrown();
  void FindChin();
  void FindNose();
  void FindThroat();
  double Y(double share) const { return chin_.y + share * Height(); }
  double Height() const { return skull_top_ - chin_.y; }
  void FindBrim();
  std::optional<SkinHit> Cast(const Vec3& origin, const Vec3& direction) const {
    return draft_.probe.Outward(SkinRegion::kHead, origin, direction, 0.25 * size_, reach_);
  }
  std::optional<SkinHit> CastBundle(const Vec3& origin, const Vec3& direction,
                                    double* agreement) const;
  void Put(S point, const Vec3& origin, const Vec3& direction, double trust);

  ProposalDraft& draft_;
  Vec3 centre_{0.0};
  double size_ = 0.0;  // a rough radius
  Vec3 crown_{0.0};
  double skull_top_ = 0.0;  // the crown, or, under a brimmed hat, where it must be
  double reach_ = 0.0;      // farthest from the middle that a face's skin is believed to be
  bool brimmed_ = false;    // a hat with a brim covers the head
  Vec3 chin_{0.0};
};

std::optional<SkinHit> HeadProposer::CastBundle(const Vec3& origin, const Vec3& direction,
                                                double* agreement) const {
  return draft_.probe.OutwardBundle(SkinRegion::kHead, origin, direction, 0.25 * size_,
                                    0.04 * size_, agreement, direction.y < 0.9 ? reach_ : 0.0);
}

void HeadProposer::Put(S point, const Vec3& origin, const Vec3& direction, double trust) {
  double agreement = 0.0;
  const auto hit = CastBundle(origin, direction, &agreement);
  CalibrationPoint& target = draft_.calibration.At(point);
  if (!hit) {
    draft_.PutNearest(target, SkinRegion::kHead, draft_.TemplateAt(point),
                      "no skin of the head lies in the direction where it should be");
    return;
  }
  if (brimmed_ && hit->distance > reach_ && direction.y < 0.9) {
    draft_.PutNearest(target, SkinRegion::kHead, origin + 0.6 * reach_ * direction,
                      "the brim of a hat lies over the skin here");
    return;
  }
  double confidence = trust * (0.55 + 0.4 * agreement);
  std::string reason;
  if (agreement < 0.6) reason = "the skin is uneven or open here";
  if (hit->loose_layer) {
    confidence -= 0.25;
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
}

/// The head's middle between front and back at the height of the face, and how far skin may be
/// from it: most of what lies around it, and something for nose and hair.
void HeadProposer::MeasureFace(double face_y) {
  std::vector<double> around;
  constexpr int kSpokes = 12;
  for (const double dy : {-0.2, 0.0, 0.2}) {
    for (int k = 0; k < kSpokes; ++k) {
      const double angle = 2.0 * kPi * k / kSpokes;
      const auto layers =
          draft_.probe.Layers(SkinRegion::kHead, {centre_.x, face_y + dy * size_, centre_.z},
                              {std::sin(angle), 0.0, std::cos(angle)}, 0.25 * size_);
      if (!layers.empty()) around.push_back(layers.back().distance);
    }
  }
  if (around.size() < 6) return;
  std::sort(around.begin(), around.end());
  reach_ = 1.6 * around[around.size() / 2];
  const Vec3 origin{centre_.x, face_y, centre_.z};
  const auto front = Cast(origin, kForward);
  const auto back = Cast(origin, kBackward);
  if (front && back) centre_.z += 0.5 * (front->distance - back->distance);
}

void HeadProposer::FindCrown() {
  const auto look_up = [&] {
    Put(S::kCrown, centre_, kUp, 1.0);
    crown_ = draft_.probe.PositionOf(draft_.calibration.At(S::kCrown).place);
    if (crown_.y <= centre_.y) crown_.y = centre_.y + size_;
  };
  look_up();
  // Ears, hair and collars pull the median up or down; joint and crown bound the skull itself.
  const double joint = draft_.probe.Joint(J::kHead).y;
  centre_.y = 0.5 * (joint + crown_.y);
  for (int round = 0; round < 2; ++round) MeasureFace(glm::mix(joint, crown_.y, 0.3));
  look_up();
}

/// A hat with a brim: the head is much deeper and wider at one height than at the face below it,
/// and narrow again farther up. The crown then belongs to the hat; the face is measured by its own
/// depth.
void HeadProposer::FindBrim() {
  skull_top_ = crown_.y;
  const double joint = draft_.probe.Joint(J::kHead).y;
  constexpr int kSteps = 40;
  constexpr std::size_t kFaceFrom = 4;
  constexpr std::size_t kFaceTo = 14;
  std::array<double, kSteps> depth{};
  std::array<double, kSteps> width{};
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kSteps;
    const Vec3 origin{centre_.x, glm::mix(joint, crown_.y, share), centre_.z};
    const auto extent = [&](const Vec3& direction) {
      double sum = 0.0;
      for (const double sign : {1.0, -1.0}) {
        const auto layers =
            draft_.probe.Layers(SkinRegion::kHead, origin, sign * direction, 0.25 * size_);
        if (!layers.empty()) sum += layers.back().distance;
      }
      return sum;
    };
    depth[i] = extent(kForward);
    width[i] = extent({1.0, 0.0, 0.0});
  }
  const auto usual = [&](std::array<double, kSteps> extents) {
    const auto middle = extents.begin() + (kFaceFrom + kFaceTo) / 2;
    std::nth_element(extents.begin() + kFaceFrom, middle, extents.begin() + kFaceTo);
    return *middle;
  };
  const double usual_depth = usual(depth);
  const double usual_width = usual(width);
  // From the top down, so that what lies above is known.
  double above = depth[kSteps - 1];
  for (std::size_t i = kSteps - 1; i >= kFaceTo; --i) {
    above = std::min(above, depth[i]);
    const bool brim = depth[i] > 1.4 * usual_depth && width[i] > 1.4 * usual_width;
    if (!brim || above > 0.6 * depth[i]) continue;
    brimmed_ = true;
    skull_top_ = std::min(crown_.y, joint + 1.1 * usual_depth);
    return;
  }
}

/// The chin: of the skin in the middle below the face, the most forward and downward.
void HeadProposer::FindChin() {
  const double joint = draft_.probe.Joint(J::kHead).y;
  const double half = crown_.y - centre_.y;
  // The joint sits between the ears on some rigs and as low as the shoulders on others.
  const double bottom = std::min(joint - 0.3 * (crown_.y - joint),
                                 glm::mix(joint, draft_.probe.Joint(J::kNeck).y, 0.8));
  constexpr int kSteps = 80;
  double best = -1e300;
  double foremost = -1e300;
  std::optional<SkinHit> found;
  for (int i = 0; i < kSteps; ++i) {
    const double y = glm::mix(centre_.y, bottom, (i + 0.5) / kSteps);
    const auto hit = Cast({centre_.x, y, centre_.z}, kForward);
    if (!hit || (brimmed_ && hit->distance > reach_)) continue;
    // Far behind the face is the neck; what comes forward again below is a collar or the chest.
    foremost = std::max(foremost, hit->position_ms.z);
    if (hit->position_ms.z < foremost - 0.35 * (crown_.y - joint)) break;
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
    if (!hit || (brimmed_ && hit->distance > reach_)) continue;
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
  if (under && under->position_ms.y > Y(-0.2) && under->normal_ms.y < -0.2) {
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
  FindBrim();
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
