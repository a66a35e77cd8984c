// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "assets/calibration/proposal_draft.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

constexpr Vec3 kForward{0.0, 0.0, 1.0};
constexpr Vec3 kBackward{0.0, 0.0, -1.0};

/// The trunk at one height: its middle and how far it reaches.
struct Section {
  Vec3 middle{0.0};
  double half_width = 0.0;
  double front = 0.0;  // depth of the front and back skin
  double back = 0.0;
};

class TrunkProposer {
 public:
  explicit TrunkProposer(ProposalDraft& draft) : draft_(draft) {}

  void Run();

 private:
  Section SectionAt(double y, SkinRegion region) const;
  double SpineDepth(double y) const;
  void Cast(S point, SkinRegion region, const Vec3& origin, const Vec3& direction);
  void CastPair(S left, SkinRegion region, const Vec3& left_origin, const Vec3& left_direction);

  ProposalDraft& draft_;
};

/// Depth of the line through the spine's joints at a height.
double TrunkProposer::SpineDepth(double y) const {
  constexpr std::array<J, 6> kLine = {J::kHips,       J::kSpine, J::kChest,
                                      J::kUpperChest, J::kNeck,  J::kHead};
  double z = draft_.probe.Joint(kLine[0]).z;
  for (std::size_t i = 1; i < kLine.size(); ++i) {
    const Vec3& a = draft_.probe.Joint(kLine[i - 1]);
    const Vec3& b = draft_.probe.Joint(kLine[i]);
    if (y <= a.y) break;
    const double rise = b.y - a.y;
    z = rise > 1e-9 ? a.z + std::min(1.0, (y - a.y) / rise) * (b.z - a.z) : b.z;
  }
  return z;
}

Section TrunkProposer::SectionAt(double y, SkinRegion region) const {
  const double gap = draft_.Gap();
  const double spread = 0.02 * draft_.trunk_length;
  const Vec3 spine{draft_.middle_x, y, SpineDepth(y)};
  double agreement = 0.0;
  const auto reach = [&](const Vec3& origin, const Vec3& direction, double otherwise) {
    const auto hit = draft_.probe.OutwardBundle(region, origin, direction, gap, spread, &agreement);
    return hit ? hit->distance : otherwise;
  };
  const double depth = 0.2 * draft_.trunk_length;
  Section section;
  section.front = spine.z + reach(spine, kForward, depth);
  section.back = spine.z - reach(spine, kBackward, depth);
  // Sides are felt beside the spine, not beside the middle of a big belly.
  section.middle = spine;
  section.middle.z = std::clamp(spine.z, glm::mix(section.back, section.front, 0.3),
                                glm::mix(section.back, section.front, 0.6));
  const double width = draft_.shoulder_half_width;
  section.half_width = 0.5 * (reach(section.middle, {1.0, 0.0, 0.0}, width) +
                              reach(section.middle, {-1.0, 0.0, 0.0}, width));
  return section;
}

void TrunkProposer::Cast(S point, SkinRegion region, const Vec3& origin, const Vec3& direction) {
  double agreement = 0.0;
  std::optional<SkinHit> hit;
  double trust = 1.0;
  // A wooden doll has nothing between the legs and some heads cover the neck: then the next place
  // towards the middle of the trunk.
  const double middle = draft_.hip_height + 0.4 * draft_.trunk_length;
  const double step = (origin.y < middle ? 0.06 : -0.06) * draft_.trunk_length;
  const int steps = std::abs(direction.y) < 0.9 ? 4 : 1;
  for (int i = 0; i < steps && !hit; ++i) {
    // Rigs disagree about which joint carries the sides: try the trunk alone first.
    for (const SkinRegion r : {region, SkinRegion::kPelvis, SkinRegion::kShoulders}) {
      const double gap = draft_.Gap() * (r == SkinRegion::kPelvis ? 2.0 : 1.0);
      hit = draft_.probe.OutwardBundle(r, origin + Vec3{0.0, i * step, 0.0}, direction, gap,
                                       0.015 * draft_.trunk_length, &agreement);
      if (hit) break;
      trust -= 0.04;
    }
  }
  CalibrationPoint& target = draft_.calibration.At(point);
  if (!hit) {
    draft_.PutNearest(target, region, draft_.TemplateAt(point),
                      "no skin of the trunk lies in the direction where it should be");
    return;
  }
  double confidence = trust * (0.5 + 0.45 * agreement);
  std::string reason;
  if (agreement < 0.6) reason = "the skin is uneven or open here";
  if (hit->loose_layer) {
    confidence -= 0.15;
    reason = "loose cloth or hair lies over the skin here";
  }
  if (glm::dot(hit->normal_ms, direction) < 0.1) {
    confidence -= 0.2;
    reason = "the skin turns away from the place where the point should be";
  }
  ProposalDraft::Put(target, *hit, confidence, reason);
}

