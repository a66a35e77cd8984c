// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
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

/// Where rays fail (a stick of few vertices beside its bone) the surface's own rings may tell.
bool TakeRings(ProposalDraft& draft, LimbSegment segment) {
  SegmentCalibration& target = draft.calibration.At(segment);
  const SurfaceMesh& surface = draft.Surface();
  target.dots.clear();
  int found = 0;
  for (const double share : kRings) {
    const auto ring = surface.Ring(segment, share);
    if (!ring || ring->covered < 0.9) continue;
    ++found;
    for (const MeshPoint& place : ring->Even(kSpokes)) {
      target.dots.push_back({place, PickState::kProposed, 0.6, ""});
    }
  }
  if (found == 0) return false;
  target.confidence = found >= 2 ? 0.6 : 0.45;
  target.state = target.confidence < kDoubtBelow ? PickState::kDoubtful : PickState::kProposed;
  target.reason = "measured on the few rings of skin around the bone";
  return true;
}

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

  const double usual = draft.template_body.surface.limb_radius[Index(segment)];
  // Of several layers (a leg in a boot, a leg under a skirt) the most usual one.
  const auto spoke = [&](const Vec3& origin, const Vec3& direction) -> std::optional<SkinHit> {
    const std::vector<SkinHit> layers =
        draft.probe.Layers(RegionOf(segment), origin, direction, 0.35 * draft.Gap());
    const auto oddness = [&](const SkinHit& hit) {
      return std::abs(std::log(std::max(hit.distance, 1e-3 * usual) / usual));
    };
    const auto best = std::min_element(
        layers.begin(), layers.end(),
        [&](const SkinHit& a, const SkinHit& b) { return oddness(a) < oddness(b); });
    if (best == layers.end()) return std::nullopt;
    // Beyond the body's middle it is the other leg's cloth, or the trunk.
    const bool crosses =
        left ? best->position_ms.x < draft.middle_x : best->position_ms.x > draft.middle_x;
    if (crosses) return std::nullopt;
    return *best;
  };
  std::vector<Dot> dots;
  int lost = 0;
  for (const double share : kRings) {
    const Vec3 on_bone = start + share * (end - start);
    // Bones often run along one side of the flesh: the ring is cast from the flesh's middle.
    Vec3 origin = on_bone;
    for (int round = 0; round < 3; ++round) {
      Vec3 sum{0.0};
      int count = 0;
      std::vector<Dot> ring;
      for (int k = 0; k < kSpokes; ++k) {
        const double angle = 2.0 * kPi * k / kSpokes;
        const auto hit = spoke(origin, std::cos(angle) * forward + std::sin(angle) * side);
        if (!hit) continue;
        sum += hit->position_ms;
        ++count;
        ring.push_back({*hit, glm::distance(hit->position_ms, on_bone)});
      }
      if (round == 2 || count < 3) {
        lost += kSpokes - count;
        dots.insert(dots.end(), ring.begin(), ring.end());
        break;
      }
      Vec3 shift = sum / static_cast<double>(count) - on_bone;
      shift -= glm::dot(shift, axis) * axis;
      const double reach = glm::length(shift);
      if (reach > usual) shift *= usual / reach;
      origin = on_bone + shift;
    }
  }
  const int all = static_cast<int>(kRings.size()) * kSpokes;
  if (dots.size() < 6) {
    if (TakeRings(draft, segment)) return;
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
    if (dot.radius > 2.2 * median) {
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
  if (median > 2.5 * usual || median < 0.35 * usual) {
    target.confidence *= 0.75;
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
