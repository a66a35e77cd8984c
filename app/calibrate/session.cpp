// SPDX-License-Identifier: MIT
#include "app/calibrate/session.h"

#include <algorithm>
#include <utility>

#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using namespace std::chrono_literals;

constexpr auto kRests = 250ms;  // a drag writes its recovery file when it rests, not at each step

}  // namespace

CalibrationSession::CalibrationSession(std::uint64_t avatar_id, std::string name,
                                       CalibrationDocument document)
    : avatar_id_(avatar_id),
      name_(std::move(name)),
      avatar_path_(document.avatar),
      warnings_(document.warnings),
      editor_(std::move(document)),
      picker_(std::make_unique<MeshPicker>(editor_.TheCharacter())) {
  if (!avatar_path_.empty()) offer_ = FindRecovery(RecoveryFolder(), avatar_path_);
  seen_revision_ = kept_revision_ = editor_.Revision();
  posed_character_ = editor_.CharacterRevision();
  Repose(nullptr);
  current_ = NextUnsettled(calibration(), {});
}

void CalibrationSession::GoToDoubtful(bool forward) {
  std::optional<PickItem> next = NextDoubtful(calibration(), current_, forward);
  if (!next) next = NextUnsettled(calibration(), current_);
  // What the mirror image settles needs no look of its own.
  for (std::size_t i = 0; i < PickItems().size() && next && editor_.Symmetric() && IsRight(*next) &&
                          StateOf(calibration(), Mirror(*next)) == StateOf(calibration(), *next);
       ++i) {
    const auto before = next;
    next = NextDoubtful(calibration(), before, forward);
    if (!next) next = NextUnsettled(calibration(), before);
  }
  current_ = next;
}

Result<void> CalibrationSession::Pick(const MeshPoint& place) {
  if (!current_) return Error{"Every point is settled; choose one in the list to change it."};
  const PickItem item = *current_;
  ring_note_.clear();
  if (!item.segment) {
    if (Result<void> done = editor_.Pick(item.point, place); !done) return done;
  } else {
    const Result<void> ring = editor_.SetRing(*item.segment, ShareAlong(*item.segment, place));
    if (!ring) {
      // A limb that grows out of the body at once has no loop of its own there.
      if (Result<void> done = AddDot(place); !done) return done;
      ring_note_ = ring.error() + "; this place alone tells how thick it is";
    }
  }
  current_ = NextUnsettled(calibration(), item);
  return {};
}

Result<void> CalibrationSession::AddDot(const MeshPoint& place) {
  if (!current_ || !current_->segment) return Error{"Single dots are for limbs; choose one first."};
  const LimbSegment segment = *current_->segment;
  return editor_.SetLimbPoint(segment, calibration().At(segment).dots.size(), place);
}

Result<void> CalibrationSession::Confirm() {
  if (!current_) return Error{"Every point is settled."};
  const PickItem item = *current_;
  Result<void> done = item.segment ? editor_.Confirm(*item.segment) : editor_.Confirm(item.point);
  if (!done) return done;
  GoToDoubtful(true);
  return {};
}

Result<void> CalibrationSession::Delete() {
  if (!current_) return Error{"No point is selected."};
  if (!current_->segment) return editor_.Delete(current_->point);
  const LimbSegment segment = *current_->segment;
  const std::size_t dots = calibration().At(segment).dots.size();
  if (dots == 0) return Error{"This limb has no points to delete."};
  editor_.BeginGroup("Delete the points of " + Title(*current_));
  for (std::size_t left = dots; left-- > 0;) {
    if (left >= calibration().At(segment).dots.size()) continue;
    if (Result<void> done = editor_.Delete(PointId::Of(segment, left)); !done) {
      editor_.CancelGroup();
      return done;
    }
  }
  editor_.EndGroup();
  return {};
}

Result<void> CalibrationSession::Reset() {
  if (!current_) return Error{"No point is selected."};
  return current_->segment ? editor_.ResetToProposal(*current_->segment)
                           : editor_.ResetToProposal(current_->point);
}

Result<void> CalibrationSession::MirrorOver() {
  if (!current_ || current_->segment) return Error{"Select a point to mirror."};
  return editor_.MirrorToOtherSide(current_->point);
}

Result<void> CalibrationSession::Step(const Vec3& direction) {
  if (!current_ || current_->segment) return Error{"Select a point to move."};
  return editor_.Step(current_->point, direction, picker_->Mesh());
}

// Selects the first item in which two states of the calibration differ.
void CalibrationSession::GoTo(const AvatarCalibration& before) {
  for (const PickItem& item : PickItems()) {
    if (IsRight(item) && editor_.Symmetric()) continue;
    bool same = StateOf(before, item) == StateOf(calibration(), item);
    if (item.segment) {
      same &= before.At(*item.segment).radius == calibration().At(*item.segment).radius;
    } else {
      const CalibrationPoint* a = Find(before, item.point);
      const CalibrationPoint* b = Find(calibration(), item.point);
      same &= a && b && a->place == b->place;
    }
    if (same) continue;
    current_ = item;
    return;
  }
}

void CalibrationSession::Undo() {
  const AvatarCalibration before = calibration();
  if (editor_.Undo()) GoTo(before);
}

void CalibrationSession::Redo() {
  const AvatarCalibration before = calibration();
  if (editor_.Redo()) GoTo(before);
}

