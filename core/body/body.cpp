// SPDX-License-Identifier: MIT
#include "core/body/body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ego {
namespace {

using J = HumanoidJoint;
using S = SamplePoint;

constexpr double kTemplateHeight = 1.78;

// An average adult man of 1.78 m, metres, canonical pose. Lengths after the usual anthropometric
// proportions (Winter, Biomechanics and Motor Control of Human Movement, table 4.1).
constexpr std::array<std::pair<J, Vec3>, 14> kOffsets = {{
    {J::kHips, {0.0, 0.95, 0.0}},
    {J::kSpine, {0.0, 0.10, -0.02}},
    {J::kChest, {0.0, 0.13, -0.01}},
    {J::kUpperChest, {0.0, 0.13, 0.0}},
    {J::kNeck, {0.0, 0.19, 0.0}},
    {J::kHead, {0.0, 0.10, 0.02}},
    {J::kLeftShoulder, {0.03, 0.13, 0.02}},
    {J::kLeftUpperArm, {0.145, 0.0, -0.02}},
    {J::kLeftLowerArm, {0.29, 0.0, 0.0}},
    {J::kLeftHand, {0.26, 0.0, 0.0}},
    {J::kLeftUpperLeg, {0.09, -0.03, 0.0}},
    {J::kLeftLowerLeg, {0.0, -0.43, 0.0}},
    {J::kLeftFoot, {0.0, -0.41, 0.0}},
    {J::kLeftToes, {0.0, -0.06, 0.13}},
}};

constexpr std::array<std::pair<S, Vec3>, 20> kSamples = {{
    {S::kCollarNotch, {0.0, 1.45, 0.035}},      {S::kSternumBase, {0.0, 1.24, 0.095}},
    {S::kNavel, {0.0, 1.06, 0.105}},            {S::kPubis, {0.0, 0.87, 0.085}},
    {S::kNapeBase, {0.0, 1.51, -0.095}},        {S::kMidBack, {0.0, 1.24, -0.135}},
    {S::kLowerBack, {0.0, 1.06, -0.105}},       {S::kSacrum, {0.0, 0.93, -0.125}},
    {S::kLeftChest, {0.10, 1.32, 0.10}},        {S::kLeftBellySide, {0.10, 1.05, 0.085}},
    {S::kLeftShoulderTop, {0.12, 1.49, -0.03}}, {S::kLeftShoulderBlade, {0.10, 1.36, -0.14}},
    {S::kLeftRibs, {0.155, 1.27, -0.015}},      {S::kLeftWaistSide, {0.145, 1.09, -0.01}},
    {S::kLeftHipSide, {0.17, 0.91, -0.01}},     {S::kForehead, {0.0, 1.70, 0.105}},
    {S::kCrown, {0.0, 1.78, 0.0}},              {S::kBackOfHead, {0.0, 1.68, -0.10}},
    {S::kNoseTip, {0.0, 1.645, 0.125}},         {S::kChin, {0.0, 1.57, 0.10}},
}};
constexpr std::array<std::pair<S, Vec3>, 3> kMoreSamples = {{
    {S::kThroat, {0.0, 1.545, 0.03}},
    {S::kLeftEar, {0.078, 1.66, 0.0}},
    {S::kLeftCheek, {0.055, 1.635, 0.08}},
}};

// Capsule radii of upper and lower segments, arms then legs.
constexpr std::array<double, 4> kRadii = {0.048, 0.036, 0.075, 0.050};

constexpr Vec3 Reflected(const Vec3& v) { return {-v.x, v.y, v.z}; }

/// Piecewise linear map through matching landmarks, continued with the slope of the nearest piece.
double Interpolate(const std::array<double, 7>& from, const std::array<double, 7>& to, double x) {
  std::size_t k = 1;
  while (k + 1 < from.size() && x > from[k]) ++k;
  const double span = from[k] - from[k - 1];
  const double t = (x - from[k - 1]) / span;
  return to[k - 1] + t * (to[k] - to[k - 1]);
}

/// Heights that order the trunk and head from the ground up; made increasing so that virtual
/// joints (equal heights) leave the map well defined.
std::array<double, 7> Landmarks(const std::array<Vec3, kJointCount>& joint, double height) {
  const double hips = 0.5 * (joint[Index(J::kLeftUpperLeg)].y + joint[Index(J::kRightUpperLeg)].y);
  const double shoulders =
      0.5 * (joint[Index(J::kLeftUpperArm)].y + joint[Index(J::kRightUpperArm)].y);
  std::array<double, 7> y = {
      0.0,
      hips,
      hips + 0.5 * (shoulders - hips),
      shoulders,
      joint[Index(J::kNeck)].y,
      joint[Index(J::kHead)].y,
      height,
  };
  for (std::size_t i = 1; i < y.size(); ++i) y[i] = std::max(y[i], y[i - 1] + 1e-3 * height);
  return y;
}

double HalfWidth(const std::array<Vec3, kJointCount>& joint, J left, J right) {
  return 0.5 * std::abs(joint[Index(left)].x - joint[Index(right)].x);
}

/// Depth of the line through hips, chest and head at a height: what samples keep their distance to.
double SpineDepth(const std::array<Vec3, kJointCount>& joint, double y) {
  constexpr std::array<J, 6> kLine = {J::kHips,       J::kSpine, J::kChest,
                                      J::kUpperChest, J::kNeck,  J::kHead};
  double z = joint[Index(kLine[0])].z;
  for (std::size_t i = 1; i < kLine.size(); ++i) {
    const Vec3& a = joint[Index(kLine[i - 1])];
    const Vec3& b = joint[Index(kLine[i])];
    if (y <= a.y) break;
    const double rise = b.y - a.y;
    z = rise > 1e-9 ? a.z + std::min(1.0, (y - a.y) / rise) * (b.z - a.z) : b.z;
  }
  return z;
}

}  // namespace

