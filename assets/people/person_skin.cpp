// SPDX-License-Identifier: MIT
#include "assets/people/person_skin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ego {
namespace {

using J = HumanoidJoint;
using field::SmoothStep;

/// Hands a share of the parent's weight on to the child.
void Pass(JointWeights& weights, J from, J to, double share) {
  const double moved = weights[Index(from)] * share;
  weights[Index(from)] -= moved;
  weights[Index(to)] += moved;
}

}  // namespace

JointWeights SkinWeights(const PersonShape& shape, const Vec3& p_ms) {
  const PersonParameters& m = shape.parameters();
  const bool left = p_ms.x >= 0.0;
  const Vec3 p{std::abs(p_ms.x), p_ms.y, p_ms.z};
  const double length = shape.TrunkLength();
  const auto side = [&](J left_joint) { return left ? left_joint : Mirror(left_joint); };
  const auto step_up = [&](J joint, double below, double above) {
    const double y = shape.Joint(joint).y;
    return SmoothStep(y - below, y + above, p.y);
  };

  JointWeights w{};
  w[Index(J::kHips)] = 1.0;

  const double trunk = shape.Trunk(p);
  const double arm = shape.Arm(p);
  const double leg = shape.Leg(p);
  const Vec3& hip = shape.Joint(J::kLeftUpperLeg);
  const Vec3& shoulder = shape.Joint(J::kLeftUpperArm);

  // Up the spine.
  Pass(w, J::kHips, J::kSpine, step_up(J::kSpine, 0.13 * length, 0.11 * length));
  Pass(w, J::kSpine, J::kChest, step_up(J::kChest, 0.11 * length, 0.11 * length));
  Pass(w, J::kChest, J::kUpperChest, step_up(J::kUpperChest, 0.11 * length, 0.11 * length));
  const double from_axis = std::hypot(p.x, p.z - shape.Joint(J::kNeck).z);
  const double neck_only = 1.0 - SmoothStep(1.1 * m.neck_radius, 2.0 * m.neck_radius, from_axis);
  const bool high = p.y > shape.ChinHeight();
  const double on_neck = step_up(J::kNeck, 0.05 * length, 0.06 * length) * (high ? 1.0 : neck_only);
  const double chin_band = 0.25 * m.head_height;
  const double nearer_head =
      SmoothStep(-0.10 * m.head_height, 0.10 * m.head_height, shape.Neck(p) - shape.Head(p));
  const double on_head = std::max(
      nearer_head * SmoothStep(-0.8 * m.neck_length, 0.0, p.y - shape.ChinHeight()),
      SmoothStep(0.05 * m.head_height, 0.05 * m.head_height + chin_band, p.y - shape.ChinHeight()));
  Pass(w, J::kUpperChest, J::kNeck, std::max(on_neck, on_head));
  Pass(w, J::kNeck, J::kHead, on_head);

  // Out along the arm.
  const double arm_radius = m.upper_arm_radius;
  const double out = SmoothStep(shoulder.x - 1.3 * arm_radius, shoulder.x + 0.9 * arm_radius, p.x);
  const double own = SmoothStep(-0.9 * arm_radius, 0.5 * arm_radius, trunk - arm);
  const double to_arm = p.y > hip.y + 0.3 * length ? std::min(out, 1.0) * own : 0.0;
  const double reach_in = SmoothStep(0.25 * shoulder.x, 0.95 * shoulder.x, p.x);
  const double raised = SmoothStep(shoulder.y - 0.22 * length, shoulder.y + 0.02 * length, p.y);
  const double to_clavicle = std::max(0.65 * reach_in * raised * (1.0 - on_head), to_arm);
  for (const J from : {J::kHips, J::kSpine, J::kChest, J::kUpperChest, J::kNeck}) {
    Pass(w, from, side(J::kLeftShoulder), to_clavicle);
  }
  if (to_clavicle > 0.0)
    Pass(w, side(J::kLeftShoulder), side(J::kLeftUpperArm), to_arm / to_clavicle);
  const double elbow = shape.Joint(J::kLeftLowerArm).x;
  const double wrist = shape.Joint(J::kLeftHand).x;
  const double elbow_band = 0.65 * m.upper_arm_radius;
  Pass(w, side(J::kLeftUpperArm), side(J::kLeftLowerArm),
       SmoothStep(elbow - elbow_band, elbow + elbow_band, p.x));
  Pass(w, side(J::kLeftLowerArm), side(J::kLeftHand),
       SmoothStep(wrist - 0.17 * m.hand_length, wrist + 0.13 * m.hand_length, p.x));

  // Down along the leg. Above the crotch the two legs share the middle.
  const double band = 0.75 * m.upper_leg_radius;
  const double down = 1.0 - SmoothStep(hip.y - 1.25 * band, hip.y + 0.9 * band, p.y);
  // Between the legs the pelvis keeps its skin: it would be dragged along with a lifted thigh.
  const double floor = hip.y - 0.16 * length;
  const double held = SmoothStep(floor - 0.9 * band, floor + 0.3 * band, p.y) *
                      (1.0 - SmoothStep(0.10 * hip.x, 0.85 * hip.x, p.x));
  const double to_leg =
      p.y > hip.y + 0.3 * length || arm < std::min(trunk, leg) ? 0.0 : down * (1.0 - held);
  Pass(w, J::kHips, side(J::kLeftUpperLeg), to_leg);
  const double crotch =
      SmoothStep(hip.y - 0.16 * length - 0.4 * band, hip.y - 0.16 * length + band, p.y);
  const double middle = 0.03 * m.height * crotch;
  if (middle > 1e-6) {
    const double across = 0.5 * (1.0 - SmoothStep(0.0, middle, p.x));
    Pass(w, side(J::kLeftUpperLeg), Mirror(side(J::kLeftUpperLeg)), across);
  }
  const double knee = shape.Joint(J::kLeftLowerLeg).y;
  const double knee_band = 0.8 * m.upper_leg_radius;
  Pass(w, side(J::kLeftUpperLeg), side(J::kLeftLowerLeg),
       1.0 - SmoothStep(knee - knee_band, knee + knee_band, p.y));
  const Vec3& ankle = shape.Joint(J::kLeftFoot);
  const double from_ankle = p.y - 0.5 * std::max(0.0, p.z - ankle.z);
  Pass(w, side(J::kLeftLowerLeg), side(J::kLeftFoot),
       1.0 - SmoothStep(ankle.y - 0.25 * m.ankle_height, ankle.y + 0.75 * m.ankle_height,
                        from_ankle));
  const double toes = shape.Joint(J::kLeftToes).z;
  Pass(w, side(J::kLeftFoot), side(J::kLeftToes),
       SmoothStep(toes - 0.09 * m.foot_length, toes + 0.09 * m.foot_length, p.z));
  return w;
}

