// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/character.h"
#include "core/model/mesh_point.h"
#include "core/skeleton/pose.h"

namespace ego {

/// The limb that a joint moves, toes included; nothing for joints of trunk and head.
std::optional<Limb> LimbOf(HumanoidJoint joint);

/// The skinned mesh of one character in one pose, for measuring what it touches and where it sinks
/// into itself. Exact on the triangles; not for the frame loop.
class SkinMeasure {
 public:
  /// Keeps a reference.
  explicit SkinMeasure(const Character& character);

  void SetPose(const Pose& pose);
  const PosedMesh& mesh() const { return mesh_; }

  /// How deep skin lies in other skin.
  struct Sinking {
    double depth = 0.0;                       // metres, 0 where nothing sinks in
    HumanoidJoint of = HumanoidJoint::kHips;  // joint that carries the vertex that is deepest
    HumanoidJoint in = HumanoidJoint::kHips;  // joint that carries the skin nearest to it
  };
  /// The deepest vertex of any limb within the body without that limb. Looked at are hands and
  /// forearms, feet and calves, and the far halves of upper arms and thighs: near shoulders and
  /// hips, in elbows and in the hollows of knees skin always folds into itself.
  Sinking Deepest() const;

  /// Signed distance of a point to the skin of the body without one limb, metres, negative inside.
  double Gap(const Vec3& point_ws, Limb without) const;

 private:
  struct Vertex {
    HumanoidJoint joint = HumanoidJoint::kHips;  // that carries most of it
    int limb = -1;                               // as Limb, -1: none
    bool far = false;                            // far enough from the trunk to be looked at
  };

  const Character& character_;
  std::vector<std::vector<Vertex>> vertices_;  // per part
  PosedMesh mesh_;
};

}  // namespace ego
