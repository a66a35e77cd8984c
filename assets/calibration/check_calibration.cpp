// SPDX-License-Identifier: MIT
#include "assets/calibration/check_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "assets/calibration/check_calibration_impl.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

// Shares of the body's height.
constexpr double kLoose = 0.04;           // cloth that far off the skin is loose
constexpr double kAsymmetric = 0.03;      // partners that far apart, on a mesh that is symmetric
constexpr double kVeryAsymmetric = 0.08;  // on any mesh
constexpr double kMirrorTolerance = 0.012;
// Of a capsule against the skin's mean distance from the bone.
constexpr double kTooFat = 1.45;
constexpr double kTooThin = 0.65;
/// A trunk or head point whose skin follows the right joints by less than this is off the body.
constexpr double kLeastShare = 0.35;
constexpr double kDoubtfulJoint = 0.5;

std::string Centimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, metres < 0.1 ? "%.1f cm" : "%.0f cm", 100.0 * metres);
  return text;
}

/// "leftUpperArm" -> "left upper arm".
std::string Words(J joint) {
  std::string out;
  for (const char c : Name(joint)) {
    if (c >= 'A' && c <= 'Z') {
      out += ' ';
      out += static_cast<char>(c + 32);
    } else {
      out += c;
    }
  }
  return out;
}

/// The joints on whose skin a point may lie.
bool MayFollow(PointId id, J joint) {
  const auto side = [&](J left, J right) { return joint == (id.owner == 0 ? left : right); };
  switch (id.kind) {
    case PointId::Kind::kPalm:
    case PointId::Kind::kBackOfHand:
    case PointId::Kind::kFingertip:
      return side(J::kLeftHand, J::kRightHand);
    case PointId::Kind::kHeel:
    case PointId::Kind::kBall:
    case PointId::Kind::kToeTip:
      return side(J::kLeftFoot, J::kRightFoot) || side(J::kLeftToes, J::kRightToes);
    case PointId::Kind::kDot: {
      const auto segment = static_cast<LimbSegment>(id.owner);
      const J start = StartJoint(segment);
      return joint == start || joint == Parent(start) || joint == EndJoint(segment);
    }
    case PointId::Kind::kSample:
      break;
  }
  const auto sample = static_cast<S>(id.owner);
  if (IsHead(sample)) {
    return joint == J::kHead || joint == J::kNeck ||
           (sample == S::kThroat && joint == J::kUpperChest);
  }
  switch (joint) {
    case J::kHips:
    case J::kSpine:
    case J::kChest:
    case J::kUpperChest:
    case J::kNeck:
    case J::kLeftShoulder:
    case J::kRightShoulder:
      return true;
    case J::kLeftUpperArm:
    case J::kRightUpperArm:
      return sample == S::kLeftShoulderTop || sample == S::kRightShoulderTop;
    case J::kLeftUpperLeg:
    case J::kRightUpperLeg:
      return sample == S::kPubis || sample == S::kSacrum || sample == S::kLeftHipSide ||
             sample == S::kRightHipSide || sample == S::kLeftWaistSide ||
             sample == S::kRightWaistSide;
    default:
      return false;
  }
}

}  // namespace

std::string_view Name(FindingKind kind) {
  constexpr std::array<std::string_view, 12> kNames = {
      "missingPoint",  "doubtfulPoint",  "flippedTriangle", "degenerateTriangle",
      "selfCrossing",  "offBody",        "onLooseCloth",    "asymmetric",
      "capsuleTooFat", "capsuleTooThin", "missingRadius",   "doubtfulJoint"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view Name(Severity severity) {
  constexpr std::array<std::string_view, 3> kNames = {"note", "warning", "error"};
  return kNames[static_cast<std::size_t>(severity)];
}

bool NeedsAPerson(const std::vector<CalibrationFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const CalibrationFinding& f) { return f.severity != Severity::kNote; });
}

void CalibrationChecker::Impl::MeasureSegment(LimbSegment segment) {
  std::vector<double> radii;
  for (const double t : {0.3, 0.4, 0.5, 0.6, 0.7}) {
    const auto ring = surface.Ring(segment, t);
    if (ring && ring->covered > 0.9) radii.push_back(ring->radius);
  }
  if (radii.size() < 3) return;
  std::sort(radii.begin(), radii.end());
  thickness[Index(segment)] = radii[radii.size() / 2];
}

