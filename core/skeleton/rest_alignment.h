// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "core/base/math.h"
#include "core/base/result.h"
#include "core/skeleton/humanoid_map.h"
#include "core/skeleton/joint_tree.h"
#include "core/skeleton/pose.h"
#include "core/skeleton/skeleton.h"

namespace ego {

/// How a rest pose, whatever it is, turns into the canonical T-pose: one rigid motion per joint.
///
/// Spaces: "file" is the file's own axes and unit; "stage" is Y up, +Z forward, metres. The body
/// is first turned from file to stage as a whole (`body_rotation`), then bone by bone. The trunk,
/// neck, head and clavicles keep their rest shape; arms are stretched sideways with the elbow's
/// hinge along its canonical axis and the palm down, legs downwards; feet keep their slope and are
/// only turned forward.
struct Alignment {
  /// Canonical skeleton, metres, lowest sole on y = 0, hips above the origin.
  Skeleton skeleton;
  double metres_per_unit = 1.0;
  /// Turns file axes into stage axes (B).
  Quat body_rotation = kIdentity;
  /// The point of the rest pose, file space, that lies under the hips at the level of the lowest
  /// sole: it becomes the stage's origin.
  Vec3 ground_point{0.0};
  /// A_j: turns the joint's rest orientation in file space into its canonical one in stage space,
  /// canonical rotation of the node = A_j * rest rotation of the node.
  std::array<Quat, kJointCount> to_canonical;
  /// Joint positions in the rest pose, file space; virtual joints where they were put.
  std::array<Vec3, kJointCount> rest_position;

  /// Rotation of joint j, canonical convention, world (stage) space, from its node's rotation:
  ///   R_j = B * node_rotation * inverse(node_rest_rotation) * inverse(A_j),
  /// both in file space (global, without scale). Identity when the node is in its canonical pose.
  Quat CanonicalRotation(HumanoidJoint j, const Quat& node_rotation,
                         const Quat& node_rest_rotation) const;
  /// A point of a motion in file space as a point on the stage. The origin of the file stays the
  /// origin of the stage, so a motion's path, and its own floor, are kept.
  Vec3 ToStage(const Vec3& point_file) const;
  /// What rides rigidly on joint j: rest pose in file space to canonical pose in stage space,
  /// metres. Global matrix of a node in the canonical pose = CanonicalFromRest(j) * rest global.
  Mat4 CanonicalFromRest(HumanoidJoint j) const;
  /// Lifts or lowers the canonical skeleton so that `lowest_y` (metres) becomes the ground: for
  /// bodies with a mesh, whose soles are known better than joints tell.
  void MoveGround(double lowest_y);
  /// Turns a foot and its toes about the ankle, in the canonical pose, so that the toes rise by
  /// `angle` radians: for bodies with a mesh, whose soles tell better than joints how a foot
  /// stands.
  void RaiseToes(bool left, double angle);
};

/// The pose of a motion's frame from node rotations and positions in file space (global, one per
/// joint of the tree). Joints that the rig lacks, and locked ones, follow their parent.
Pose PoseFromNodes(const Alignment& alignment, const HumanoidMap& map,
                   std::span<const Quat> node_rest_rotation, std::span<const Quat> node_rotation,
                   std::span<const Vec3> node_position);

/// Global rotations of matrices that may carry scale and shear (polar part by Gram-Schmidt on the
/// columns; mirrored matrices keep right-handed axes).
Quat RotationOf(const Mat4& matrix);

/// Aligns a rest pose. `rest_global` has one matrix per joint of the tree, file space (often
/// tree.RestGlobal(); for BVH a frame of the motion serves when the zero pose is none).
/// Up is the file's axis nearest to hips -> head when within 30 degrees of it, else that direction
/// itself; left is from the right to the left hips and shoulders.
///
/// Missing joints: neck and clavicles lie zero-length at their child; missing spine joints at the
/// next lower joint (locked); missing hands at the forearm's end and missing feet at the shin's
/// (locked); missing toes at the foot (locked).
/// The result depends continuously on the rest pose but for the choice of the up axis.
/// Error: the rest pose has no shape (hips and head or both hips in one place), as one sentence.
Result<Alignment> AlignRestPose(const JointTree& tree, std::span<const Mat4> rest_global,
                                const HumanoidMap& map, double metres_per_unit = 1.0);

}  // namespace ego
