// SPDX-License-Identifier: MIT
#include "app/calibrate/workspace.h"

#include <algorithm>
#include <utility>

#include "app/studio.h"

namespace ego {
namespace {

using namespace std::chrono_literals;

constexpr auto kNoteStays = 3s;

}  // namespace

void CalibrateWorkspace::Open(Studio& studio, std::uint64_t avatar_id) {
  if (avatar_id == avatar_id_ && (session() || opening_ == avatar_id)) return;
  avatar_id_ = avatar_id;
  hover = {};
  shown_finding.reset();
  if (!reference_wanted_) {
    reference_wanted_ = true;
    studio.PrepareReference();
  }
  if (CalibrationSession* open = session()) {
    open->editor().SetSymmetric(habits.symmetric);
    FrameAll(studio);
    return;
  }
  opening_ = avatar_id;
  studio.OpenForCalibration(avatar_id);
}

void CalibrateWorkspace::TakeIn(Studio& studio, std::shared_ptr<CalibrationSession> opened) {
  const std::uint64_t id = opened->avatar_id();
  if (opening_ == id) opening_ = 0;
  opened->editor().SetSymmetric(habits.symmetric);
  applied_[id] = opened->editor().Revision();
  sessions_[id] = std::move(opened);
  if (id != avatar_id_) return;
  view_.camera = view_.WholeCharacter(*session(), LensOf(studio).size());
  show_guide = !habits.guide_seen;
}

void CalibrateWorkspace::TakeIn(std::shared_ptr<TestPostures> postures) {
  reference_.SetPostures(std::move(postures));
}

void CalibrateWorkspace::Forget(std::uint64_t avatar_id) {
  sessions_.erase(avatar_id);
  applied_.erase(avatar_id);
  if (opening_ == avatar_id) opening_ = 0;
  if (avatar_id_ == avatar_id) avatar_id_ = 0;
}

CalibrationSession* CalibrateWorkspace::session() {
  const auto found = sessions_.find(avatar_id_);
  return found != sessions_.end() ? found->second.get() : nullptr;
}

const CalibrationSession* CalibrateWorkspace::session() const {
  const auto found = sessions_.find(avatar_id_);
  return found != sessions_.end() ? found->second.get() : nullptr;
}

std::vector<CalibrationSession*> CalibrateWorkspace::Unsaved() {
  std::vector<CalibrationSession*> unsaved;
  for (const auto& [id, open] : sessions_) {
    if (open->editor().Unsaved()) unsaved.push_back(open.get());
  }
  return unsaved;
}

void CalibrateWorkspace::Apply(Studio& studio) {
  for (const auto& [id, open] : sessions_) {
    const std::size_t revision = open->editor().Revision();
    if (std::exchange(applied_[id], revision) == revision) continue;
    studio.ReplaceAvatar(id, open->editor());
  }
}

Lens CalibrateWorkspace::LensOf(const Studio& studio) const {
  return {view_.camera, studio.layout().viewport};
}

void CalibrateWorkspace::Note(Studio& studio, std::string text, bool bad) {
  const Pointer& pointer = studio.window().pointer();
  note_ = CursorNote{
      std::move(text), bad, {pointer.x, pointer.y}, std::chrono::steady_clock::now() + kNoteStays};
}

void CalibrateWorkspace::Answer(Studio& studio, const Result<void>& result) {
  CalibrationSession& open = *session();
  if (!result) {
    Note(studio, result.error(), true);
  } else if (!open.editor().Note().empty()) {
    Note(studio, open.editor().Note(), false);
  } else {
    note_.reset();
  }
  shown_finding.reset();
}

// -- Operations --------------------------------------------------------------------------------

void CalibrateWorkspace::Pick(Studio& studio, const MeshPoint& place, bool add_dot) {
  const Result<void> done = add_dot ? session()->AddDot(place) : session()->Pick(place);
  Answer(studio, done);
  if (done && !add_dot && !session()->RingNote().empty()) {
    Note(studio, session()->RingNote(), false);
  }
  if (done) Follow(studio);
}

void CalibrateWorkspace::Confirm(Studio& studio) {
  const Result<void> done = session()->Confirm();
  Answer(studio, done);
  if (done) Follow(studio);
}

void CalibrateWorkspace::ConfirmAll(Studio& studio) {
  const std::size_t count = session()->editor().ConfirmAll();
  session()->Select(NextUnsettled(session()->calibration(), {}));
  shown_finding.reset();
  studio.Say(Message::Kind::kInfo,
             count == 0 ? "Nothing was left to confirm."
                        : "Confirmed " + std::to_string(count) + " points. Ctrl+S saves them.");
}

void CalibrateWorkspace::GoToDoubtful(Studio& studio, bool forward) {
  session()->GoToDoubtful(forward);
  shown_finding.reset();
  Follow(studio);
}

void CalibrateWorkspace::Select(Studio& studio, const PickItem& item) {
  session()->Select(item);
  shown_finding.reset();
  Follow(studio);
}

void CalibrateWorkspace::Delete(Studio& studio) { Answer(studio, session()->Delete()); }
void CalibrateWorkspace::Reset(Studio& studio) { Answer(studio, session()->Reset()); }
void CalibrateWorkspace::MirrorOver(Studio& studio) { Answer(studio, session()->MirrorOver()); }

void CalibrateWorkspace::Step(Studio& studio, int right, int up) {
  const Camera& camera = view_.camera;
  Answer(studio, session()->Step(static_cast<double>(right) * camera.Right() +
                                 static_cast<double>(up) * camera.Up()));
}

void CalibrateWorkspace::Undo(Studio& studio) {
  const std::string label = session()->editor().UndoLabel();
  session()->Undo();
  Follow(studio);
  if (!label.empty()) studio.Say(Message::Kind::kInfo, "Undone: " + label + ".");
}

void CalibrateWorkspace::Redo(Studio& studio) {
  const std::string label = session()->editor().RedoLabel();
  session()->Redo();
  Follow(studio);
  if (!label.empty()) studio.Say(Message::Kind::kInfo, "Redone: " + label + ".");
}

void CalibrateWorkspace::Save(Studio& studio) {
  if (session()->editor().Path().empty()) {
    ask_path = true;
    return;
  }
  const Result<void> saved = session()->Save();
  if (!saved) {
    studio.Say(Message::Kind::kError,
               saved.error() + ". Nothing is lost: the points stay here, unsaved.");
    ask_path = true;
    return;
  }
  studio.DismissErrors();
  studio.Say(Message::Kind::kInfo, "Saved " + session()->editor().Path().string() + ".");
  Apply(studio);
}

void CalibrateWorkspace::SaveAs(Studio& studio, const std::filesystem::path& path) {
  const Result<void> saved = session()->SaveAs(path);
  if (!saved) {
    studio.Say(Message::Kind::kError, saved.error() + ". Nothing is lost; try another folder.");
    return;
  }
  ask_path = false;
  studio.DismissErrors();
  studio.Say(Message::Kind::kInfo, "Saved " + path.string() + ".");
  Apply(studio);
}

void CalibrateWorkspace::SetSymmetric(bool on) {
  habits.symmetric = on;
  if (session()) session()->editor().SetSymmetric(on);
}

void CalibrateWorkspace::Show(Studio& studio, const ShownPose& shown) {
  const ShownPose before = session()->shown();
  session()->Show(shown, reference_.postures());
  // Another pose reaches elsewhere; a slider that moves must not move the camera.
  if (shown.kind != before.kind || shown.posture != before.posture) FrameAll(studio);
}

void CalibrateWorkspace::SetJoint(Studio& studio, HumanoidJoint joint, std::optional<int> node) {
  CalibrationEditor& editor = session()->editor();
  Answer(studio, node ? editor.SetJointOverride(joint, *node) : editor.ClearJointOverride(joint));
}

void CalibrateWorkspace::ShowFinding(Studio& studio, const CalibrationFinding& finding) {
  CalibrationSession& open = *session();
  if (finding.segment) {
    open.Select(PickItem::Of(*finding.segment));
  } else if (!finding.points.empty()) {
    open.Select(PickItem::Of(finding.points.front()));
  }
  list = finding.joint ? List::kJoints : List::kPoints;
  shown_finding = finding;
  if (open.shown().kind != ShownPose::Kind::kCanonical) Show(studio, {});
  Camera camera = view_.camera;
  const ViewportSize size = LensOf(studio).size();
  if (open.current() && (finding.segment || !finding.points.empty())) {
    camera = CameraFor(*open.current(), open.editor().AvatarBody(), open.pose(), size);
  } else {
    Box3 box;
    const double reach = 0.12 * open.editor().AvatarBody().height;
    box.Add(finding.position_ms - reach);
    box.Add(finding.position_ms + reach);
    camera.Frame(box, size);
  }
  view_.GlideTo(camera, std::chrono::steady_clock::now());
}

void CalibrateWorkspace::Recover(Studio& studio) {
  const Result<void> done = session()->Recover();
  if (!done) studio.Say(Message::Kind::kError, done.error());
}

// -- Seeing ------------------------------------------------------------------------------------

bool CalibrateWorkspace::SeesCurrent(const Studio& studio) const {
  const CalibrationSession& open = *session();
  if (open.current()->segment) return false;
  const std::optional<Vec3> at = open.PositionOf(*open.current());
  if (!at) return false;
  const Lens lens = LensOf(studio);
  const auto pixel = lens.ToWindow(*at);
  const Rect& r = lens.rect;
  const double margin = 0.08 * static_cast<double>(r.height);
  if (!pixel || pixel->x < static_cast<double>(r.x) + margin ||
      pixel->x > static_cast<double>(r.x + r.width) - margin ||
      pixel->y < static_cast<double>(r.y) + margin ||
      pixel->y > static_cast<double>(r.y + r.height) - margin) {
    return false;
  }
  // Large enough to aim at: a face of the whole figure's size is not.
  const double across = IsHead(*open.current()) ? 0.12 : 0.3;
  if (lens.PixelsOf(across * open.editor().AvatarBody().height, *at) <
      0.25 * static_cast<double>(r.height)) {
    return false;
  }
  const CalibrationPoint* point = Find(open.calibration(), open.current()->point);
  const Vec3 toward = glm::normalize(lens.camera.Position() - *at);
  const bool faces = glm::dot(open.picker().Normal(point->place), toward) > 0.35;
  return faces && open.picker().Visible(lens.camera.Position(), *at);
}

// Turns the camera to the item that is asked for, unless it is seen well already.
void CalibrateWorkspace::Follow(Studio& studio) {
  CalibrationSession& open = *session();
  if (!habits.follow || !open.current()) return;
  if (open.shown().kind != ShownPose::Kind::kCanonical || SeesCurrent(studio)) return;
  FrameCurrent(studio);
}

void CalibrateWorkspace::FrameCurrent(Studio& studio) {
  CalibrationSession& open = *session();
  if (!open.current()) {
    FrameAll(studio);
    return;
  }
  view_.GlideTo(
      CameraFor(*open.current(), open.editor().AvatarBody(), open.pose(), LensOf(studio).size()),
      std::chrono::steady_clock::now());
}

void CalibrateWorkspace::FrameAll(Studio& studio) {
  view_.GlideTo(view_.WholeCharacter(*session(), LensOf(studio).size()),
                std::chrono::steady_clock::now());
}

void CalibrateWorkspace::LookFrom(StandardView from, bool other_side) {
  Camera camera = view_.camera;
  camera.Look(from);
  if (other_side) {
    if (from == StandardView::kTop) {
      camera.pitch = -camera.pitch;
    } else {
      camera.yaw += kPi;
    }
  }
  view_.GlideTo(camera, std::chrono::steady_clock::now());
}

void CalibrateWorkspace::ToggleAligned(Studio& studio) {
  const bool in_file = session()->shown().kind == ShownPose::Kind::kAsInFile;
  Show(studio, {in_file ? ShownPose::Kind::kCanonical : ShownPose::Kind::kAsInFile});
}

void CalibrateWorkspace::Escape(Studio& studio) {
  if (std::exchange(studio.show_keys, false)) return;
  if (dragged) {
    session()->editor().CancelGroup();
    dragged.reset();
    pressed.reset();
    return;
  }
  if (std::exchange(ask_path, false)) return;
  if (show_guide) {
    show_guide = false;
    habits.guide_seen = true;
    return;
  }
  shown_finding.reset();
  note_.reset();
}

const GuiTexture* CalibrateWorkspace::PoseThumbnail(Studio& studio, ShownPose::Kind kind,
                                                    int side) {
  const std::shared_ptr<const Character>& character = session()->editor().TheCharacter();
  Thumbnail& kept = thumbnails_[kind == ShownPose::Kind::kCanonical ? 0 : 1];
  if (kept.character == character && kept.side == side) return &kept.picture;
  kept.character = character;
  kept.side = side;
  kept.picture.Set(view_.DrawSmall(studio.picture().renderer(), *session(), kind, side));
  return &kept.picture;
}

bool CalibrateWorkspace::Advance(Studio& studio, Time now) {
  bool changes = view_.Advance(now);
  if (note_ && now > note_->until) {
    note_.reset();
    changes = true;
  }
  for (const auto& [id, open] : sessions_) {
    const Result<void> kept = open->KeepForRecovery(now);
    if (!kept && kept.error() != recovery_error_) {
      recovery_error_ = kept.error();
      studio.Say(Message::Kind::kError, "Picks are not kept against a crash: " + kept.error() +
                                            ". Save them with Ctrl+S.");
    }
  }
  if (CalibrationSession* open = session()) changes |= open->Refresh(reference_.postures());
  return changes;
}

void CalibrateWorkspace::Draw(Studio& studio) {
  StageRenderer& renderer = studio.picture().renderer();
  const Rect& rect = studio.layout().viewport;
  DrawTarget target;
  target.x = static_cast<int>(rect.x);
  target.y = studio.window().height() - static_cast<int>(rect.y + rect.height);
  target.width = static_cast<int>(rect.width);
  target.height = static_cast<int>(rect.height);
  target.content_scale = Gui::Current().scale();
  if (CalibrationSession* open = session()) {
    view_.Draw(renderer, *open, habits.look, target);
  } else {
    StageView empty;
    empty.name_plates = false;
    renderer.Draw(empty, target);
  }
}

}  // namespace ego