SkinJointWeights SkinWeightsWithFingers(const PersonShape& shape, const Vec3& p_ms) {
  const JointWeights body = SkinWeights(shape, p_ms);
  SkinJointWeights weights{};
  std::copy(body.begin(), body.end(), weights.begin());
  for (std::size_t side = 0; side < 2; ++side) {
    double& palm = weights[Index(side == 0 ? J::kLeftHand : J::kRightHand)];
    if (palm == 0.0) continue;
    const double whole = palm;
    const Vec3 wrist = shape.Joint(J::kLeftHand);
    const Vec3 p{side == 0 ? p_ms.x : -p_ms.x, p_ms.y, p_ms.z};
    const auto shares = hand::FingerShares((p - wrist) / shape.parameters().hand_length);
    for (std::size_t f = 0; f < shares.size(); ++f) {
      weights[kJointCount + side * hand::kFingerJointCount + f] = whole * shares[f];
      palm -= whole * shares[f];
    }
  }
  return weights;
}

SkinJointWeights Rigid(std::size_t skin_joint) {
  SkinJointWeights weights{};
  weights.at(skin_joint) = 1.0;
  return weights;
}

JointWeights WithoutFingers(const SkinJointWeights& weights) {
  JointWeights body{};
  std::copy_n(weights.begin(), kJointCount, body.begin());
  for (std::size_t f = 0; f < 2 * hand::kFingerJointCount; ++f) {
    const J palm = f < hand::kFingerJointCount ? J::kLeftHand : J::kRightHand;
    body[Index(palm)] += weights[kJointCount + f];
  }
  return body;
}

Attachment StrongestFour(const JointWeights& weights) {
  std::array<std::size_t, kJointCount> order{};
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  Attachment attachment;
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += weights[order[k]];
  for (std::size_t k = 0; k < 4; ++k) {
    const double weight = weights[order[k]] / sum;
    attachment.joint[k] = static_cast<J>(order[weight > 0.0 ? k : 0]);
    attachment.weight[k] = weight;
  }
  return attachment;
}

}  // namespace ego