void TrunkProposer::CastPair(S left, SkinRegion region, const Vec3& left_origin,
                             const Vec3& left_direction) {
  const double x = draft_.middle_x;
  Cast(left, region, left_origin, left_direction);
  Cast(Mirror(left), region, {2.0 * x - left_origin.x, left_origin.y, left_origin.z},
       {-left_direction.x, left_direction.y, left_direction.z});
}

void TrunkProposer::Run() {
  constexpr SkinRegion kTrunk = SkinRegion::kTrunk;
  constexpr SkinRegion kPelvis = SkinRegion::kPelvis;
  const double x = draft_.middle_x;
  const double length = draft_.trunk_length;
  const auto height = [&](S p) { return draft_.TemplateAt(p).y; };
  const auto middle = [&](S p, SkinRegion region) { return SectionAt(height(p), region).middle; };

  for (const S p : {S::kCollarNotch, S::kSternumBase, S::kNavel}) {
    Cast(p, kTrunk, middle(p, kTrunk), kForward);
  }
  for (const S p : {S::kNapeBase, S::kMidBack, S::kLowerBack}) {
    Cast(p, kTrunk, middle(p, kTrunk), kBackward);
  }
  Cast(S::kSacrum, kPelvis, middle(S::kSacrum, kPelvis), kBackward);
  Cast(S::kPubis, kPelvis, Vec3{x, draft_.hip_height, draft_.probe.Joint(J::kHips).z},
       glm::normalize(Vec3{0.0, -0.5, 1.0}));

  for (const auto& [p, region] :
       {std::pair(S::kLeftRibs, kTrunk), std::pair(S::kLeftWaistSide, kTrunk),
        std::pair(S::kLeftHipSide, kPelvis)}) {
    CastPair(p, region, middle(p, region), {1.0, 0.0, 0.0});
  }
  const Section belly = SectionAt(height(S::kLeftBellySide), kTrunk);
  CastPair(S::kLeftBellySide, kTrunk, belly.middle,
           glm::normalize(Vec3{0.72 * belly.half_width, 0.0, 0.45 * (belly.front - belly.back)}));
  const Section chest = SectionAt(height(S::kLeftChest), kTrunk);
  const double breast = 0.57 * draft_.shoulder_half_width;
  CastPair(S::kLeftChest, kTrunk, chest.middle + Vec3{breast, 0.0, 0.0}, kForward);
  const Section blades = SectionAt(height(S::kLeftShoulderBlade), kTrunk);
  CastPair(S::kLeftShoulderBlade, kTrunk, blades.middle + Vec3{breast, 0.0, 0.0}, kBackward);

  const double shoulder_z =
      0.5 * (draft_.probe.Joint(J::kLeftUpperArm).z + draft_.probe.Joint(J::kRightUpperArm).z);
  CastPair(S::kLeftShoulderTop, SkinRegion::kShoulders,
           {x + 0.69 * draft_.shoulder_half_width, draft_.shoulder_height - 0.06 * length,
            shoulder_z - 0.02 * length},
           kUp);
}

}  // namespace

void ProposeTrunk(ProposalDraft& draft) { TrunkProposer(draft).Run(); }

}  // namespace ego
