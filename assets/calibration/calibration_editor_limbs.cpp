// SPDX-License-Identifier: MIT
// Limbs, joints, history and files of the editor.
#include <system_error>

#include "assets/calibration/calibration_editor_impl.h"
#include "assets/calibration/calibration_file.h"

namespace ego {
namespace {

/// How much farther than its present radius a limb's skin is looked for.
constexpr double kThick = 1.5;

}  // namespace

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
  const auto around = [&](LimbSegment one) {
    return impl_->surface->Ring(one, t, kThick * Calibration().At(one).radius);
  };
  const auto ring = around(segment);
  if (!ring) {
    return Error{"no ring of skin goes around the " + Lower(Title(segment)) + " there"};
  }
  impl_->AddRing(next, segment, t, *ring, dots);
  if (impl_->symmetric) {
    if (const auto other = around(Mirror(segment))) {
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
