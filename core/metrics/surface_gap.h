// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// A posed body seen by its surfaces alone, for measuring. Brute force and exact; not for the frame
/// loop.
struct MeasuredBody {
  MeasuredBody(const Body& body, const Pose& pose);

  const Body* body;
  ModelPose pose;
  std::array<Vec3, kJointCount> canonical;
  std::array<Vec3, kSampleCount> sample_ws;

  Vec3 Palm(std::size_t side) const;
  /// The end of the hand's capsule, from the wrist in the middle of the hand's thickness, so that
  /// palm and fingertip lie on its skin.
  Vec3 HandEnd(std::size_t side) const;
  Vec3 Fingertip(std::size_t side) const;
  Vec3 Heel(std::size_t side) const;
  Vec3 Ball(std::size_t side) const;
  Vec3 ToeTip(std::size_t side) const;
};

/// Distance of a point to the trunk or head mesh, negative inside (by winding number), metres.
double TrunkDistance(const MeasuredBody& body, const Vec3& p);
double HeadDistance(const MeasuredBody& body, const Vec3& p);

/// Least distance from a point of an arm to trunk, head, the capsules of the other limbs and the
/// other hand, metres; negative inside.
double SurfaceGap(const MeasuredBody& body, Limb arm, const Vec3& p);

/// The place on one body's surface that is nearest to a point of an arm, named so that it can be
/// found on another body: a triangle with barycentric coordinates, or a share of a bone (the other
/// limbs' segments, then the other hand) whose surface around it is meant.
struct SurfacePlace {
  bool on_mesh = true;
  std::size_t index = 0;
  Vec3 barycentric{0.0};
  double axial = 0.0;
};
SurfacePlace NearestPlace(const MeasuredBody& body, Limb arm, const Vec3& p);

/// Bone or hand on which a place lies that is not on a mesh, as a capsule in place.
struct MeasuredBone {
  Vec3 start{0.0};
  Vec3 end{0.0};
  double radius = 0.0;
};
/// Segment `k` of the limbs, or after them the hand of the arm that is not `arm`.
MeasuredBone BoneOf(const MeasuredBody& body, Limb arm, std::size_t k);
/// The place on a body's trunk or head.
Vec3 OnMesh(const MeasuredBody& body, const SurfacePlace& place);

/// How deep the capsules of an arm sink into trunk or head, metres, zero if nowhere. The half of
/// the upper arm at the shoulder belongs to the trunk and does not count.
double ArmDepth(const MeasuredBody& body, Limb arm);

}  // namespace ego
