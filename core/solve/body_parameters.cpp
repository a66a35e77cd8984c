// SPDX-License-Identifier: MIT
#include "core/solve/body_parameters.h"

#include <algorithm>

#include "core/body/body.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kTemplateHeight = 1.78;
constexpr Vec3 kX{1.0, 0.0, 0.0};
constexpr Vec3 kY{0.0, 1.0, 0.0};
constexpr Vec3 kZ{0.0, 0.0, 1.0};

const Skeleton& Template() {
  static const Skeleton kSkeleton = TemplateSkeleton(kTemplateHeight);
  return kSkeleton;
}

std::array<LengthParameter, kLengthCount> MakeParameters() {
  std::array<LengthParameter, kLengthCount> all{};
  std::size_t n = 0;
  const Skeleton& body = Template();

  LengthParameter trunk;
  trunk.template_length = 0.0;
  for (const J joint : {J::kSpine, J::kChest, J::kUpperChest, J::kNeck}) {
    trunk.template_length += body.offset[Index(joint)].y;
  }
  // The subdivision of the spine is the template's; the clavicles rise with the neck.
  for (const J joint :
       {J::kSpine, J::kChest, J::kUpperChest, J::kNeck, J::kLeftShoulder, J::kRightShoulder}) {
    trunk.shifts[trunk.shift_count++] = {
        joint, kY * (body.offset[Index(joint)].y / trunk.template_length)};
  }
  trunk.sigma = 0.03;
  trunk.sizes_body = true;
  all[n++] = trunk;

  LengthParameter neck;
  neck.template_length = glm::length(body.offset[Index(J::kHead)]);
  neck.shifts[neck.shift_count++] = {J::kHead, glm::normalize(body.offset[Index(J::kHead)])};
  neck.sigma = 0.012;
  all[n++] = neck;

  const auto add_pair = [&](J left, const Vec3& direction, double length, double sigma,
                            bool sizes_body) {
    for (const bool is_left : {true, false}) {
      LengthParameter p;
      const Vec3 d = is_left ? direction : Vec3{-direction.x, direction.y, direction.z};
      p.shifts[p.shift_count++] = {is_left ? left : Mirror(left), d};
      p.template_length = length;
      p.sigma = sigma;
      p.sizes_body = sizes_body;
      p.mirror = static_cast<int>(is_left ? n + 1 : n - 1);
      all[n++] = p;
    }
  };
  const auto length = [&](J joint) { return glm::length(body.offset[Index(joint)]); };
  add_pair(J::kLeftUpperArm, kX, body.offset[Index(J::kLeftUpperArm)].x, 0.015, false);
  add_pair(J::kLeftUpperArm, kY, 0.0, 0.015, false);
  add_pair(J::kLeftUpperArm, kZ, 0.0, 0.012, false);
  add_pair(J::kLeftUpperLeg, kX, body.offset[Index(J::kLeftUpperLeg)].x, 0.008, false);
  add_pair(J::kLeftLowerArm, kX, length(J::kLeftLowerArm), 0.020, true);
  add_pair(J::kLeftHand, kX, length(J::kLeftHand), 0.020, true);
  add_pair(J::kLeftLowerLeg, -kY, length(J::kLeftLowerLeg), 0.030, true);
  add_pair(J::kLeftFoot, -kY, length(J::kLeftFoot), 0.030, true);
  return all;
}

}  // namespace

const std::array<LengthParameter, kLengthCount>& LengthParameters() {
  static const std::array<LengthParameter, kLengthCount> kParameters = MakeParameters();
  return kParameters;
}

Skeleton SkeletonOf(double scale, const LengthValues& values) {
  Skeleton skeleton = Scaled(Template(), scale);
  for (std::size_t k = 0; k < kLengthCount; ++k) {
    const LengthParameter& p = LengthParameters()[k];
    for (std::size_t s = 0; s < p.shift_count; ++s) {
      skeleton.offset[Index(p.shifts[s].joint)] += values[k] * p.shifts[s].per_metre;
    }
  }
  double legs = 0.0;
  for (const J joint : {J::kLeftUpperLeg, J::kLeftLowerLeg, J::kLeftFoot, J::kRightUpperLeg,
                        J::kRightLowerLeg, J::kRightFoot}) {
    legs -= 0.5 * skeleton.offset[Index(joint)].y;
  }
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(Template());
  skeleton.offset[0] = {0.0, legs + scale * canonical[Index(J::kLeftFoot)].y, 0.0};
  return skeleton;
}

HumanoidJoint BoneEnd(HumanoidJoint joint) {
  switch (joint) {
    case J::kSpine:
      return J::kChest;
    case J::kChest:
      return J::kUpperChest;
    case J::kUpperChest:
      return J::kNeck;
    case J::kNeck:
      return J::kHead;
    case J::kLeftShoulder:
      return J::kLeftUpperArm;
    case J::kLeftUpperArm:
      return J::kLeftLowerArm;
    case J::kLeftLowerArm:
      return J::kLeftHand;
    case J::kRightShoulder:
      return J::kRightUpperArm;
    case J::kRightUpperArm:
      return J::kRightLowerArm;
    case J::kRightLowerArm:
      return J::kRightHand;
    case J::kLeftUpperLeg:
      return J::kLeftLowerLeg;
    case J::kLeftLowerLeg:
      return J::kLeftFoot;
    case J::kRightUpperLeg:
      return J::kRightLowerLeg;
    case J::kRightLowerLeg:
      return J::kRightFoot;
    default:
      return joint;
  }
}

double AlongBone(HumanoidJoint joint, const Vec3& template_offset) {
  const HumanoidJoint end = BoneEnd(joint);
  if (end == joint) return 0.0;
  const Vec3& bone = Template().offset[Index(end)];
  return std::clamp(glm::dot(template_offset, bone) / glm::dot(bone, bone), 0.0, 1.0);
}

}  // namespace ego
