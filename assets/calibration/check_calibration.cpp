// SPDX-License-Identifier: MIT
#include "assets/calibration/check_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "assets/calibration/crude_mesh.h"
#include "assets/calibration/proposal_draft.h"
#include "assets/calibration/skin_probe.h"
#include "core/model/avatar_body.h"

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

bool Known(const Character& character, const CalibrationPoint& point) {
  return point.state != PickState::kMissing && IsOn(character, point.place);
}

std::string Lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

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
             sample == S::kRightHipSide;
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

struct CalibrationChecker::Impl {
  Impl(const Character& the_character, const SurfaceMesh& the_surface)
      : character(the_character),
        surface(the_surface),
        probe(the_character),
        draft(the_character, probe),
        skin(SkinMatrices(the_character, the_character.rig.canonical_global)) {
    for (std::size_t s = 0; s < kSegmentCount; ++s) {
      MeasureSegment(static_cast<LimbSegment>(s));
    }
  }

  const Character& character;
  const SurfaceMesh& surface;
  SkinProbe probe;
  ProposalDraft draft;  // for the measures of the body; its calibration is not used
  std::vector<Mat4> skin;
  /// The skin's mean distance from each bone by rings; 0 where it has no closed ones.
  std::array<double, kSegmentCount> thickness{};

  /// One check at work.
  struct Look {
    const AvatarCalibration& calibration;
    SamplePlaces places;
    std::vector<CalibrationFinding> findings;
  };

  double Height() const { return draft.template_body.height; }
  Vec3 PositionOf(const CalibrationPoint& point) const {
    return PosePoint(character, skin, point.place);
  }

  void MeasureSegment(LimbSegment segment) {
    std::vector<double> radii;
    for (const double t : {0.3, 0.4, 0.5, 0.6, 0.7}) {
      const auto ring = surface.Ring(segment, t);
      if (ring && ring->covered > 0.9) radii.push_back(ring->radius);
    }
    if (radii.size() < 3) return;
    std::sort(radii.begin(), radii.end());
    thickness[Index(segment)] = radii[radii.size() / 2];
  }

  CalibrationFinding& Add(Look& look, Severity severity, FindingKind kind, std::string sentence,
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

  void CheckPoints(Look& look) const;
  void CheckPlace(Look& look, PointId id, const CalibrationPoint& point) const;
  void CheckTriangles(Look& look) const;
  void CheckCrossings(Look& look) const;
  void CheckSymmetry(Look& look) const;
  void CheckSegments(Look& look) const;
  void CheckJoints(Look& look) const;
  S WorstCorner(const SamplePlaces& places, const std::vector<std::size_t>& triangles,
                std::size_t of) const;
  Vec3 SegmentMiddle(LimbSegment segment) const {
    return 0.5 * (probe.Joint(StartJoint(segment)) + probe.Joint(EndJoint(segment)));
  }
};

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
  const bool has_joint =
      std::any_of(character.rig.node.begin(), character.rig.node.end(), [&](const int& node) {
        const auto j = static_cast<J>(&node - character.rig.node.data());
        return node >= 0 && MayFollow(id, j);
      });
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

S CalibrationChecker::Impl::WorstCorner(const SamplePlaces& places,
                                        const std::vector<std::size_t>& triangles,
                                        std::size_t of) const {
  const SamplePlaces& usual = draft.template_body.surface.sample_ms;
  S worst = SampleTriangles()[of][0];
  std::pair<std::size_t, double> most{0, -1.0};
  for (const S p : SampleTriangles()[of]) {
    std::size_t count = 0;
    for (const std::size_t t : triangles) {
      const SampleTriangle& corners = SampleTriangles()[t];
      count += static_cast<std::size_t>(std::count(corners.begin(), corners.end(), p));
    }
    const std::pair<std::size_t, double> here{count,
                                              glm::distance(places[Index(p)], usual[Index(p)])};
    if (here > most) {
      most = here;
      worst = p;
    }
  }
  return worst;
}

void CalibrationChecker::Impl::CheckTriangles(Look& look) const {
  const auto sound = Soundness(look.places, draft.template_body.surface.sample_ms);
  std::vector<std::size_t> bad;
  for (std::size_t t = 0; t < kTriangleCount; ++t) {
    if (sound[t] <= 0.0) bad.push_back(t);
  }
  // One finding for each point that is at fault, with all of its triangles.
  std::array<std::vector<std::size_t>, kSampleCount> flipped;
  std::array<std::vector<std::size_t>, kSampleCount> flat;
  for (const std::size_t t : bad) {
    const S worst = WorstCorner(look.places, bad, t);
    (sound[t] < 0.0 ? flipped : flat)[Index(worst)].push_back(t);
  }
  for (const bool is_flat : {false, true}) {
    for (std::size_t i = 0; i < kSampleCount; ++i) {
      const std::vector<std::size_t>& triangles = is_flat ? flat[i] : flipped[i];
      if (triangles.empty()) continue;
      const PointId id = PointId::Of(static_cast<S>(i));
      const std::string count =
          triangles.size() == 1 ? "A triangle of the crude mesh"
                                : std::to_string(triangles.size()) + " triangles of the crude mesh";
      const std::string fault =
          is_flat
              ? (triangles.size() == 1 ? " has" : " have") + std::string(" hardly any area at the ")
              : (triangles.size() == 1 ? " faces" : " face") + std::string(" inward at the ");
      CalibrationFinding& finding =
          Add(look, is_flat ? Severity::kWarning : Severity::kError,
              is_flat ? FindingKind::kDegenerateTriangle : FindingKind::kFlippedTriangle,
              count + fault + Lower(Title(id)) + ".", {id});
      finding.triangles = triangles;
      for (const std::size_t t : triangles) {
        for (const S p : SampleTriangles()[t]) {
          if (std::find(finding.points.begin(), finding.points.end(), PointId::Of(p)) ==
              finding.points.end()) {
            finding.points.push_back(PointId::Of(p));
          }
        }
      }
    }
  }
}

void CalibrationChecker::Impl::CheckCrossings(Look& look) const {
  const auto crossing = CrossingTriangles(look.places);
  if (crossing.empty()) return;
  std::vector<std::size_t> all;
  for (const auto& [a, b] : crossing) {
    all.push_back(a);
    all.push_back(b);
  }
  std::array<std::vector<std::size_t>, kSampleCount> by_point;
  for (const auto& [a, b] : crossing) {
    const S first = WorstCorner(look.places, all, a);
    auto& triangles = by_point[Index(first)];
    for (const std::size_t t : {a, b}) {
      if (std::find(triangles.begin(), triangles.end(), t) == triangles.end()) {
        triangles.push_back(t);
      }
    }
  }
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    if (by_point[i].empty()) continue;
    const PointId id = PointId::Of(static_cast<S>(i));
    Add(look, Severity::kError, FindingKind::kSelfCrossing,
        "The crude mesh cuts through itself at the " + Lower(Title(id)) + ".", {id})
        .triangles = by_point[i];
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
