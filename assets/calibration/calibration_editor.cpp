// SPDX-License-Identifier: MIT
#include "assets/calibration/calibration_editor.h"

#include <algorithm>

#include "assets/calibration/calibration_editor_impl.h"

namespace ego {

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

}  // namespace ego
