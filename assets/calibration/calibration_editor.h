// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/calibration/calibration_document.h"
#include "assets/calibration/check_calibration.h"
#include "assets/mesh/surface_mesh.h"
#include "core/body/body.h"
#include "core/model/calibration_point.h"

namespace ego {

/// The state of an edit and every operation on it, without a window. Each operation is one step
/// of the undo history; those between BeginGroup and EndGroup are one together (a drag). What
/// cannot be done is answered with a sentence and changes nothing.
class CalibrationEditor {
 public:
  explicit CalibrationEditor(CalibrationDocument document);
  ~CalibrationEditor();
  CalibrationEditor(CalibrationEditor&&) noexcept;
  CalibrationEditor& operator=(CalibrationEditor&&) noexcept;

  // -- What there is -------------------------------------------------------------------------
  const AvatarCalibration& Calibration() const;
  const AvatarCalibration& Proposal() const;
  const std::shared_ptr<const Character>& TheCharacter() const;
  /// Connectivity of the present character.
  const SurfaceMesh& Surface() const;
  /// The avatar as the method sees it with the present calibration.
  const Body& AvatarBody() const;
  /// Worst first; brought up to date by every operation.
  const std::vector<CalibrationFinding>& Findings() const;
  CalibrationSummary Summary() const;
  /// Changes with every change of the calibration, and with every new character (another rig,
  /// hence another canonical pose): what to compare to know that pictures are stale.
  std::size_t Revision() const;
  std::size_t CharacterRevision() const;

  /// The point to ask for next: after `after` (or from the beginning) in PickOrder, going around,
  /// the first that is missing or doubtful, then the first that nobody picked or confirmed.
  /// Nothing when all are.
  std::optional<PointId> NextPoint(std::optional<PointId> after = {}) const;
  /// How many of PickOrder a person picked or confirmed.
  std::size_t Settled() const;

  // -- Points --------------------------------------------------------------------------------
  /// Mirrors every Pick, Step, Walk, Delete, Confirm, ResetToProposal and limb edit onto the
  /// partner. On at first.
  void SetSymmetric(bool on);
  bool Symmetric() const;

  /// Puts a point on the skin, by hand. With symmetric picking the partner is put as well, or
  /// left alone where the mesh has no mirror place: then `Note()` says so.
  Result<void> Pick(PointId id, const MeshPoint& place);
  /// One arrow key: along a mesh edge, `direction` in the space of `posed` (see SurfaceMesh).
  Result<void> Step(PointId id, const Vec3& direction, const PosedMesh& posed);
  /// Walks along the surface.
  Result<void> Walk(PointId id, const Vec3& way, const PosedMesh& posed);
  /// Puts the partner where the point's mirror image is. Error: "no mirror vertex here: ...".
  Result<void> MirrorToOtherSide(PointId id);
  /// Forgets a point (missing); of the dots the dot itself goes.
  Result<void> Delete(PointId id);
  /// The person has looked: a proposal becomes confirmed. Missing points cannot be.
  Result<void> Confirm(PointId id);
  Result<void> Confirm(LimbSegment segment);
  /// Confirms every proposal whose confidence is at least this, doubtful ones too when 0. Says
  /// how many.
  std::size_t ConfirmAll(double least_confidence = 0.0);
  Result<void> ResetToProposal(PointId id);
  Result<void> ResetToProposal(LimbSegment segment);
  void ResetAllToProposal();

  // -- Limbs (the gray points of figure 5) ---------------------------------------------------
  /// Moves dot `dot`, or adds one when `dot` is the number of dots there are. The capsule's
  /// radius follows.
  Result<void> SetLimbPoint(LimbSegment segment, std::size_t dot, const MeshPoint& place);
  /// Replaces the dots near share t of the bone by a ring of the skin there.
  Result<void> SetRing(LimbSegment segment, double t, std::size_t dots = 8);
  /// A radius by hand, metres; removes the dots.
  Result<void> SetRadius(LimbSegment segment, double radius);

  // -- Joints --------------------------------------------------------------------------------
  /// Says which node of the rig plays a joint (-1: none). A joint that had the node takes the
  /// one that this had. The rig is fitted anew, points that nobody settled are proposed anew.
  /// Error: the rig cannot do without this joint, or has no shape then.
  Result<void> SetJointOverride(HumanoidJoint joint, int node);
  Result<void> ClearJointOverride(HumanoidJoint joint);

  // -- History -------------------------------------------------------------------------------
  void BeginGroup(std::string label);
  void EndGroup();
  /// Takes back what was done since BeginGroup (Escape during a drag).
  void CancelGroup();
  bool CanUndo() const;
  bool CanRedo() const;
  /// "Pick navel"; empty when there is none.
  std::string UndoLabel() const;
  std::string RedoLabel() const;
  bool Undo();
  bool Redo();
  /// What the last operation has to say although it succeeded; empty for nothing.
  const std::string& Note() const;

  // -- Files ---------------------------------------------------------------------------------
  const std::filesystem::path& Path() const;
  bool Unsaved() const;
  /// On an error nothing is lost: the old file stays, the edit stays unsaved.
  Result<void> Save();
  Result<void> SaveAs(const std::filesystem::path& path);
  /// Takes over picks from a recovery file or another calibration, as one step.
  void Adopt(AvatarCalibration calibration, std::string label);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
