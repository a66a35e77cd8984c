// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include <tiny_gltf.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "assets/gltf/accessor_reader.h"
#include "assets/gltf/scene_reader.h"

namespace ego {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

std::string NameOf(const tinygltf::Model& model, int node) {
  const std::string& name = model.nodes[At(node)].name;
  return name.empty() ? "node " + std::to_string(node) : name;
}

bool InRange(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool Finite(const Mat4& m) {
  double sum = 0.0;
  for (int c = 0; c < 4; ++c) sum += glm::dot(m[c], m[c]);
  return std::isfinite(sum);
}

/// The skin that says most about the rest pose first.
std::vector<std::size_t> SkinsBySize(const tinygltf::Model& model) {
  std::vector<std::size_t> skins(model.skins.size());
  for (std::size_t s = 0; s < skins.size(); ++s) skins[s] = s;
  std::stable_sort(skins.begin(), skins.end(), [&](std::size_t a, std::size_t b) {
    return model.skins[a].joints.size() > model.skins[b].joints.size();
  });
  return skins;
}

/// Rest transforms of the skin joints: with B = (node transform of the skin's topmost joint) *
/// (its inverse bind matrix), joint j rests at B * inverse(IBM_j). B carries the skin's bind space
/// to the scene, whatever unit and axes it has; skins after the first join at a shared joint.
void PlaceSkinJoints(const tinygltf::Model& model, SceneSkeleton& skeleton,
                     const std::vector<Mat4>& node_global, std::vector<Mat4>& rest,
                     std::vector<bool>& placed) {
  const std::vector<int>& parent = skeleton.order.parent_of;
  std::vector<int> depth(parent.size(), 0);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    depth[j] = parent[j] < 0 ? 0 : depth[At(parent[j])] + 1;
  }
  for (const std::size_t s : SkinsBySize(model)) {
    const tinygltf::Skin& skin = model.skins[s];
    if (skin.inverseBindMatrices < 0) continue;
    const auto usable = [&](std::size_t k) {
      return std::abs(glm::determinant(Mat3(skeleton.inverse_bind[s][k]))) > 1e-30;
    };
    int anchor = -1;
    bool shared = false;
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const std::size_t j = At(skeleton.order.joint_of[At(skin.joints[k])]);
      if (!usable(k)) continue;
      const bool better =
          anchor < 0 || (placed[j] && !shared) ||
          (placed[j] == shared &&
           depth[j] < depth[At(skeleton.order.joint_of[At(skin.joints[At(anchor)])])]);
      if (better) {
        anchor = static_cast<int>(k);
        shared = placed[j];
      }
    }
    if (anchor < 0) continue;
    const std::size_t top = At(skeleton.order.joint_of[At(skin.joints[At(anchor)])]);
    const Mat4 bind_to_scene =
        (shared ? rest[top] : node_global[top]) * skeleton.inverse_bind[s][At(anchor)];
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const std::size_t j = At(skeleton.order.joint_of[At(skin.joints[k])]);
      if (placed[j] || !usable(k)) continue;
      rest[j] = bind_to_scene * glm::inverse(skeleton.inverse_bind[s][k]);
      placed[j] = Finite(rest[j]);
    }
  }
}

Result<void> ReadBindMatrices(const tinygltf::Model& model, SceneSkeleton& skeleton) {
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const tinygltf::Skin& skin = model.skins[s];
    const std::string what = "skin " + std::to_string(s);
    std::vector<Mat4> matrices(skin.joints.size(), Mat4(1.0));
    for (const int joint : skin.joints) {
      if (!InRange(joint, model.nodes.size())) {
        return Error{what + " refers to node " + std::to_string(joint) +
                     ", which the file does not have"};
      }
      skeleton.is_skin_joint[At(skeleton.order.joint_of[At(joint)])] = true;
    }
    if (skin.inverseBindMatrices >= 0) {
      const auto numbers =
          ReadNumbers(model, skin.inverseBindMatrices, 16, what + ", inverseBindMatrices");
      if (!numbers) return Error{numbers.error()};
      if (numbers->size() < 16 * matrices.size()) {
        return Error{what + " has " + std::to_string(numbers->size() / 16) +
                     " inverse bind matrices for " + std::to_string(matrices.size()) + " joints"};
      }
      for (std::size_t k = 0; k < matrices.size(); ++k) {
        matrices[k] = Mat4(glm::make_mat4(numbers->data() + 16 * k));
      }
    }
    skeleton.inverse_bind.push_back(std::move(matrices));
  }
  return {};
}

}  // namespace

Result<Mat4> NodeLocal(const tinygltf::Model& model, int index) {
  const tinygltf::Node& node = model.nodes[At(index)];
  Mat4 local(1.0);
  if (node.matrix.size() == 16) {
    local = glm::make_mat4(node.matrix.data());
  } else {
    if (node.translation.size() == 3) {
      local = glm::translate(local, Vec3(glm::make_vec3(node.translation.data())));
    }
    if (node.rotation.size() == 4) {
      const Quat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      const double length = glm::length(q);
      if (length > 0.0) local *= glm::mat4_cast(q / length);
    }
    if (node.scale.size() == 3) local = glm::scale(local, Vec3(glm::make_vec3(node.scale.data())));
  }
  if (!Finite(local)) {
    return Error{"node '" + NameOf(model, index) + "' has a transform that is not finite"};
  }
  return local;
}