CalibrationFinding& CalibrationChecker::Impl::Add(Look& look, Severity severity, FindingKind kind,
                                                  std::string sentence,
                                                  std::vector<PointId> points) const {
  CalibrationFinding& finding = look.findings.emplace_back();
  finding.severity = severity;
  finding.kind = kind;
  finding.sentence = std::move(sentence);
  finding.points = std::move(points);
  if (!finding.points.empty()) {
    const PointId id = finding.points.front();
    if (id.kind == PointId::Kind::kSample) finding.position_ms = look.places[id.owner];
    const CalibrationPoint* point = Find(look.calibration, id);
    if (point != nullptr && Known(character, *point)) {
      finding.place = point->place;
      finding.position_ms = PositionOf(*point);
    }
  }
  return finding;
}

void CalibrationChecker::Impl::CheckPoints(Look& look) const {
  for (const PointId id : PickOrder()) {
    const CalibrationPoint& point = *Find(look.calibration, id);
    if (!Known(character, point)) {
      Add(look, Severity::kWarning, FindingKind::kMissingPoint,
          Title(id) + " has no place on the skin; the average body's stands in" +
              (point.reason.empty() ? "." : " (" + point.reason + ")."),
          {id});
      continue;
    }
    if (point.state == PickState::kDoubtful) {
      Add(look, Severity::kWarning, FindingKind::kDoubtfulPoint,
          Title(id) + " is doubtful: " +
              (point.reason.empty() ? "little speaks for it" : point.reason) + ".",
          {id});
    }
    CheckPlace(look, id, point);
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto& dots = look.calibration.segment[s].dots;
    for (std::size_t d = 0; d < dots.size(); ++d) {
      if (Known(character, dots[d])) {
        CheckPlace(look, PointId::Of(static_cast<LimbSegment>(s), d), dots[d]);
      }
    }
  }
}

void CalibrationChecker::Impl::CheckPlace(Look& look, PointId id,
                                          const CalibrationPoint& point) const {
  const Attachment attachment = AttachmentAt(character, point.place);
  double share = 0.0;
  for (std::size_t k = 0; k < attachment.joint.size(); ++k) {
    if (MayFollow(id, attachment.joint[k])) share += attachment.weight[k];
  }
  // Where a rig lacks the joint (no hands, no toes) its skin follows the joint before.
  bool has_joint = false;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    has_joint = has_joint || (character.rig.node[j] >= 0 && MayFollow(id, static_cast<J>(j)));
  }
  if (share < kLeastShare && has_joint) {
    Add(look, Severity::kWarning, FindingKind::kOffBody,
        Title(id) + " lies on skin that moves with the " + Words(attachment.joint[0]) + ".", {id});
    return;
  }
  if (id.kind != PointId::Kind::kSample || IsHead(static_cast<S>(id.owner))) return;

  // From the trunk's middle at the point's height outward: is there skin far below the point?
  const Vec3 at = PositionOf(point);
  const Vec3 hips = 0.5 * (probe.Joint(J::kLeftUpperLeg) + probe.Joint(J::kRightUpperLeg));
  const Vec3 shoulders = 0.5 * (probe.Joint(J::kLeftUpperArm) + probe.Joint(J::kRightUpperArm));
  const double rise = shoulders.y - hips.y;
  const double t = rise > 0.0 ? std::clamp((at.y - hips.y) / rise, 0.0, 1.0) : 0.0;
  const Vec3 origin = glm::mix(hips, shoulders, t);
  const double distance = glm::distance(at, origin);
  if (!(distance > 0.0)) return;
  const double loose = std::max(kLoose * Height(), draft.Gap());
  for (const SkinHit& layer :
       probe.Layers(SkinRegion::kPelvis, origin, (at - origin) / distance, draft.Gap())) {
    if (layer.distance > distance - loose) break;
    Add(look, Severity::kWarning, FindingKind::kOnLooseCloth,
        Title(id) + " lies " + Centimetres(distance - layer.distance) +
            " outside the skin below it, as on loose cloth.",
        {id});
    break;
  }
}

