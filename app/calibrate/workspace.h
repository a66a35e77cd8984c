// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/calibrate_view.h"
#include "app/calibrate/reference_figure.h"
#include "app/calibrate/session.h"
#include "core/base/result.h"

namespace ego {

class Studio;

/// What of the Calibrate workspace is remembered from one session of the window to the next.
struct CalibrateHabits {
  bool symmetric = true;  // picks are mirrored
  bool loupe = true;
  bool follow = true;       // the camera turns to the next point
  bool guide_seen = false;  // the first-use guide was dismissed
  CalibrateLook look;
};

/// A sentence beside the pointer, about what was just done or what cannot be done here.
struct CursorNote {
  std::string text;
  bool bad = false;
  Vec2 at{0.0};  // window pixels
  std::chrono::steady_clock::time_point until;
};

/// What a click would do, found before it is made.
struct Hover {
  std::optional<VertexPick> vertex;  // that a click would take
  std::optional<MeshPoint> mirror;   // that it would take on the other side
  bool no_mirror = false;            // it should, and there is none
  std::optional<PickItem> item;      // that a click would select instead
  std::optional<SurfaceRing> ring;   // that it would lay around a limb
  std::optional<HumanoidJoint> joint;
};

/// The Calibrate workspace: which avatar is calibrated, how it is seen, and what its panels have
/// in common. One object on the main thread.
class CalibrateWorkspace {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class List { kPoints, kJoints };

  // -- Avatars ---------------------------------------------------------------------------------
  /// Turns to an avatar of the studio; opens it in the background the first time.
  void Open(Studio& studio, std::uint64_t avatar_id);
  /// What was opened is there.
  void TakeIn(Studio& studio, std::shared_ptr<CalibrationSession> session);
  void TakeIn(std::shared_ptr<TestPostures> postures);
  /// An avatar is gone for good, or its opening failed.
  void Forget(std::uint64_t avatar_id);
  /// The one that is calibrated; null while there is none or it is being opened.
  CalibrationSession* session();
  const CalibrationSession* session() const;
  std::uint64_t avatar_id() const { return avatar_id_; }  // 0: none
  bool opening() const { return opening_ != 0 && opening_ == avatar_id_; }
  std::vector<CalibrationSession*> Unsaved();
  /// Hands the present state of every changed avatar to the stage.
  void Apply(Studio& studio);

  // -- Operations, each with its answer at the pointer -----------------------------------------
  void Pick(Studio& studio, const MeshPoint& place, bool add_dot);
  void Confirm(Studio& studio);
  void ConfirmAll(Studio& studio);
  void GoToDoubtful(Studio& studio, bool forward);
  void Select(Studio& studio, const PickItem& item);
  void Delete(Studio& studio);
  void Reset(Studio& studio);
  void MirrorOver(Studio& studio);
  /// `right` and `up` of the picture.
  void Step(Studio& studio, int right, int up);
  void Undo(Studio& studio);
  void Redo(Studio& studio);
  void Save(Studio& studio);
  void SaveAs(Studio& studio, const std::filesystem::path& path);
  void SetSymmetric(bool on);
  void Show(Studio& studio, const ShownPose& shown);
  void SetJoint(Studio& studio, HumanoidJoint joint, std::optional<int> node);
  void ShowFinding(Studio& studio, const CalibrationFinding& finding);
  void Recover(Studio& studio);

  // -- Seeing ----------------------------------------------------------------------------------
  void FrameAll(Studio& studio);
  void FrameCurrent(Studio& studio);
  void LookFrom(StandardView view, bool other_side);
  /// The rest pose before its alignment, or after.
  void ToggleAligned(Studio& studio);
  /// Closes what lies over the picture, gives a drag up, forgets what a check shows.
  void Escape(Studio& studio);
  CalibrateView& view() { return view_; }
  Lens LensOf(const Studio& studio) const;
  ReferenceFigure& reference() { return reference_; }
  /// A small picture of the avatar in its canonical pose or as it stands in its file.
  const GuiTexture* PoseThumbnail(Studio& studio, ShownPose::Kind kind, int side);
  /// At the pointer, or where the last note stood.
  void Note(Studio& studio, std::string text, bool bad);
  const std::optional<CursorNote>& note() const { return note_; }
  void Draw(Studio& studio);
  /// Once per frame, before the panels. True when the picture changes by itself.
  bool Advance(Studio& studio, Time now);

  CalibrateHabits habits;
  List list = List::kPoints;
  Hover hover;
  std::optional<CalibrationFinding> shown_finding;
  std::optional<PickItem> pressed;  // the item whose dot the pointer went down on
  std::optional<PickItem> dragged;
  std::optional<PickItem> hovered_row;  // in the list
  bool show_guide = false;
  bool ask_path = false;  // where to save is asked for
  std::array<char, 1024> path_text{};
  GuiTexture loupe;
  std::optional<HumanoidJoint> asked_joint;  // whose node is chosen from a list
  bool open_joint_list = false;
  std::array<char, 64> joint_filter{};
  std::optional<PickItem> scrolled_to;  // in the list

 private:
  void Answer(Studio& studio, const Result<void>& result);
  void Follow(Studio& studio);
  bool SeesCurrent(const Studio& studio) const;

  std::map<std::uint64_t, std::shared_ptr<CalibrationSession>> sessions_;
  std::map<std::uint64_t, std::size_t> applied_;  // revisions that the stage has
  std::uint64_t avatar_id_ = 0;
  std::uint64_t opening_ = 0;
  CalibrateView view_;
  ReferenceFigure reference_;
  bool reference_wanted_ = false;
  struct Thumbnail {
    std::shared_ptr<const Character> character;
    int side = 0;
    GuiTexture picture;
  };
  std::array<Thumbnail, 2> thumbnails_;  // canonical, as in the file
  std::optional<CursorNote> note_;
  std::string recovery_error_;
};

// One function per panel, as in app/panels/panels.h.

/// Points or joints: what is settled, what is doubtful, what comes next.
void ShowCalibrateRail(Studio& studio);
/// The reference figure, the selected point, the checks.
void ShowCalibrateInspector(Studio& studio);
/// The test postures.
void ShowPostureStrip(Studio& studio);
/// Pointer, overlays, cards over the picture, which lies beneath.
void ShowCalibrateViewport(Studio& studio);

/// What the pointer does over the picture; the last item is the button that fills it.
void HandlePointer(Studio& studio, CalibrationSession& session);
/// "Left upper arm".
std::string WordsOf(HumanoidJoint joint);
/// The item whose dot is drawn under a window pixel.
std::optional<PickItem> ItemAt(const CalibrateWorkspace& work, const CalibrationSession& session,
                               const Lens& lens, const Vec2& pixel);
/// Everything that is drawn over the picture.
void DrawOverlay(Studio& studio, const CalibrationSession& session);
/// What stands in the middle until it is answered: unsaved picks found, the guide, where to save.
void ShowCards(Studio& studio, CalibrationSession& session);

}  // namespace ego
