// SPDX-License-Identifier: MIT
#include "core/model/joint_override.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/model/fit_rig.h"
#include "core/skeleton/humanoid_search.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::array kRequired = {
    J::kHips,          J::kHead,         J::kLeftUpperArm, J::kLeftLowerArm,  J::kRightUpperArm,
    J::kRightLowerArm, J::kLeftUpperLeg, J::kLeftLowerLeg, J::kRightUpperLeg, J::kRightLowerLeg};

/// Fingers and toe tips hang on the hands and feet of the new map.
void FindTipsAnew(const JointTree& tree, HumanoidMap& map) {
  HumanoidHints hints;
  for (std::size_t j = 0; j < kJointCount; ++j) hints.node[j] = map.joint[j].node;
  map.fingertip = map.toe_tip = map.index_base = map.little_base = map.thumb_base = {-1, -1};
  HumanoidSearch search{tree, hints, MakeBodyTree(tree, {}, hints.node), std::move(map)};
  FindTips(search);
  map = std::move(search.map);
}

}  // namespace

Result<Character> WithJointOverrides(const Character& character, const JointOverrides& overrides) {
  Character mended = character;
  auto& joint = mended.map.joint;
  const auto nodes = static_cast<int>(character.nodes.joints.size());
  const auto name = [&](int node) {
    return "'" + character.nodes.joints[static_cast<std::size_t>(node)].name + "'";
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (!overrides[j]) continue;
    const int node = *overrides[j];
    if (node < -1 || node >= nodes) {
      return Error{character.name + ": " + std::string(Name(static_cast<J>(j))) +
                   " cannot be node " + std::to_string(node) + " of " + std::to_string(nodes)};
    }
    for (std::size_t other = 0; node >= 0 && other < kJointCount; ++other) {
      if (other == j || joint[other].node != node) continue;
      if (overrides[other]) {
        if (*overrides[other] != node) continue;  // its own turn comes
        return Error{character.name + ": " + name(node) + " cannot be both " +
                     std::string(Name(static_cast<J>(j))) + " and " +
                     std::string(Name(static_cast<J>(other)))};
      }
      joint[other] = {joint[j].node, joint[j].node < 0 ? 0.0 : 0.5,
                      "its node was given to " + std::string(Name(static_cast<J>(j)))};
    }
    joint[j] = {node, 1.0,
                node < 0 ? std::string("set to none by hand") : name(node) + " set by hand"};
  }
  for (const J j : kRequired) {
    if (joint[Index(j)].node >= 0) continue;
    return Error{character.name + ": a body cannot do without a joint for " + std::string(Name(j))};
  }
  for (std::size_t a = 0; a < kJointCount; ++a) {
    for (std::size_t b = a + 1; b < kJointCount; ++b) {
      if (joint[a].node < 0 || joint[a].node != joint[b].node) continue;
      return Error{character.name + ": " + name(joint[a].node) + " cannot be both " +
                   std::string(Name(static_cast<J>(a))) + " and " +
                   std::string(Name(static_cast<J>(b)))};
    }
  }
  FindTipsAnew(mended.nodes, mended.map);
  if (auto fitted = FitRig(mended, character.rig.metres_per_unit); !fitted) {
    return Error{character.name + ": " + fitted.error()};
  }
  return mended;
}

}  // namespace ego
