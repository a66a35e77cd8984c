// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/character.h"
#include "core/skeleton/humanoid_map.h"

namespace tinygltf {
class Model;
}

namespace ego {

/// The nodes of a file as a tree with parents first, and how both count them.
struct NodeOrder {
  std::vector<int> node_of;    // tree joint -> node of the file
  std::vector<int> joint_of;   // node of the file -> tree joint, -1 outside the scene
  std::vector<int> parent_of;  // tree joint -> parent tree joint, -1
};

/// Orders the nodes of the default scene, or of the whole file when skins reach outside it.
/// Errors: cyclic nodes, two parents, an index out of range.
Result<NodeOrder> OrderNodes(const tinygltf::Model& model);

/// Transform of a node relative to its parent as the file holds it. Error: a number that is not
/// finite.
Result<Mat4> NodeLocal(const tinygltf::Model& model, int node);

/// The node tree in bind pose. Where skins hold inverse bind matrices those say how a joint stands
/// in the rest pose; all other nodes keep their place relative to their parent.
struct SceneSkeleton {
  JointTree tree;
  NodeOrder order;
  /// Per skin, per joint: the inverse bind matrix (identity where the file has none).
  std::vector<std::vector<Mat4>> inverse_bind;
  std::vector<bool> is_skin_joint;  // per tree joint
  std::vector<std::string> notes;
};
Result<SceneSkeleton> ReadSkeleton(const tinygltf::Model& model);

/// Human bones declared by VRM 0.x or VRMC_vrm 1.0, as tree joints; -1 elsewhere.
Result<HumanoidHints> ReadVrmHints(const tinygltf::Model& model, const NodeOrder& order);

/// Fills palette, parts, materials, images and notes of a character whose nodes are those of
/// `skeleton`.
Result<void> ReadMeshes(const tinygltf::Model& model, const SceneSkeleton& skeleton,
                        Character& character, const Progress& progress);
Result<void> ReadMaterials(const tinygltf::Model& model, Character& character);

}  // namespace ego
