// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/pick_item.h"
#include "assets/calibration/calibration_editor.h"
#include "assets/calibration/calibration_recovery.h"
#include "assets/calibration/test_postures.h"
#include "core/model/mesh_picker.h"

namespace ego {

/// In which pose a character stands while it is calibrated.
struct ShownPose {
  enum class Kind { kCanonical, kAsInFile, kPosture };
  Kind kind = Kind::kCanonical;
  TestPosture posture = TestPosture::kArmsCrossed;
  double amount = 1.0;  // of the posture
  friend bool operator==(const ShownPose&, const ShownPose&) = default;
};

/// One avatar while it is calibrated: its edit, the pose it stands in, and which item is asked for
/// next. Operations go through the editor; each leaves the item that comes next selected. Knows no
/// window.
class CalibrationSession {
 public:
  /// Some tens of milliseconds for a large mesh: made in the background.
  CalibrationSession(std::uint64_t avatar_id, std::string name, CalibrationDocument document);

  std::uint64_t avatar_id() const { return avatar_id_; }
  const std::string& name() const { return name_; }
  CalibrationEditor& editor() { return editor_; }
  const CalibrationEditor& editor() const { return editor_; }
  const AvatarCalibration& calibration() const { return editor_.Calibration(); }
  const std::filesystem::path& avatar_path() const { return avatar_path_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  // -- The item that is asked for -------------------------------------------------------------
  const std::optional<PickItem>& current() const { return current_; }
  void Select(std::optional<PickItem> item) { current_ = item; }
  /// Goes to the next that a person should look at, else to the next that is not settled.
  void GoToDoubtful(bool forward);

  // -- Operations on the current item. An error changes nothing. ------------------------------
  /// Puts it at a place of the skin and goes on to the next; of a limb it lays a ring there, or a
  /// single dot where no ring goes around: then `RingNote()` says so.
  Result<void> Pick(const MeshPoint& place);
  const std::string& RingNote() const { return ring_note_; }
  /// Adds one more dot to the current limb.
  Result<void> AddDot(const MeshPoint& place);
  /// Confirms it and goes on to the next that a person should look at.
  Result<void> Confirm();
  Result<void> Delete();
  Result<void> Reset();
  Result<void> MirrorOver();
  /// Along a mesh edge; `direction` in the shown pose.
  Result<void> Step(const Vec3& direction);
  /// The last undone or done thing becomes the current item.
  void Undo();
  void Redo();

  /// Share of the way along a limb segment that lies nearest to a place of the skin.
  double ShareAlong(LimbSegment segment, const MeshPoint& place) const;

  // -- The pose --------------------------------------------------------------------------------
  const ShownPose& shown() const { return shown_; }
  /// `postures` may be null while they are being made: the canonical pose stands in.
  void Show(const ShownPose& shown, TestPostures* postures);
  /// Brings pose and picker up to date after edits. True when anything moved.
  bool Refresh(TestPostures* postures);
  const ModelPose& pose() const { return pose_; }
  const std::vector<Mat4>& node_global() const { return node_global_; }
  const MeshPicker& picker() const { return *picker_; }
  /// Distance that is left between surfaces that should touch in the posture shown.
  double contact_gap() const { return contact_gap_; }
  /// Where an item is in the shown pose; nothing for one that is missing.
  std::optional<Vec3> PositionOf(const PickItem& item) const;
  /// Grows with every change of the pose.
  std::size_t pose_revision() const { return pose_revision_; }

  // -- Crash recovery --------------------------------------------------------------------------
  /// What an earlier session left; answer with Recover or Decline before anything is kept anew.
  const std::optional<Recovery>& offer() const { return offer_; }
  Result<void> Recover();
  void Decline();
  /// Keeps unsaved picks where a crash does not reach them, when they changed a moment ago.
  /// Error: they could not be kept.
  Result<void> KeepForRecovery(std::chrono::steady_clock::time_point now);
  Result<void> Save();
  Result<void> SaveAs(const std::filesystem::path& path);

 private:
  void Repose(TestPostures* postures);
  void GoTo(const AvatarCalibration& before);

  std::uint64_t avatar_id_;
  std::string name_;
  std::filesystem::path avatar_path_;
  std::vector<std::string> warnings_;
  CalibrationEditor editor_;
  std::unique_ptr<MeshPicker> picker_;
  std::optional<PickItem> current_;
  std::string ring_note_;

  ShownPose shown_;
  ModelPose pose_;
  std::vector<Mat4> node_global_;
  double contact_gap_ = 0.0;
  std::size_t posed_revision_ = 0;
  std::size_t posed_character_ = 0;
  bool posed_with_postures_ = false;
  std::size_t pose_revision_ = 0;

  std::optional<Recovery> offer_;
  std::size_t kept_revision_ = 0;
  std::size_t seen_revision_ = 0;
  std::chrono::steady_clock::time_point changed_{};
};

/// How a character stands in its file, on the stage: the rest pose before it is aligned.
/// `node_global` has one entry per node. Returns the joints as they are there.
ModelPose PoseAsInFile(const Character& character, std::vector<Mat4>& node_global);

}  // namespace ego
