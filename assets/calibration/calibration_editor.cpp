// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_editor.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "assets/calibration/calibration_file.h"
#include "assets/calibration/edit_history.h"
#include "assets/calibration/propose_calibration.h"
#include "core/model/avatar_body.h"

namespace ego {
namespace {

/// How far from the mirror image a mirror vertex may be, as a share of the body's height.
constexpr double kMirrorTolerance = 0.01;
/// Dots within this share of the bone of a ring belong to it.
constexpr double kRingWidth = 0.1;

CalibrationPoint PickedAt(const MeshPoint& place) { return {place, PickState::kPicked, 1.0, ""}; }

std::string Lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

bool Open(PickState state) {
  return state == PickState::kProposed || state == PickState::kDoubtful;
}

void ConfirmPoint(CalibrationPoint& point) {
  if (!Open(point.state)) return;
  point.state = PickState::kConfirmed;
  point.confidence = 1.0;
  point.reason.clear();
}

void ConfirmSegment(SegmentCalibration& segment) {
  segment.state = PickState::kConfirmed;
  segment.confidence = 1.0;
  segment.reason.clear();
  for (CalibrationPoint& dot : segment.dots) ConfirmPoint(dot);
}

void MarkPicked(SegmentCalibration& segment) {
  segment.state =
      segment.dots.empty() && !(segment.radius > 0.0) ? PickState::kMissing : PickState::kPicked;
  segment.confidence = segment.state == PickState::kPicked ? 1.0 : 0.0;
  segment.reason.clear();
}

}  // namespace

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
  double Tolerance() const { return kMirrorTolerance * template_body.height; }

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

CalibrationEditor::CalibrationEditor(CalibrationDocument document)
    : impl_(std::make_unique<Impl>(std::move(document))) {}
CalibrationEditor::~CalibrationEditor() = default;
CalibrationEditor::CalibrationEditor(CalibrationEditor&&) noexcept = default;
CalibrationEditor& CalibrationEditor::operator=(CalibrationEditor&&) noexcept = default;

const AvatarCalibration& CalibrationEditor::Calibration() const {
  return impl_->document.calibration;
}
const AvatarCalibration& CalibrationEditor::Proposal() const { return impl_->document.proposal; }
const std::shared_ptr<const Character>& CalibrationEditor::TheCharacter() const {
  return impl_->document.character;
}
const SurfaceMesh& CalibrationEditor::Surface() const { return *impl_->surface; }
const Body& CalibrationEditor::AvatarBody() const { return impl_->body; }
const std::vector<CalibrationFinding>& CalibrationEditor::Findings() const {
  return impl_->findings;
}
CalibrationSummary CalibrationEditor::Summary() const { return Summarize(Calibration()); }
std::size_t CalibrationEditor::Revision() const { return impl_->revision; }
std::size_t CalibrationEditor::CharacterRevision() const { return impl_->character_revision; }

std::optional<PointId> CalibrationEditor::NextPoint(std::optional<PointId> after) const {
  const auto order = PickOrder();
  std::size_t first = 0;
  if (after) {
    const auto found = std::find(order.begin(), order.end(), *after);
    if (found != order.end()) first = static_cast<std::size_t>(found - order.begin()) + 1;
  }
  for (const bool doubtful_only : {true, false}) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const PointId id = order[(first + i) % order.size()];
      const PickState state = Find(Calibration(), id)->state;
      if (ego::Settled(state) || (doubtful_only && state == PickState::kProposed)) continue;
      return id;
    }
  }
  return std::nullopt;
}

std::size_t CalibrationEditor::Settled() const {
  const auto order = PickOrder();
  return static_cast<std::size_t>(std::count_if(order.begin(), order.end(), [&](PointId id) {
    return ego::Settled(Find(Calibration(), id)->state);
  }));
}

void CalibrationEditor::SetSymmetric(bool on) { impl_->symmetric = on; }
bool CalibrationEditor::Symmetric() const { return impl_->symmetric; }
const std::string& CalibrationEditor::Note() const { return impl_->note; }