double CalibrationSession::ShareAlong(LimbSegment segment, const MeshPoint& place) const {
  const Vec3 a = pose_.Position(StartJoint(segment));
  const Vec3 b = pose_.Position(EndJoint(segment));
  const double length2 = glm::dot(b - a, b - a);
  if (length2 <= 0.0) return 0.5;
  const double share = glm::dot(picker_->Position(place) - a, b - a) / length2;
  return std::clamp(share, 0.15, 0.85);
}

std::optional<Vec3> CalibrationSession::PositionOf(const PickItem& item) const {
  if (item.segment) return PositionOn(item, editor_.AvatarBody(), pose_);
  const CalibrationPoint* point = Find(calibration(), item.point);
  if (!point || point->state == PickState::kMissing || point->place.part < 0) return std::nullopt;
  return picker_->Position(point->place);
}

void CalibrationSession::Show(const ShownPose& shown, TestPostures* postures) {
  if (shown == shown_) return;
  shown_ = shown;
  Repose(postures);
}

bool CalibrationSession::Refresh(TestPostures* postures) {
  bool stale = posed_revision_ != editor_.Revision() && shown_.kind == ShownPose::Kind::kPosture;
  stale |= shown_.kind == ShownPose::Kind::kPosture && postures && !posed_with_postures_;
  if (posed_character_ != editor_.CharacterRevision()) {
    posed_character_ = editor_.CharacterRevision();
    picker_ = std::make_unique<MeshPicker>(editor_.TheCharacter());
    stale = true;
  }
  if (stale) Repose(postures);
  return stale;
}

void CalibrationSession::Repose(TestPostures* postures) {
  const Character& character = *editor_.TheCharacter();
  const Body& body = editor_.AvatarBody();
  node_global_.resize(character.nodes.joints.size());
  contact_gap_ = 0.0;
  posed_revision_ = editor_.Revision();
  posed_with_postures_ = postures != nullptr;
  ++pose_revision_;
  if (shown_.kind == ShownPose::Kind::kAsInFile) {
    pose_ = PoseAsInFile(character, node_global_);
    picker_->SetPose(node_global_);
    return;
  }
  Pose pose = CanonicalPose(body.skeleton);
  if (shown_.kind == ShownPose::Kind::kPosture && postures) {
    const TestPostureResult result = postures->Apply(body, shown_.posture, shown_.amount);
    pose = result.pose;
    contact_gap_ = result.contact_gap;
  }
  pose_ = ForwardKinematics(body.skeleton, pose);
  PoseNodes(character.rig, pose_, node_global_);
  picker_->SetPose(node_global_);
}

Result<void> CalibrationSession::Recover() {
  if (!offer_) return {};
  Result<LoadedCalibration> left = ReadRecovery(*offer_, *editor_.TheCharacter());
  if (!left) return Error{left.error()};
  offer_.reset();
  editor_.Adopt(std::move(left->calibration), "Take back unsaved picks");
  current_ = NextUnsettled(calibration(), {});
  return {};
}

void CalibrationSession::Decline() {
  offer_.reset();
  DiscardRecovery(RecoveryFolder(), avatar_path_);
}

Result<void> CalibrationSession::KeepForRecovery(std::chrono::steady_clock::time_point now) {
  if (avatar_path_.empty() || offer_) return {};
  const std::size_t revision = editor_.Revision();
  if (revision != seen_revision_) {
    seen_revision_ = revision;
    changed_ = now;
  }
  if (revision == kept_revision_ || now - changed_ < kRests) return {};
  kept_revision_ = revision;
  if (!editor_.Unsaved()) {
    DiscardRecovery(RecoveryFolder(), avatar_path_);
    return {};
  }
  return WriteRecovery(RecoveryFolder(), avatar_path_, *editor_.TheCharacter(), calibration());
}

Result<void> CalibrationSession::Save() {
  Result<void> saved = editor_.Save();
  if (saved && !avatar_path_.empty()) DiscardRecovery(RecoveryFolder(), avatar_path_);
  if (saved) seen_revision_ = kept_revision_ = editor_.Revision();
  return saved;
}

Result<void> CalibrationSession::SaveAs(const std::filesystem::path& path) {
  Result<void> saved = editor_.SaveAs(path);
  if (saved && !avatar_path_.empty()) DiscardRecovery(RecoveryFolder(), avatar_path_);
  if (saved) seen_revision_ = kept_revision_ = editor_.Revision();
  return saved;
}

ModelPose PoseAsInFile(const Character& character, std::vector<Mat4>& node_global) {
  const std::vector<Mat4> rest = character.nodes.RestGlobal();
  const Rig& rig = character.rig;
  const auto hips = static_cast<std::size_t>(std::max(0, rig.node[Index(HumanoidJoint::kHips)]));
  // The hips are turned as the body is as a whole: what brings them from the file to the stage
  // brings everything there as it stands in the file.
  const Mat4 to_stage = rig.canonical_global[hips] * glm::inverse(rest[hips]);
  node_global.resize(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) node_global[i] = to_stage * rest[i];

  const auto canonical = CanonicalPositions(rig.skeleton);
  std::array<Mat4, kJointCount> moved;
  ModelPose pose;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const int node = rig.node[j];
    const auto n = static_cast<std::size_t>(std::max(0, node));
    moved[j] = node >= 0 ? node_global[n] * glm::inverse(rig.canonical_global[n])
                         : moved[Index(kParent[j])];
    pose.position_ws[j] = Vec3(moved[j] * Vec4(canonical[j], 1.0));
    pose.rotation_ws[j] = RotationOf(moved[j]);
  }
  return pose;
}

}  // namespace ego