Result<NodeOrder> OrderNodes(const tinygltf::Model& model) {
  const std::size_t count = model.nodes.size();
  if (count == 0) return Error{"the file has no nodes"};
  std::vector<int> parent(count, -1);
  for (std::size_t n = 0; n < count; ++n) {
    for (const int child : model.nodes[n].children) {
      if (!InRange(child, count)) {
        return Error{"node '" + NameOf(model, static_cast<int>(n)) + "' has the child " +
                     std::to_string(child) + ", which the file does not have"};
      }
      if (parent[At(child)] >= 0) {
        return Error{"node '" + NameOf(model, child) + "' has two parents"};
      }
      parent[At(child)] = static_cast<int>(n);
    }
  }
  const auto walk = [&](const std::vector<int>& roots) {
    NodeOrder order;
    order.joint_of.assign(count, -1);
    std::vector<int> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      if (order.joint_of[At(node)] >= 0) continue;
      order.joint_of[At(node)] = static_cast<int>(order.node_of.size());
      order.node_of.push_back(node);
      const int above = parent[At(node)];
      order.parent_of.push_back(above >= 0 ? order.joint_of[At(above)] : -1);
      const std::vector<int>& children = model.nodes[At(node)].children;
      stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    return order;
  };
  std::vector<int> all_roots;
  for (std::size_t n = 0; n < count; ++n) {
    if (parent[n] < 0) all_roots.push_back(static_cast<int>(n));
  }
  NodeOrder whole = walk(all_roots);
  if (whole.node_of.size() != count) {
    for (std::size_t n = 0; n < count; ++n) {
      if (whole.joint_of[n] < 0) {
        return Error{"node '" + NameOf(model, static_cast<int>(n)) +
                     "' is its own ancestor; expected a tree"};
      }
    }
  }
  const int scene = model.defaultScene >= 0 ? model.defaultScene : 0;
  if (!InRange(scene, model.scenes.size())) return whole;
  std::vector<int> roots;
  for (const int node : model.scenes[At(scene)].nodes) {
    if (!InRange(node, count)) {
      return Error{"the scene refers to node " + std::to_string(node) +
                   ", which the file does not have"};
    }
    // A scene lists roots; one that lists a child as well still shows it once.
    if (parent[At(node)] < 0) roots.push_back(node);
  }
  NodeOrder shown = walk(roots);
  for (const tinygltf::Skin& skin : model.skins) {
    for (const int joint : skin.joints) {
      if (InRange(joint, count) && shown.joint_of[At(joint)] < 0) return whole;
    }
  }
  return shown.node_of.empty() ? whole : shown;
}

Result<SceneSkeleton> ReadSkeleton(const tinygltf::Model& model) {
  SceneSkeleton skeleton;
  auto order = OrderNodes(model);
  if (!order) return Error{order.error()};
  skeleton.order = *std::move(order);
  const std::size_t count = skeleton.order.node_of.size();
  skeleton.is_skin_joint.assign(count, false);
  std::vector<Mat4> local(count);
  std::vector<Mat4> node_global(count);
  for (std::size_t j = 0; j < count; ++j) {
    const auto matrix = NodeLocal(model, skeleton.order.node_of[j]);
    if (!matrix) return Error{matrix.error()};
    local[j] = *matrix;
    const int parent = skeleton.order.parent_of[j];
    node_global[j] = parent < 0 ? local[j] : node_global[At(parent)] * local[j];
  }
  if (auto read = ReadBindMatrices(model, skeleton); !read) return Error{read.error()};

  std::vector<Mat4> rest(count);
  std::vector<bool> placed(count, false);
  PlaceSkinJoints(model, skeleton, node_global, rest, placed);
  skeleton.tree.joints.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    const int parent = skeleton.order.parent_of[j];
    JointTree::Joint& joint = skeleton.tree.joints[j];
    joint.name = NameOf(model, skeleton.order.node_of[j]);
    joint.parent = parent;
    if (!placed[j]) rest[j] = parent < 0 ? local[j] : rest[At(parent)] * local[j];
    joint.rest_local = local[j];
    if (parent >= 0 && placed[j] && std::abs(glm::determinant(Mat3(rest[At(parent)]))) > 1e-30) {
      joint.rest_local = glm::inverse(rest[At(parent)]) * rest[j];
    } else if (placed[j]) {
      joint.rest_local = rest[j];
    }
  }
  return skeleton;
}

Result<HumanoidHints> ReadVrmHints(const tinygltf::Model& model, const NodeOrder& order) {
  HumanoidHints hints;
  const auto declare = [&](const std::string& bone, const tinygltf::Value& node) -> std::string {
    const auto joint = JointNamed(bone);
    if (!joint || !node.IsInt()) return {};
    const int index = node.GetNumberAsInt();
    if (!InRange(index, order.joint_of.size()) || order.joint_of[At(index)] < 0) {
      return "VRM bone '" + bone + "' is node " + std::to_string(index) +
             ", which the scene does not have";
    }
    hints.node[Index(*joint)] = order.joint_of[At(index)];
    return {};
  };
  std::string bad;
  if (const auto vrm = model.extensions.find("VRMC_vrm"); vrm != model.extensions.end()) {
    const tinygltf::Value& bones = vrm->second.Get("humanoid").Get("humanBones");
    if (bones.IsObject()) {
      for (const std::string& bone : bones.Keys()) {
        const std::string why = declare(bone, bones.Get(bone).Get("node"));
        if (!why.empty()) bad = why;
      }
    }
  } else if (const auto old = model.extensions.find("VRM"); old != model.extensions.end()) {
    const tinygltf::Value& bones = old->second.Get("humanoid").Get("humanBones");
    for (std::size_t i = 0; bones.IsArray() && i < bones.ArrayLen(); ++i) {
      const tinygltf::Value& bone = bones.Get(i).Get("bone");
      if (!bone.IsString()) continue;
      const std::string why = declare(bone.Get<std::string>(), bones.Get(i).Get("node"));
      if (!why.empty()) bad = why;
    }
  }
  if (!bad.empty()) return Error{bad};
  return hints;
}

}  // namespace ego
