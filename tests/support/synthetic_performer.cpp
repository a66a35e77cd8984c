// SPDX-License-Identifier: MIT
#include "tests/support/synthetic_performer.h"

#include <array>
#include <cmath>
#include <random>

#include "core/body/body.h"
#include "core/solve/posture.h"

namespace ego::test {
namespace {

using J = HumanoidJoint;

/// Amplitudes of the gymnastics, degrees: x, y, z of the joint's own frame.
Vec3 Amplitude(J joint) {
  switch (joint) {
    case J::kSpine:
    case J::kChest:
    case J::kUpperChest:
      return {10.0, 8.0, 6.0};
    case J::kNeck:
    case J::kHead:
      return {12.0, 15.0, 8.0};
    case J::kLeftShoulder:
    case J::kRightShoulder:
      return {0.0, 5.0, 6.0};
    case J::kLeftUpperArm:
    case J::kRightUpperArm:
      return {25.0, 45.0, 45.0};
    case J::kLeftHand:
    case J::kRightHand:
      return {0.0, 20.0, 25.0};
    case J::kLeftUpperLeg:
    case J::kRightUpperLeg:
      return {35.0, 15.0, 20.0};
    case J::kLeftFoot:
    case J::kRightFoot:
      return {20.0, 8.0, 8.0};
    default:
      return Vec3{0.0};
  }
}

Pose Gymnastics(const Skeleton& skeleton, double time, std::mt19937 phases) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto wave = [&] {
    const double frequency = 0.25 + 0.5 * uniform(phases);
    return std::sin(2.0 * kPi * (frequency * time + uniform(phases)));
  };
  Pose pose;
  pose.root_ws = skeleton.offset[0] + Vec3{0.3 * wave(), 0.05 * wave(), 0.3 * wave()};
  pose.rotation_ls[0] = glm::angleAxis(0.8 * wave(), kUp) * Exp({0.2 * wave(), 0.0, 0.15 * wave()});
  for (std::size_t j = 1; j < kJointCount; ++j) {
    const Vec3 a = Amplitude(static_cast<J>(j)) * Radians(1.0);
    const Vec3 turn{a.x * wave(), a.y * wave(), a.z * wave()};
    pose.rotation_ls[j] = Exp(turn);
  }
  // Arms swing about a place half-way down, elbows and knees bend.
  pose.rotation_ls[Index(J::kLeftUpperArm)] =
      glm::angleAxis(-0.6, Vec3{0, 0, 1}) * pose.rotation_ls[Index(J::kLeftUpperArm)];
  pose.rotation_ls[Index(J::kRightUpperArm)] =
      glm::angleAxis(0.6, Vec3{0, 0, 1}) * pose.rotation_ls[Index(J::kRightUpperArm)];
  for (const Limb limb : kLimbs) {
    const double flexion = 0.9 + 0.8 * wave();
    const double axial = IsArm(limb) ? 0.6 * wave() : 0.05 * wave();
    pose.rotation_ls[Index(JointsOf(limb).mid)] = glm::angleAxis(flexion, FlexionAxis(limb)) *
                                                  glm::angleAxis(axial, CanonicalDirection(limb));
  }
  return pose;
}

}  // namespace

SyntheticTake MakeSyntheticTake(const MarkerSet& set, const SyntheticOptions& options) {
  SyntheticTake made;
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  LengthValues lengths{};
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    // Real bodies are nearly symmetric.
    lengths[k] = p.mirror >= 0 && p.mirror < static_cast<int>(k)
                     ? lengths[static_cast<std::size_t>(p.mirror)]
                     : options.length_spread * (p.sizes_body ? 1.0 : 0.3) * normal(random);
  }
  made.truth.skeleton = SkeletonOf(options.scale, lengths);
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(TemplateSkeleton(1.78));
  for (std::size_t m = 0; m < set.markers.size(); ++m) {
    const SetMarker& place = set.markers[m];
    const Vec3 offset = place.position_ms - canonical[Index(place.joint)];
    const J end = BoneEnd(place.joint);
    Vec3 longer{0.0};
    if (end != place.joint) {
      longer = AlongBone(place.joint, offset) *
               (made.truth.skeleton.offset[Index(end)] -
                options.scale * TemplateSkeleton(1.78).offset[Index(end)]);
    }
    const Vec3 stray{normal(random), normal(random), normal(random)};
    made.truth.markers.push_back(
        {m, place.joint,
         options.scale * (offset + options.placement_spread * place.sigma * stray) + longer});
    if (place.region == MarkerRegion::kLimb || place.joint == J::kLeftShoulder ||
        place.joint == J::kRightShoulder) {
      BoundMarker& marker = made.truth.markers.back();
      const double along = AlongBone(place.joint, offset);
      marker.child = end == J::kLeftFoot || end == J::kRightFoot ? J::kHips : end;
      marker.share = {options.skin * (1.0 - along),
                      marker.child == J::kHips ? 0.0 : options.skin * along, options.skin};
    }
    made.take.labels.push_back(place.label);
  }
  made.take.name = "synthetic";
  made.take.rate_hz = options.rate_hz;
  made.take.frame_count = static_cast<std::size_t>(options.frames);
  const std::mt19937 phases(options.seed + 7);
  for (std::size_t f = 0; f < made.take.frame_count; ++f) {
    made.poses.push_back(
        Gymnastics(made.truth.skeleton, static_cast<double>(f) / options.rate_hz, phases));
    const ModelPose pose = ForwardKinematics(made.truth.skeleton, made.poses.back());
    for (const BoundMarker& marker : made.truth.markers) {
      const Vec3 noise{normal(random), normal(random), normal(random)};
      made.take.position_ws.push_back(MarkerPosition(marker, pose) + options.noise * noise);
      made.take.visible.push_back(1);
    }
  }
  return made;
}

double MeanJointDistance(const Skeleton& a, const Pose& pose_a, const Skeleton& b,
                         const Pose& pose_b) {
  const ModelPose placed_a = ForwardKinematics(a, pose_a);
  const ModelPose placed_b = ForwardKinematics(b, pose_b);
  double sum = 0.0;
  int count = 0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    if (joint == J::kLeftToes || joint == J::kRightToes) continue;
    sum += glm::distance(placed_a.position_ws[j], placed_b.position_ws[j]);
    ++count;
  }
  return sum / count;
}

}  // namespace ego::test
