// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/calibration/calibration_editor.h"
#include "assets/calibration/check_calibration_impl.h"
#include "assets/calibration/edit_history.h"
#include "assets/calibration/propose_calibration.h"
#include "core/model/avatar_body.h"

namespace ego {

/// How far from the mirror image a mirror vertex may be, as a share of the body's height.
inline constexpr double kMirrorReach = 0.01;
/// Dots within this share of the bone of a ring belong to it.
inline constexpr double kRingWidth = 0.1;

inline CalibrationPoint PickedAt(const MeshPoint& place) {
  return {place, PickState::kPicked, 1.0, ""};
}

inline bool Open(PickState state) {
  return state == PickState::kProposed || state == PickState::kDoubtful;
}

inline void ConfirmPoint(CalibrationPoint& point) {
  if (!Open(point.state)) return;
  point.state = PickState::kConfirmed;
  point.confidence = 1.0;
  point.reason.clear();
}

inline void ConfirmSegment(SegmentCalibration& segment) {
  segment.state = PickState::kConfirmed;
  segment.confidence = 1.0;
  segment.reason.clear();
  for (CalibrationPoint& dot : segment.dots) ConfirmPoint(dot);
}

inline void MarkPicked(SegmentCalibration& segment) {
  segment.state =
      segment.dots.empty() && !(segment.radius > 0.0) ? PickState::kMissing : PickState::kPicked;
  segment.confidence = segment.state == PickState::kPicked ? 1.0 : 0.0;
  segment.reason.clear();
}

/// What the source files of CalibrationEditor share.
struct CalibrationEditor::Impl {
  CalibrationDocument document;
  AvatarCalibration saved;
  EditHistory history;
  std::optional<AvatarCalibration> group_start;
  std::string group_label;
  int group_depth = 0;
  bool symmetric = true;
  std::string note;
  std::size_t revision = 0;
  std::size_t character_revision = 0;
  // Of the present character and calibration.
  std::optional<SurfaceMesh> surface;
  std::optional<CalibrationChecker> checker;
  Body template_body;
  Body body;
  std::vector<CalibrationFinding> findings;

  explicit Impl(CalibrationDocument opened)
      : document(std::move(opened)), saved(document.calibration) {
    Rebuild();
    Refresh();
  }

  AvatarCalibration& Now() { return document.calibration; }
  double Tolerance() const { return kMirrorReach * template_body.height; }

  /// Everything that hangs on the character.
  void Rebuild() {
    checker.reset();
    surface.emplace(*document.character);
    checker.emplace(*document.character, *surface);
    template_body = TemplateBodyOf(*document.character);
    ++character_revision;
  }
  /// Everything that hangs on the calibration.
  void Refresh() {
    body = MakeAvatarBody(*document.character, Now(), template_body);
    findings = checker->Check(Now());
    ++revision;
  }

  /// Makes `next` the present state: a step of the history, or part of the open group.
  void Become(std::string label, AvatarCalibration next) {
    UpdateThickness(*document.character, next);
    if (next == Now()) return;
    if (!group_start) history.Push(std::move(label), Now(), next);
    document.calibration = std::move(next);
    Refresh();
  }

  /// The character and the proposal for other overrides. The calibration is not touched.
  Result<void> FitRig(const JointOverrides& overrides) {
    const bool none = std::none_of(overrides.begin(), overrides.end(),
                                   [](const auto& o) { return o.has_value(); });
    std::shared_ptr<const Character> mended = document.as_read;
    if (!none) {
      Result<Character> made = WithJointOverrides(*document.as_read, overrides);
      if (!made) return Error{made.error()};
      mended = std::make_shared<const Character>(*std::move(made));
    }
    Result<AvatarCalibration> proposal = ProposeCalibration(*mended);
    if (!proposal) return Error{proposal.error()};
    document.character = std::move(mended);
    document.proposal = *std::move(proposal);
    document.proposal.joint_override = overrides;
    Rebuild();
    return {};
  }
  /// After a change of the state by the history.
  void Follow(const JointOverrides& before) {
    // The rig of a state that was reached once can be fitted again.
    if (before != Now().joint_override) static_cast<void>(FitRig(Now().joint_override));
    Refresh();
  }

  Result<void> SetOverrides(const JointOverrides& overrides, std::string label) {
    if (overrides == Now().joint_override) return {};
    if (auto fitted = FitRig(overrides); !fitted) return fitted;
    AvatarCalibration next = Now();
    next.joint_override = overrides;
    for (const PointId id : PickOrder()) {
      if (!ego::Settled(Find(next, id)->state)) *Find(next, id) = *Find(document.proposal, id);
    }
    for (std::size_t s = 0; s < kSegmentCount; ++s) {
      if (!ego::Settled(next.segment[s].state)) next.segment[s] = document.proposal.segment[s];
    }
    Become(std::move(label), std::move(next));
    return {};
  }

  Result<void> CheckId(PointId id) const {
    if (Find(document.calibration, id) != nullptr) return {};
    return Error{"there is no " + Lower(Title(id))};
  }
  Result<void> CheckPlace(const MeshPoint& place) const {
    if (IsOn(*document.character, place)) return {};
    return Error{"that place is not on the character's skin"};
  }
  std::string NoMirror(PointId id) const {
    return "no mirror vertex here: the skin opposite of the " + Lower(Title(id)) +
           " is not the same";
  }

  /// A point by hand, its partner too when that is wanted and possible.
  Result<void> Put(std::string label, PointId id, const MeshPoint& place) {
    if (auto ok = CheckPlace(place); !ok) return ok;
    if (auto ok = CheckId(id); !ok) return ok;
    AvatarCalibration next = Now();
    *Find(next, id) = PickedAt(place);
    if (id.IsDot()) MarkPicked(next.segment[id.owner]);
    if (symmetric && Mirror(id) != id) {
      const auto mirrored = surface->MirrorOf(place, Tolerance());
      CalibrationPoint* partner = Find(next, Mirror(id));
      if (!mirrored) {
        note = NoMirror(id);
      } else if (partner != nullptr) {
        *partner = PickedAt(*mirrored);
        if (id.IsDot()) MarkPicked(next.segment[Mirror(id).owner]);
      }
    }
    Become(std::move(label), std::move(next));
    return {};
  }

  /// Visits a point and, when picking is symmetric, its partner.
  template <class Edit>
  void EachSide(PointId id, const Edit& edit) {
    edit(id);
    if (symmetric && Mirror(id) != id) edit(Mirror(id));
  }

  void AddRing(AvatarCalibration& next, LimbSegment segment, double t, const SurfaceRing& ring,
               std::size_t dots) const {
    const auto joint = CanonicalPositions(document.character->rig.skeleton);
    const Vec3 start = joint[Index(StartJoint(segment))];
    const Vec3 bone = joint[Index(EndJoint(segment))] - start;
    const auto skin = SkinMatrices(*document.character, document.character->rig.canonical_global);
    SegmentCalibration& target = next.At(segment);
    std::erase_if(target.dots, [&](const CalibrationPoint& dot) {
      if (dot.state == PickState::kMissing || !IsOn(*document.character, dot.place)) return true;
      const Vec3 at = PosePoint(*document.character, skin, dot.place);
      return std::abs(glm::dot(at - start, bone) / glm::dot(bone, bone) - t) <= kRingWidth;
    });
    for (const MeshPoint& place : ring.Even(dots)) target.dots.push_back(PickedAt(place));
    MarkPicked(target);
  }
};

}  // namespace ego