Skeleton TemplateSkeleton(double height) {
  Skeleton skeleton;
  const double scale = height / kTemplateHeight;
  for (const auto& [joint, offset] : kOffsets) {
    skeleton.offset[Index(joint)] = scale * offset;
    if (Mirror(joint) != joint) skeleton.offset[Index(Mirror(joint))] = scale * Reflected(offset);
  }
  return skeleton;
}

Body BodyFromSkeleton(std::string name, const Skeleton& skeleton, double height) {
  static const std::array<Vec3, kJointCount> kFrom =
      CanonicalPositions(TemplateSkeleton(kTemplateHeight));
  const std::array<Vec3, kJointCount> to = CanonicalPositions(skeleton);
  const std::array<double, 7> from_y = Landmarks(kFrom, kTemplateHeight);
  const std::array<double, 7> to_y = Landmarks(to, height);

  const double hip_ratio = HalfWidth(to, J::kLeftUpperLeg, J::kRightUpperLeg) /
                           HalfWidth(kFrom, J::kLeftUpperLeg, J::kRightUpperLeg);
  const double shoulder_ratio = HalfWidth(to, J::kLeftUpperArm, J::kRightUpperArm) /
                                HalfWidth(kFrom, J::kLeftUpperArm, J::kRightUpperArm);
  const double trunk_ratio = (to_y[3] - to_y[1]) / (from_y[3] - from_y[1]);
  const double head_ratio = (to_y[6] - to_y[5]) / (from_y[6] - from_y[5]);

  Body body;
  body.name = std::move(name);
  body.skeleton = skeleton;
  body.height = height;
  body.standing_root_height = skeleton.offset[0].y;

  const auto place = [&](SamplePoint point, const Vec3& p) {
    const double up = std::clamp((p.y - from_y[1]) / (from_y[3] - from_y[1]), 0.0, 1.0);
    const double width = IsHead(point) ? head_ratio : glm::mix(hip_ratio, shoulder_ratio, up);
    const double depth = IsHead(point) ? head_ratio : 0.5 * (trunk_ratio + width);
    const double y = Interpolate(from_y, to_y, p.y);
    const double z = SpineDepth(to, y) + depth * (p.z - SpineDepth(kFrom, p.y));
    body.surface.sample_ms[Index(point)] = {width * p.x, y, z};
    body.surface.attachment[Index(point)] = TemplateAttachment(point);
  };
  const auto place_pair = [&](SamplePoint point, const Vec3& p) {
    place(point, p);
    if (Mirror(point) != point) place(Mirror(point), Reflected(p));
  };
  for (const auto& [point, p] : kSamples) place_pair(point, p);
  for (const auto& [point, p] : kMoreSamples) place_pair(point, p);

  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const auto segment = static_cast<LimbSegment>(s);
    const double length = BoneLength(skeleton, EndJoint(segment));
    const double from = glm::length(kFrom[Index(EndJoint(segment))] -
                                    kFrom[Index(StartJoint(segment))]);
    const std::size_t kind = (IsArm(LimbOf(segment)) ? 0u : 2u) + (IsLower(segment) ? 1u : 0u);
    // Thickness follows length only half-way: long limbs are not fat ones.
    body.surface.limb_radius[s] =
        kRadii[kind] * std::sqrt(length / from * (height / kTemplateHeight));
  }

  const double scale = height / kTemplateHeight;
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vec3& wrist = to[Index(side == 0 ? J::kLeftHand : J::kRightHand)];
    HandSurface& hand = body.surface.hand[side];
    hand.half_thickness = 0.016 * scale;
    hand.palm_ms = wrist + Vec3{sign * 0.085 * scale, -hand.half_thickness, 0.0};
    hand.fingertip_ms = wrist + Vec3{sign * 0.185 * scale, -0.5 * hand.half_thickness, 0.0};

    const Vec3& ankle = to[Index(side == 0 ? J::kLeftFoot : J::kRightFoot)];
    FootSurface& foot = body.surface.foot[side];
    foot.heel_ms = {ankle.x, 0.0, ankle.z - 0.05 * scale};
    foot.ball_ms = {ankle.x, 0.0, ankle.z + 0.14 * scale};
    foot.toe_tip_ms = {ankle.x, 0.01 * scale, ankle.z + 0.21 * scale};
  }
  return body;
}

Body TemplateBody(double height) {
  return BodyFromSkeleton("template", TemplateSkeleton(height), height);
}

Body Scaled(const Body& body, double factor) {
  Body scaled = body;
  scaled.skeleton = Scaled(body.skeleton, factor);
  for (Vec3& p : scaled.surface.sample_ms) p *= factor;
  for (double& r : scaled.surface.limb_radius) r *= factor;
  for (HandSurface& hand : scaled.surface.hand) {
    hand.palm_ms *= factor;
    hand.fingertip_ms *= factor;
    hand.half_thickness *= factor;
  }
  for (FootSurface& foot : scaled.surface.foot) {
    foot.heel_ms *= factor;
    foot.ball_ms *= factor;
    foot.toe_tip_ms *= factor;
  }
  scaled.height *= factor;
  scaled.standing_root_height *= factor;
  return scaled;
}

}  // namespace ego