Result<void> CalibrationEditor::Pick(PointId id, const MeshPoint& place) {
  impl_->note.clear();
  return impl_->Put("Pick " + Lower(Title(id)), id, place);
}

Result<void> CalibrationEditor::Step(PointId id, const Vec3& direction, const PosedMesh& posed) {
  impl_->note.clear();
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  const CalibrationPoint& point = *Find(Calibration(), id);
  if (point.state == PickState::kMissing) return Error{Title(id) + " has no place to move from"};
  const auto next = impl_->surface->Step(point.place, direction, posed);
  if (!next) return Error{"the mesh ends here: no edge leads that way"};
  return impl_->Put("Move " + Lower(Title(id)), id, *next);
}

Result<void> CalibrationEditor::Walk(PointId id, const Vec3& way, const PosedMesh& posed) {
  impl_->note.clear();
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  const CalibrationPoint& point = *Find(Calibration(), id);
  if (point.state == PickState::kMissing) return Error{Title(id) + " has no place to move from"};
  return impl_->Put("Move " + Lower(Title(id)), id, impl_->surface->Walk(point.place, way, posed));
}

Result<void> CalibrationEditor::MirrorToOtherSide(PointId id) {
  impl_->note.clear();
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  const PointId other = Mirror(id);
  if (other == id) return Error{Title(id) + " lies in the middle and has no partner"};
  const CalibrationPoint& point = *Find(Calibration(), id);
  if (point.state == PickState::kMissing) return Error{Title(id) + " has no place to mirror"};
  const auto mirrored = impl_->surface->MirrorOf(point.place, impl_->Tolerance());
  if (!mirrored) return Error{impl_->NoMirror(id)};
  AvatarCalibration next = Calibration();
  if (id.IsDot()) {
    auto& dots = next.segment[other.owner].dots;
    if (other.dot < dots.size()) {
      dots[other.dot] = PickedAt(*mirrored);
    } else {
      dots.push_back(PickedAt(*mirrored));
    }
    MarkPicked(next.segment[other.owner]);
  } else {
    *Find(next, other) = PickedAt(*mirrored);
  }
  impl_->Become("Mirror " + Lower(Title(id)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::Delete(PointId id) {
  impl_->note.clear();
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  AvatarCalibration next = Calibration();
  impl_->EachSide(id, [&](PointId one) {
    CalibrationPoint* point = Find(next, one);
    if (point == nullptr) return;
    if (!one.IsDot()) {
      *point = {};
      return;
    }
    SegmentCalibration& segment = next.segment[one.owner];
    segment.dots.erase(segment.dots.begin() + one.dot);
    if (segment.dots.empty()) segment.radius = 0.0;
    MarkPicked(segment);
  });
  impl_->Become("Delete " + Lower(Title(id)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::Confirm(PointId id) {
  impl_->note.clear();
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  if (Find(Calibration(), id)->state == PickState::kMissing) {
    return Error{Title(id) + " has no place yet: pick it on the skin"};
  }
  AvatarCalibration next = Calibration();
  impl_->EachSide(id, [&](PointId one) {
    if (CalibrationPoint* point = Find(next, one)) ConfirmPoint(*point);
  });
  impl_->Become("Confirm " + Lower(Title(id)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::Confirm(LimbSegment segment) {
  impl_->note.clear();
  if (Calibration().At(segment).state == PickState::kMissing) {
    return Error{Title(segment) + " has no thickness yet: pick points or a ring on it"};
  }
  AvatarCalibration next = Calibration();
  ConfirmSegment(next.At(segment));
  if (impl_->symmetric && Open(next.At(Mirror(segment)).state)) {
    ConfirmSegment(next.At(Mirror(segment)));
  }
  impl_->Become("Confirm " + Lower(Title(segment)), std::move(next));
  return {};
}

std::size_t CalibrationEditor::ConfirmAll(double least_confidence) {
  impl_->note.clear();
  AvatarCalibration next = Calibration();
  std::size_t count = 0;
  for (const PointId id : PickOrder()) {
    CalibrationPoint& point = *Find(next, id);
    if (!Open(point.state) || point.confidence < least_confidence) continue;
    ConfirmPoint(point);
    ++count;
  }
  for (SegmentCalibration& segment : next.segment) {
    if (!Open(segment.state) || segment.confidence < least_confidence) continue;
    ConfirmSegment(segment);
    ++count;
  }
  impl_->Become("Confirm proposals", std::move(next));
  return count;
}

Result<void> CalibrationEditor::ResetToProposal(PointId id) {
  impl_->note.clear();
  if (id.IsDot()) return ResetToProposal(static_cast<LimbSegment>(id.owner));
  if (auto ok = impl_->CheckId(id); !ok) return ok;
  AvatarCalibration next = Calibration();
  impl_->EachSide(id, [&](PointId one) { *Find(next, one) = *Find(Proposal(), one); });
  impl_->Become("Propose " + Lower(Title(id)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::ResetToProposal(LimbSegment segment) {
  impl_->note.clear();
  AvatarCalibration next = Calibration();
  next.At(segment) = Proposal().At(segment);
  if (impl_->symmetric) next.At(Mirror(segment)) = Proposal().At(Mirror(segment));
  impl_->Become("Propose " + Lower(Title(segment)), std::move(next));
  return {};
}

void CalibrationEditor::ResetAllToProposal() {
  impl_->note.clear();
  impl_->Become("Propose everything", Proposal());
}

Result<void> CalibrationEditor::SetLimbPoint(LimbSegment segment, std::size_t dot,
                                             const MeshPoint& place) {
  impl_->note.clear();
  const std::size_t count = Calibration().At(segment).dots.size();
  const PointId id = PointId::Of(segment, dot);
  if (dot < count) return impl_->Put("Move " + Lower(Title(id)), id, place);
  if (dot > count) return Error{"there is no " + Lower(Title(id))};
  if (auto ok = impl_->CheckPlace(place); !ok) return ok;
  AvatarCalibration next = Calibration();
  next.At(segment).dots.push_back(PickedAt(place));
  MarkPicked(next.At(segment));
  if (impl_->symmetric) {
    const auto mirrored = impl_->surface->MirrorOf(place, impl_->Tolerance());
    if (mirrored) {
      next.At(Mirror(segment)).dots.push_back(PickedAt(*mirrored));
      MarkPicked(next.At(Mirror(segment)));
    } else {
      impl_->note = impl_->NoMirror(id);
    }
  }
  impl_->Become("Add " + Lower(Title(id)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::SetRing(LimbSegment segment, double t, std::size_t dots) {
  impl_->note.clear();
  AvatarCalibration next = Calibration();
  const auto ring = impl_->surface->Ring(segment, t);
  if (!ring) {
    return Error{"no ring of skin goes around the " + Lower(Title(segment)) + " there"};
  }
  impl_->AddRing(next, segment, t, *ring, dots);
  if (impl_->symmetric) {
    if (const auto other = impl_->surface->Ring(Mirror(segment), t)) {
      impl_->AddRing(next, Mirror(segment), t, *other, dots);
    } else {
      impl_->note = "no ring of skin goes around the " + Lower(Title(Mirror(segment))) + " there";
    }
  }
  impl_->Become("Ring around the " + Lower(Title(segment)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::SetRadius(LimbSegment segment, double radius) {
  impl_->note.clear();
  if (!(radius > 0.0) || !(radius < impl_->template_body.height)) {
    return Error{"a radius must be more than nothing and less than the body's height"};
  }
  AvatarCalibration next = Calibration();
  for (const LimbSegment one : {segment, Mirror(segment)}) {
    if (one != segment && !impl_->symmetric) continue;
    next.At(one).dots.clear();
    next.At(one).radius = radius;
    MarkPicked(next.At(one));
  }
  impl_->Become("Radius of the " + Lower(Title(segment)), std::move(next));
  return {};
}

Result<void> CalibrationEditor::SetJointOverride(HumanoidJoint joint, int node) {
  impl_->note.clear();
  JointOverrides overrides = Calibration().joint_override;
  overrides[Index(joint)] = node;
  // A joint that was given this node by hand before gives it up.
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (j != Index(joint) && node >= 0 && overrides[j] == node) overrides[j].reset();
  }
  return impl_->SetOverrides(overrides, "Map " + std::string(Name(joint)));
}

Result<void> CalibrationEditor::ClearJointOverride(HumanoidJoint joint) {
  impl_->note.clear();
  JointOverrides overrides = Calibration().joint_override;
  overrides[Index(joint)].reset();
  return impl_->SetOverrides(overrides, "Unmap " + std::string(Name(joint)));
}

void CalibrationEditor::BeginGroup(std::string label) {
  if (impl_->group_depth++ > 0) return;
  impl_->group_label = std::move(label);
  impl_->group_start = Calibration();
}

void CalibrationEditor::EndGroup() {
  if (impl_->group_depth == 0 || --impl_->group_depth > 0) return;
  impl_->history.Push(std::move(impl_->group_label), *impl_->group_start, Calibration());
  impl_->group_start.reset();
}

void CalibrationEditor::CancelGroup() {
  if (impl_->group_depth == 0) return;
  impl_->group_depth = 0;
  const JointOverrides before = Calibration().joint_override;
  impl_->document.calibration = *std::move(impl_->group_start);
  impl_->group_start.reset();
  impl_->Follow(before);
}

bool CalibrationEditor::CanUndo() const {
  return impl_->group_depth == 0 && impl_->history.CanUndo();
}
bool CalibrationEditor::CanRedo() const {
  return impl_->group_depth == 0 && impl_->history.CanRedo();
}
std::string CalibrationEditor::UndoLabel() const { return impl_->history.UndoLabel(); }
std::string CalibrationEditor::RedoLabel() const { return impl_->history.RedoLabel(); }

bool CalibrationEditor::Undo() {
  impl_->note.clear();
  if (!CanUndo()) return false;
  const JointOverrides before = Calibration().joint_override;
  impl_->history.Undo(impl_->document.calibration);
  impl_->Follow(before);
  return true;
}

bool CalibrationEditor::Redo() {
  impl_->note.clear();
  if (!CanRedo()) return false;
  const JointOverrides before = Calibration().joint_override;
  impl_->history.Redo(impl_->document.calibration);
  impl_->Follow(before);
  return true;
}

const std::filesystem::path& CalibrationEditor::Path() const { return impl_->document.path; }
bool CalibrationEditor::Unsaved() const { return !(impl_->saved == Calibration()); }

Result<void> CalibrationEditor::Save() {
  if (impl_->document.path.empty()) {
    return Error{impl_->document.character->name +
                 ": this character has no file to keep its calibration beside; save under a name"};
  }
  return SaveAs(impl_->document.path);
}

Result<void> CalibrationEditor::SaveAs(const std::filesystem::path& path) {
  if (impl_->document.damaged && path == impl_->document.path) {
    // What could not be read may still be mended by hand.
    std::filesystem::path aside = path;
    aside += ".damaged";
    std::error_code code;
    if (std::filesystem::exists(path, code)) std::filesystem::rename(path, aside, code);
    if (code) {
      return Error{path.string() + ": is damaged and cannot be put aside: " + code.message()};
    }
  }
  const Result<void> written =
      WriteCalibration(path, *impl_->document.character, impl_->document.calibration);
  if (!written) return written;
  impl_->document.path = path;
  impl_->document.damaged = false;
  impl_->document.from_file = true;
  impl_->saved = Calibration();
  return {};
}

void CalibrationEditor::Adopt(AvatarCalibration calibration, std::string label) {
  impl_->note.clear();
  const JointOverrides& overrides = calibration.joint_override;
  if (overrides != Calibration().joint_override) {
    if (const Result<void> fitted = impl_->FitRig(overrides); !fitted) {
      impl_->note = fitted.error();
      calibration.joint_override = Calibration().joint_override;
    }
  }
  impl_->Become(std::move(label), std::move(calibration));
}

}  // namespace ego