void CalibrationChecker::Impl::CheckSymmetry(Look& look) const {
  const auto mirror = [&](const Vec3& p) { return Vec3{2.0 * surface.MiddleX() - p.x, p.y, p.z}; };
  for (const PointId id : PickOrder()) {
    const PointId other = Mirror(id);
    if (other <= id) continue;
    const CalibrationPoint& left = *Find(look.calibration, id);
    const CalibrationPoint& right = *Find(look.calibration, other);
    if (!Known(character, left) || !Known(character, right)) continue;
    const double apart = glm::distance(PositionOf(left), mirror(PositionOf(right)));
    if (apart < kAsymmetric * Height()) continue;
    // A body that is not the same on both sides has a right to this.
    const double tolerance = kMirrorTolerance * Height();
    const auto has_mirror = [&](const CalibrationPoint& point) {
      const auto hit = probe.NearestAnywhere(mirror(PositionOf(point)));
      return hit && glm::distance(hit->position_ms, mirror(PositionOf(point))) <= tolerance;
    };
    const bool symmetric_there = has_mirror(left) && has_mirror(right);
    if (!symmetric_there && apart < kVeryAsymmetric * Height()) continue;
    Add(look, symmetric_there ? Severity::kWarning : Severity::kNote, FindingKind::kAsymmetric,
        Title(id) + " and " + Lower(Title(other)) + " are " + Centimetres(apart) +
            " away from being mirror images.",
        {id, other});
  }
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const LimbSegment other = Mirror(segment);
    if (Index(other) <= s) continue;
    const double left = look.calibration.segment[s].radius;
    const double right = look.calibration.At(other).radius;
    const double left_skin = thickness[s];
    const double right_skin = thickness[Index(other)];
    if (!(left > 0.0 && right > 0.0 && left_skin > 0.0 && right_skin > 0.0)) continue;
    if (std::abs(std::log(left / right) - std::log(left_skin / right_skin)) < std::log(1.3)) {
      continue;
    }
    CalibrationFinding& finding = Add(
        look, Severity::kWarning, FindingKind::kAsymmetric,
        Title(segment) + " and " + Lower(Title(other)) + " have capsules of " + Centimetres(left) +
            " and " + Centimetres(right) + ", which the skin does not bear out.",
        {});
    finding.segment = segment;
    finding.position_ms = SegmentMiddle(segment);
  }
}

void CalibrationChecker::Impl::CheckSegments(Look& look) const {
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const SegmentCalibration& one = look.calibration.segment[s];
    const auto add = [&](Severity severity, FindingKind kind, std::string sentence) {
      CalibrationFinding& finding = Add(look, severity, kind, std::move(sentence), {});
      finding.segment = segment;
      finding.position_ms = SegmentMiddle(segment);
    };
    if (one.state == PickState::kMissing || !(one.radius > 0.0)) {
      add(Severity::kWarning, FindingKind::kMissingRadius,
          Title(segment) + " has no thickness; the average body's stands in.");
      continue;
    }
    if (one.state == PickState::kDoubtful) {
      add(Severity::kWarning, FindingKind::kDoubtfulPoint,
          Title(segment) + " is of doubtful thickness: " +
              (one.reason.empty() ? "the skin around it differs much" : one.reason) + ".");
    }
    if (!(thickness[s] > 0.0)) continue;
    const double ratio = one.radius / thickness[s];
    if (ratio > kTooFat || ratio < kTooThin) {
      add(Severity::kWarning,
          ratio > 1.0 ? FindingKind::kCapsuleTooFat : FindingKind::kCapsuleTooThin,
          Title(segment) + ": the capsule's radius is " + Centimetres(one.radius) +
              ", the skin lies " + Centimetres(thickness[s]) + " from the bone.");
    }
  }
}

void CalibrationChecker::Impl::CheckJoints(Look& look) const {
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const HumanoidMap::Entry& entry = character.map.joint[j];
    if (entry.node < 0 || entry.confidence >= kDoubtfulJoint) continue;
    const auto joint = static_cast<J>(j);
    CalibrationFinding& finding =
        Add(look, Severity::kWarning, FindingKind::kDoubtfulJoint,
            "The joint taken for the " + Words(joint) + " is doubtful: " + entry.reason + ".", {});
    finding.joint = joint;
    finding.position_ms = probe.Joint(joint);
  }
}

CalibrationChecker::CalibrationChecker(const Character& character, const SurfaceMesh& surface)
    : impl_(std::make_unique<Impl>(character, surface)) {}
CalibrationChecker::~CalibrationChecker() = default;
CalibrationChecker::CalibrationChecker(CalibrationChecker&&) noexcept = default;

std::vector<CalibrationFinding> CalibrationChecker::Check(
    const AvatarCalibration& calibration) const {
  Impl::Look look{calibration, impl_->draft.template_body.surface.sample_ms, {}};
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    if (Known(impl_->character, calibration.sample[i])) {
      look.places[i] = impl_->PositionOf(calibration.sample[i]);
    }
  }
  impl_->CheckTriangles(look);
  impl_->CheckCrossings(look);
  impl_->CheckPoints(look);
  impl_->CheckSegments(look);
  impl_->CheckSymmetry(look);
  impl_->CheckJoints(look);
  std::stable_sort(look.findings.begin(), look.findings.end(),
                   [](const CalibrationFinding& a, const CalibrationFinding& b) {
                     return a.severity > b.severity;
                   });
  return std::move(look.findings);
}

}  // namespace ego
