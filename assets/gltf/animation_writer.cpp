// SPDX-License-Identifier: MIT
#include "assets/gltf/animation_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>

#include "core/base/check.h"
#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

struct Trs {
  Vec3 translation{0.0};
  Quat rotation = kIdentity;
  Vec3 scale{1.0};
};

/// Translation, rotation and scale of a matrix without shear; a mirrored one gets a negative x.
Trs Decomposed(const Mat4& matrix) {
  Trs trs;
  trs.translation = Vec3(matrix[3]);
  Mat4 axes = matrix;
  const double sign = glm::determinant(Mat3(matrix)) < 0.0 ? -1.0 : 1.0;
  for (int c = 0; c < 3; ++c) {
    const double length = glm::length(Vec3(matrix[c])) * (c == 0 ? sign : 1.0);
    trs.scale[c] = length;
    if (length != 0.0) axes[c] /= length;
  }
  trs.rotation = RotationOf(axes);
  return trs;
}

/// Nodes that follow the body: mapped ones, those that move a mesh, and all below them.
std::vector<bool> Carried(const Character& character) {
  const std::size_t count = character.nodes.joints.size();
  std::vector<bool> carried(count, false);
  for (const int node : character.rig.node) {
    if (node >= 0) carried[At(node)] = true;
  }
  for (const MeshPart& part : character.parts) {
    for (const MeshPart::Influences& influences : part.influences) {
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (influences.weight[k] > 0.0f) {
          carried[At(character.palette[influences.entry[k]].node)] = true;
        }
      }
    }
  }
  for (std::size_t n = 0; n < count; ++n) {
    const int parent = character.nodes.joints[n].parent;
    if (parent >= 0 && carried[At(parent)]) carried[n] = true;
  }
  return carried;
}

/// Appends floats to the binary buffer as one accessor and returns its index.
std::size_t AddAccessor(Json& root, GltfDocument& document, const std::vector<float>& numbers,
                        std::size_t components, const char* type) {
  document.bin.resize((document.bin.size() + 3) / 4 * 4);
  const std::size_t offset = document.bin.size();
  const std::size_t bytes = numbers.size() * sizeof(float);
  document.bin.resize(offset + bytes);
  std::memcpy(document.bin.data() + offset, numbers.data(), bytes);
  root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  Json accessor = {{"bufferView", root["bufferViews"].size() - 1},
                   {"componentType", kFloat},
                   {"count", numbers.size() / components},
                   {"type", type}};
  if (components == 1) {
    accessor["min"] = {numbers.front()};
    accessor["max"] = {numbers.back()};
  }
  root["accessors"].push_back(std::move(accessor));
  return root["accessors"].size() - 1;
}

void SetTransform(Json& node, const Trs& trs) {
  node.erase("matrix");
  node["translation"] = {trs.translation.x, trs.translation.y, trs.translation.z};
  node["rotation"] = {trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w};
  node["scale"] = {trs.scale.x, trs.scale.y, trs.scale.z};
}

bool IsSkinnedMesh(const Json& node) { return node.contains("mesh") && node.contains("skin"); }

/// One node's local transforms over time.
struct Track {
  std::size_t joint = 0;
  bool hips = false;
  std::vector<float> translation;
  std::vector<float> rotation;
};

/// Channels of the tracks that change (the hips always).
Json Channels(Json& root, GltfDocument& document, std::vector<Track>& tracks,
              std::span<const int> node_of, std::size_t times) {
  Json samplers = Json::array();
  Json channels = Json::array();
  const auto changes = [](const std::vector<float>& v, std::size_t width, float tolerance) {
    for (std::size_t i = width; i < v.size(); ++i) {
      if (std::abs(v[i] - v[i % width]) > tolerance) return true;
    }
    return false;
  };
  const auto add = [&](const Track& track, const std::vector<float>& values, std::size_t components,
                       const char* type, const char* path) {
    samplers.push_back({{"input", times},
                        {"output", AddAccessor(root, document, values, components, type)},
                        {"interpolation", "LINEAR"}});
    channels.push_back({{"sampler", samplers.size() - 1},
                        {"target", {{"node", node_of[track.joint]}, {"path", path}}}});
  };
  for (const Track& track : tracks) {
    float extent = 0.0f;
    for (const float v : track.translation) extent = std::max(extent, std::abs(v));
    if (track.hips || changes(track.rotation, 4, 0.0f)) {
      add(track, track.rotation, 4, "VEC4", "rotation");
    }
    if (track.hips || changes(track.translation, 3, 1e-6f * extent)) {
      add(track, track.translation, 3, "VEC3", "translation");
    }
  }
  return {{"samplers", samplers}, {"channels", channels}};
}

