// SPDX-License-Identifier: MIT
#include "core/solve/cold_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/solve/posture_cost.h"
#include "core/solve/rigid_fit.h"

namespace ego {
namespace {

using J = HumanoidJoint;

bool IsTrunk(J joint) {
  return joint == J::kHips || joint == J::kSpine || joint == J::kChest || joint == J::kUpperChest ||
         joint == J::kLeftShoulder || joint == J::kRightShoulder;
}

/// Fits the canonical pose's markers for which `wanted` holds.
template <class Predicate>
std::optional<RigidTransform> FitMarkers(const MarkerModel& model, const MarkerFrame& frame,
                                         const std::array<Vec3, kJointCount>& canonical,
                                         Predicate wanted) {
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  for (const BoundMarker& marker : model.markers) {
    if (!frame.visible[marker.label] || !wanted(marker.joint)) continue;
    from.push_back(canonical[Index(marker.joint)] + marker.offset_ls);
    to.push_back(frame.position_ws[marker.label]);
  }
  if (from.size() < 3) return std::nullopt;
  return FitRigid(from, to);
}

/// Mean of seen positions and of the same markers' canonical offsets, for markers near one end.
struct Cluster {
  Vec3 seen_ws{0.0};
  Vec3 canonical{0.0};  // relative to the limb's base joint
  int count = 0;

  void Add(const Vec3& seen, const Vec3& place) {
    seen_ws += seen;
    canonical += place;
    ++count;
  }
  void Finish() {
    if (count == 0) return;
    seen_ws /= count;
    canonical /= count;
  }
};

Quat ShortestTurn(const Vec3& from, const Vec3& to) {
  const Vec3 a = glm::normalize(from);
  const Vec3 b = glm::normalize(to);
  const double cosine = glm::dot(a, b);
  if (cosine < -0.999999) {
    const Vec3 side = std::abs(a.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return glm::angleAxis(kPi, glm::normalize(glm::cross(a, side)));
  }
  const Vec3 axis = glm::cross(a, b);
  return glm::normalize(Quat{1.0 + cosine, axis.x, axis.y, axis.z});
}

/// Points a limb's two bones at its elbow or knee markers and its wrist or ankle markers.
void PointLimb(const MarkerModel& model, const MarkerFrame& frame, Limb limb, Pose& pose) {
  const LimbJoints joints = JointsOf(limb);
  const Vec3 bone = CanonicalDirection(limb);
  const Vec3& upper = model.skeleton.offset[Index(joints.mid)];
  const Vec3& lower = model.skeleton.offset[Index(joints.end)];
  Cluster middle;
  Cluster end;
  for (const BoundMarker& marker : model.markers) {
    if (!frame.visible[marker.label]) continue;
    const Vec3& seen = frame.position_ws[marker.label];
    const double along = glm::dot(marker.offset_ls, bone);
    if (marker.joint == joints.base && along > 0.6 * glm::length(upper)) {
      middle.Add(seen, marker.offset_ls);
    } else if (marker.joint == joints.mid && along < 0.3 * glm::length(lower)) {
      middle.Add(seen, upper + marker.offset_ls);
    } else if (marker.joint == joints.mid && along > 0.6 * glm::length(lower)) {
      end.Add(seen, upper + marker.offset_ls);
    } else if (marker.joint == joints.end) {
      end.Add(seen, upper + lower + marker.offset_ls);
    }
  }
  middle.Finish();
  end.Finish();

  const ModelPose placed = ForwardKinematics(model.skeleton, pose);
  const Quat parent = placed.Rotation(Parent(joints.base));
  const Vec3 base_ws = placed.Position(joints.base);
  const Cluster& first = middle.count > 0 ? middle : end;
  if (first.count == 0) return;
  const Vec3 target = glm::conjugate(parent) * (first.seen_ws - base_ws);
  if (glm::length(target) < 0.02 || glm::length(first.canonical) < 0.02) return;
  const Quat swing = ShortestTurn(first.canonical, target);
  pose.rotation_ls[Index(joints.base)] = swing;
  pose.rotation_ls[Index(joints.mid)] = kIdentity;
  if (middle.count == 0 || end.count == 0) return;

  // Where the lower bone points, seen from the swung upper bone; the hinge must contain it.
  const Vec3 mid_ws = base_ws + parent * (swing * upper);
  const Vec3 to_end = glm::conjugate(parent * swing) * (end.seen_ws - mid_ws);
  if (glm::length(to_end) < 0.02) return;
  const Vec3 direction = glm::normalize(to_end);
  const double flexion = std::acos(std::clamp(glm::dot(direction, bone), -1.0, 1.0));
  const Vec3 hinge = FlexionAxis(limb);
  const Vec3 flexed = glm::cross(hinge, bone);  // where a flexed bone goes
  const double twist =
      std::atan2(glm::dot(direction, glm::cross(bone, flexed)), glm::dot(direction, flexed));
  const double sure = std::clamp((flexion - Radians(10.0)) / Radians(20.0), 0.0, 1.0);
  pose.rotation_ls[Index(joints.base)] = swing * glm::angleAxis(sure * twist, bone);
  pose.rotation_ls[Index(joints.mid)] = glm::angleAxis(flexion, hinge);
}

}  // namespace

Pose GuessPose(const MarkerModel& model, const MarkerFrame& frame, ColdGuess guess) {
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(model.skeleton);
  std::optional<RigidTransform> trunk;
  if (guess == ColdGuess::kPelvisAndLimbs) {
    trunk = FitMarkers(model, frame, canonical, [](J joint) { return joint == J::kHips; });
  }
  if (!trunk) trunk = FitMarkers(model, frame, canonical, IsTrunk);
  if (!trunk) trunk = FitMarkers(model, frame, canonical, [](J) { return true; });

  Pose pose;
  if (trunk) {
    pose.root_ws = trunk->rotation * canonical[0] + trunk->translation;
    pose.rotation_ls[0] = trunk->rotation;
  }
  if (guess != ColdGuess::kTPose) {
    const Posture& neutral = NeutralPosture();
    for (std::size_t j = 1; j < kJointCount; ++j) pose.rotation_ls[j] = neutral.rotation_ls[j];
  }
  if (guess == ColdGuess::kTrunkAndLimbs || guess == ColdGuess::kPelvisAndLimbs) {
    for (const Limb limb : kLimbs) PointLimb(model, frame, limb, pose);
  }
  return pose;
}

}  // namespace ego
