// SPDX-License-Identifier: MIT
#include "core/model/finger_rig.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/base/check.h"
#include "core/geometry/rotation.h"
#include "core/skeleton/joint_names.h"

namespace ego {
namespace {

constexpr std::size_t kSegments = 3;

/// Which digit a joint's name says it belongs to; -1 for none.
int DigitNamed(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const NameRole role = ReadJointName(name).role;
  if (role == NameRole::kThumb || lower.find("thumb") != std::string::npos) return 0;
  if (lower.find("carpal") != std::string::npos) return -1;
  if (role == NameRole::kIndex) return 1;
  if (role == NameRole::kLittle) return 4;
  if (lower.find("ring") != std::string::npos) return 3;
  return lower.find("middle") != std::string::npos ? 2 : -1;
}

/// The axes of one finger from where its joints are.
void SetAxes(std::span<FingerRig::Joint*> finger, const Vec3& tip) {
  const Vec3 palm = -kUp;
  const Vec3 out{finger[0]->side == 0 ? 1.0 : -1.0, 0.0, 0.0};
  for (std::size_t k = 0; k < finger.size(); ++k) {
    const Vec3 next = k + 1 < finger.size() ? finger[k + 1]->position_ms : tip;
    const Vec3 along = NormalizedOr(next - finger[k]->position_ms, out);
    if (finger[k]->digit != 0) {
      finger[k]->axis = NormalizedOr(glm::cross(along, palm), Vec3{0.0, 0.0, -out.x});
      continue;
    }
    // The thumb's first joint lays it under the palm, the others bend it across.
    const Vec3 across = k == 0 ? palm : glm::normalize(Vec3{0.0, -0.35, -1.0});
    const Vec3 from = k == 0 ? Vec3{0.0, 0.0, 1.0} : along;
    finger[k]->axis = NormalizedOr(glm::cross(from, across), out);
  }
}

}  // namespace

FingerRig FindFingers(const JointTree& tree, std::span<const HumanoidJoint> driver,
                      std::span<const Mat4> canonical_global) {
  const std::size_t count = tree.joints.size();
  EGO_CHECK(driver.size() == count && canonical_global.size() == count);
  FingerRig rig;
  rig.joint_of.assign(count, -1);
  std::array<std::array<std::array<int, kSegments + 1>, HandShape::kDigits>, 2> chain;
  for (auto& hand : chain) {
    for (auto& digit : hand) digit.fill(-1);
  }
  std::array<std::array<Vec3, HandShape::kDigits>, 2> tip{};
  for (std::size_t n = 0; n < count; ++n) {
    if (driver[n] != HumanoidJoint::kLeftHand && driver[n] != HumanoidJoint::kRightHand) continue;
    const std::size_t side = driver[n] == HumanoidJoint::kLeftHand ? 0 : 1;
    const int parent = tree.joints[n].parent;
    const int above = parent >= 0 ? rig.joint_of[static_cast<std::size_t>(parent)] : -1;
    rig.joint_of[n] = above;
    const Vec3 at(canonical_global[n][3]);
    if (above >= 0) {
      const FingerRig::Joint& before = rig.joints[static_cast<std::size_t>(above)];
      tip[side][before.digit] = at;
      // Of several children only the first goes on with the finger; the others hang on it.
      if (before.segment + 1 >= kSegments || DigitNamed(tree.joints[n].name) < 0 ||
          chain[side][before.digit][before.segment + 1] >= 0 ||
          glm::distance(at, before.position_ms) < 1e-6) {
        continue;
      }
      rig.joint_of[n] = static_cast<int>(rig.joints.size());
      chain[side][before.digit][before.segment + 1] = rig.joint_of[n];
      rig.joints.push_back({above, side, before.digit, before.segment + 1, at, {}});
      continue;
    }
    const int digit = DigitNamed(tree.joints[n].name);
    if (digit < 0 || chain[side][static_cast<std::size_t>(digit)][0] >= 0) continue;
    rig.joint_of[n] = static_cast<int>(rig.joints.size());
    chain[side][static_cast<std::size_t>(digit)][0] = rig.joint_of[n];
    tip[side][static_cast<std::size_t>(digit)] = at;
    rig.joints.push_back({-1, side, static_cast<std::size_t>(digit), 0, at, {}});
  }
  if (rig.joints.empty()) return {};
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t digit = 0; digit < HandShape::kDigits; ++digit) {
      std::vector<FingerRig::Joint*> finger;
      for (const int j : chain[side][digit]) {
        if (j >= 0) finger.push_back(&rig.joints[static_cast<std::size_t>(j)]);
      }
      if (finger.empty()) continue;
      Vec3 end = tip[side][digit];
      // A last joint without a tip goes on as the one before.
      if (glm::distance(end, finger.back()->position_ms) < 1e-6 && finger.size() > 1) {
        end += finger.back()->position_ms - finger[finger.size() - 2]->position_ms;
      }
      SetAxes(finger, end);
    }
  }
  return rig;
}

void BendFingers(const FingerRig& fingers, const std::array<HandShape, 2>& hand,
                 std::span<Mat4> motion) {
  EGO_CHECK(motion.size() == fingers.joints.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const FingerRig::Joint& joint = fingers.joints[i];
    const HandShape::Digit& digit = hand[joint.side].digit[joint.digit];
    const double angle = joint.segment == 0   ? digit.bend
                         : joint.segment == 1 ? digit.curl
                                              : kOuterJointShare * digit.curl;
    const Quat turn = glm::angleAxis(angle, joint.axis);
    Mat4 own = glm::mat4_cast(turn);
    own[3] = Vec4(joint.position_ms - turn * joint.position_ms, 1.0);
    motion[i] = joint.parent < 0 ? own : motion[static_cast<std::size_t>(joint.parent)] * own;
  }
}

}  // namespace ego