Result<void> Put(GltfDocument& document, std::span<const int> node_of, const Character& character,
                 const PoseAnimation& animation, const Progress& progress) {
  const std::span<const Pose> poses = animation.poses;
  Json root = Json::parse(document.json);
  root.erase("animations");
  const Rig& rig = character.rig;
  const std::vector<JointTree::Joint>& joints = character.nodes.joints;
  const std::size_t count = joints.size();
  const std::vector<bool> carried = Carried(character);
  const int hips = rig.node[Index(HumanoidJoint::kHips)];

  // A finger joint moves in its hand, if any hand is ever bent.
  const bool hands_bend = std::any_of(poses.begin(), poses.end(), [](const Pose& pose) {
    return pose.hand != std::array<HandShape, 2>{};
  });
  const auto finger = [&](std::size_t n) {
    return hands_bend && !rig.fingers.joint_of.empty() ? rig.fingers.joint_of[n] : -1;
  };
  std::vector<Track> tracks;
  for (std::size_t n = 0; n < count; ++n) {
    if (!carried[n] || IsSkinnedMesh(root["nodes"][At(node_of[n])])) continue;
    const int parent = joints[n].parent;
    const bool rides = parent >= 0 && carried[At(parent)] &&
                       rig.driver[At(parent)] == rig.driver[n] && finger(At(parent)) == finger(n);
    if (!rides) tracks.push_back({n, static_cast<int>(n) == hips, {}, {}});
    // A hips node below a node that the hips carry has no motion of its own.
    if (rides && static_cast<int>(n) == hips) tracks.push_back({n, true, {}, {}});
  }

  std::vector<Mat4> posed(count);
  const auto local = [&](std::size_t n) {
    const int parent = joints[n].parent;
    return parent < 0 ? posed[n] : glm::inverse(posed[At(parent)]) * posed[n];
  };
  for (std::size_t f = 0; f < poses.size(); ++f) {
    if (f % 256 == 0 &&
        !Report(progress, static_cast<double>(f) / static_cast<double>(poses.size()),
                "writing the animation")) {
      return Error{"cancelled"};
    }
    PoseNodes(rig, poses[f], posed);
    for (std::size_t n = 0; n < count; ++n) {
      if (!carried[n]) posed[n] = rig.canonical_global[n];
    }
    if (f == 0) {
      for (std::size_t n = 0; n < count; ++n) {
        Json& node = root["nodes"][At(node_of[n])];
        if (IsSkinnedMesh(node)) continue;
        const Mat4 first = local(n);
        SetTransform(node, Decomposed(first));
      }
    }
    for (Track& track : tracks) {
      const Trs trs = Decomposed(local(track.joint));
      Quat q = trs.rotation;
      if (f > 0) {
        const float* last = track.rotation.data() + track.rotation.size() - 4;
        const double same = q.x * last[0] + q.y * last[1] + q.z * last[2] + q.w * last[3];
        if (same < 0.0) q = -q;
      }
      for (const double v : {q.x, q.y, q.z, q.w}) track.rotation.push_back(static_cast<float>(v));
      for (int c = 0; c < 3; ++c) {
        track.translation.push_back(static_cast<float>(trs.translation[c]));
      }
    }
  }
  std::vector<float> times(poses.size());
  for (std::size_t f = 0; f < times.size(); ++f) {
    times[f] = static_cast<float>(static_cast<double>(f) / animation.rate_hz);
  }
  for (const char* key : {"bufferViews", "accessors"}) {
    if (!root.contains(key)) root[key] = Json::array();
  }
  const std::size_t input = AddAccessor(root, document, times, 1, "SCALAR");
  Json written = Channels(root, document, tracks, node_of, input);
  written["name"] = animation.name;
  root["animations"] = {std::move(written)};
  root["buffers"] = {{{"byteLength", document.bin.size()}}};
  document.json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  return {};
}

}  // namespace

Result<void> PutAnimation(GltfDocument& document, std::span<const int> node_of,
                          const Character& character, const PoseAnimation& animation,
                          const Progress& progress) {
  EGO_CHECK(node_of.size() == character.nodes.joints.size());
  if (animation.poses.empty() || !(animation.rate_hz > 0.0)) {
    return Error{document.name + ": an animation needs at least one pose and a rate above 0"};
  }
  try {
    return Put(document, node_of, character, animation, progress);
  } catch (const nlohmann::json::exception&) {
    return Error{document.name + ": its JSON does not have the structure of glTF 2.0"};
  }
}

}  // namespace ego
