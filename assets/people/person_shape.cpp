// SPDX-License-Identifier: MIT
#include "assets/people/person_shape.h"

#include <algorithm>
#include <cmath>

#include "assets/people/person_hand.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using field::Capsule;
using field::Ellipsoid;
using field::Profile;
using field::SmoothIntersection;
using field::SmoothStep;
using field::SmoothUnion;

/// Radius along a segment, scaled so that its mean over the middle (where a radius is measured)
/// is `radius`.
Profile LimbProfile(double radius, std::vector<Vec2> shape) {
  const Profile raw(shape);
  double sum = 0.0;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) sum += raw(0.3 + 0.4 * i / kSteps);
  const double factor = radius * (kSteps + 1) / sum;
  for (Vec2& p : shape) p.y *= factor;
  return Profile(std::move(shape));
}

/// Distance to a segment of varying radius; `bulge` moves its middle line aside half-way.
double Segment(const Vec3& p, const Vec3& a, const Vec3& b, const Profile& radius,
               const Vec3& bulge) {
  const Vec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - t * ab - 4.0 * t * (1.0 - t) * bulge) - radius(t);
}

}  // namespace

Skeleton PersonSkeleton(const PersonParameters& m) {
  const double hip = m.ankle_height + m.leg_length;
  const double neck = m.height - m.head_height - m.neck_length;
  const double trunk = neck - hip;
  const double root = 0.05 * trunk;  // hips joint above the hip joints
  const double depth = trunk / 0.58;
  const double head = 0.14 * m.head_height;  // head joint above the chin

  Skeleton skeleton;
  const auto set = [&](J joint, const Vec3& offset) {
    skeleton.offset[Index(joint)] = offset;
    if (Mirror(joint) != joint) {
      skeleton.offset[Index(Mirror(joint))] = {-offset.x, offset.y, offset.z};
    }
  };
  set(J::kHips, {0.0, hip + root, 0.0});
  set(J::kSpine, {0.0, 0.17 * trunk, -0.02 * depth});
  set(J::kChest, {0.0, 0.225 * trunk, -0.01 * depth});
  set(J::kUpperChest, {0.0, 0.225 * trunk, 0.0});
  set(J::kNeck, {0.0, 0.33 * trunk, 0.0});
  set(J::kHead, {0.0, m.neck_length + head, 0.02 * depth});
  const double clavicle = 0.17 * m.shoulder_width / 2.0;
  set(J::kLeftShoulder, {clavicle, 0.215 * trunk, 0.015 * depth});
  set(J::kLeftUpperArm, {m.shoulder_width / 2.0 - clavicle, 0.0, -0.01 * depth});
  set(J::kLeftLowerArm, {m.arm_length * m.upper_arm_share, 0.0, 0.0});
  set(J::kLeftHand, {m.arm_length * (1.0 - m.upper_arm_share), 0.0, 0.0});
  set(J::kLeftUpperLeg, {m.hip_joint_width / 2.0, -root, 0.0});
  set(J::kLeftLowerLeg, {0.0, -m.leg_length * m.thigh_share, 0.0});
  set(J::kLeftFoot, {0.0, -m.leg_length * (1.0 - m.thigh_share), 0.0});
  set(J::kLeftToes, {0.0, -0.75 * m.ankle_height, 0.48 * m.foot_length});
  return skeleton;
}

PersonShape::PersonShape(const PersonParameters& parameters)
    : parameters_(parameters),
      skeleton_(PersonSkeleton(parameters)),
      joint_(CanonicalPositions(skeleton_)) {
  const PersonParameters& m = parameters_;
  head_ = PersonHead(m, ChinHeight(), Joint(J::kHead).z + 0.09 * m.head_depth);

  const double hips = m.hips_width / 2.0;
  const double waist = m.waist_width / 2.0;
  const double chest = m.chest_width / 2.0;
  const double hd = m.hips_depth;
  const double cd = m.chest_depth;
  const double belly_back =
      -std::min(0.46 * m.belly_thickness, 0.042 * m.height + 0.1 * m.belly_thickness);
  const double belly_front = m.belly_thickness + belly_back;
  const auto y = [&](double share) { return HipHeight() + share * TrunkLength(); };
  trunk_width_ = Profile({{y(-0.20), 0.86 * hips},
                          {y(-0.06), 0.98 * hips},
                          {y(0.03), hips},
                          {y(0.14), glm::mix(hips, waist, 0.25)},
                          {y(0.27), waist},
                          {y(0.46), glm::mix(waist, chest, 0.55)},
                          {y(0.68), chest},
                          {y(0.82), 0.98 * chest},
                          {y(0.91), 0.80 * chest},
                          {y(0.98), 0.52 * chest},
                          {y(1.08), 0.36 * chest}});
  // A belly is rounder than a curve through few points would make it.
  const double flat = std::min(belly_front, 0.47 * std::max(cd, 0.9 * hd));
  const double bulge = belly_front - flat;
  trunk_front_ = Profile({{y(-0.20), 0.30 * hd},
                          {y(-0.08), 0.38 * hd},
                          {y(0.00), glm::mix(0.43 * hd, flat, 0.15) + 0.22 * bulge},
                          {y(0.08), glm::mix(0.45 * hd, flat, 0.35) + 0.62 * bulge},
                          {y(0.17), glm::mix(0.45 * hd, flat, 0.7) + 0.91 * bulge},
                          {y(0.27), belly_front},
                          {y(0.38), glm::mix(flat, 0.45 * cd, 0.3) + 0.90 * bulge},
                          {y(0.48), glm::mix(flat, 0.45 * cd, 0.6) + 0.66 * bulge},
                          {y(0.59), glm::mix(flat, 0.45 * cd, 0.85) + 0.33 * bulge},
                          {y(0.70), 0.45 * cd + 0.08 * bulge},
                          {y(0.82), 0.34 * cd},
                          {y(0.91), 0.17 * cd},
                          {y(0.98), 0.05 * cd},
                          {y(1.08), 0.0}});
  trunk_back_ = Profile({{y(-0.20), -0.36 * hd},
                         {y(-0.05), -0.45 * hd},
                         {y(0.08), -0.46 * hd},
                         {y(0.27), belly_back},
                         {y(0.46), glm::mix(belly_back, -0.54 * cd, 0.6)},
                         {y(0.68), -0.55 * cd},
                         {y(0.82), -0.53 * cd},
                         {y(0.91), -0.46 * cd},
                         {y(0.98), -0.38 * cd},
                         {y(1.08), -0.34 * cd}});
  upper_arm_ = LimbProfile(m.upper_arm_radius,
                           {{0.0, 1.06}, {0.22, 1.12}, {0.5, 1.02}, {0.8, 0.90}, {1.0, 0.84}});
  lower_arm_ = LimbProfile(m.lower_arm_radius,
                           {{0.0, 1.06}, {0.25, 1.16}, {0.55, 1.0}, {0.85, 0.78}, {1.0, 0.74}});
  upper_leg_ = LimbProfile(m.upper_leg_radius,
                           {{0.0, 1.20}, {0.2, 1.14}, {0.5, 1.0}, {0.8, 0.86}, {1.0, 0.78}});
  lower_leg_ = LimbProfile(m.lower_leg_radius,
                           {{0.0, 1.04}, {0.3, 1.16}, {0.6, 0.97}, {0.85, 0.76}, {1.0, 0.72}});
}

double PersonShape::Trunk(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double x = std::abs(p.x);
  const double front = trunk_front_(p.y);
  const double back = trunk_back_(p.y);
  double d = field::Superellipse(x, p.z - 0.5 * (front + back), trunk_width_(p.y),
                                 0.5 * (front - back), 2.3);
  const double length = TrunkLength();
  const double bottom = HipHeight() - 0.15 * length;
  const double top = Joint(J::kNeck).y;
  d = SmoothIntersection(d, bottom - p.y, 0.16 * length);
  d = SmoothIntersection(d, p.y - top, 0.08 * length);
  const Vec3 q{x, p.y, p.z};
  const Vec3& shoulder = Joint(J::kLeftUpperArm);
  const double slope = 0.80 * m.upper_arm_radius;
  d = SmoothUnion(d,
                  Capsule(q, {0.0, top - 0.02 * length, shoulder.z - 0.01 * length},
                          {0.93 * shoulder.x, shoulder.y, shoulder.z}, 1.1 * slope, slope),
                  0.12 * length);
  d = SmoothUnion(
      d,
      Ellipsoid(q, {0.24 * m.hips_width, HipHeight() - 0.02 * length, -0.28 * m.hips_depth},
                {0.235 * m.hips_width, 0.17 * length, 0.26 * m.hips_depth}),
      0.05 * length);
  if (m.bust > 0.0) {
    d = SmoothUnion(
        d,
        Ellipsoid(q, {0.23 * m.chest_width, HipHeight() + 0.655 * length, 0.30 * m.chest_depth},
                  {0.25 * m.chest_width, 0.15 * length, 0.15 * m.chest_depth + m.bust}),
        0.10 * length);
  }
  return d;
}

double PersonShape::ArmWith(const Vec3& p, double leaner) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  const Vec3& wrist = Joint(J::kLeftHand);
  const Vec3& elbow = Joint(J::kLeftLowerArm);
  const double upper = Segment(q, Joint(J::kLeftUpperArm), elbow, upper_arm_, Vec3(0.0));
  const double lower = Segment(q, elbow, wrist, lower_arm_, Vec3(0.0));
  double d = SmoothUnion(upper, lower, 0.5 * parameters_.lower_arm_radius);
  const double r = parameters_.lower_arm_radius;
  d = SmoothUnion(d, glm::length(q - elbow + Vec3{0.1 * r, 0.0, 0.62 * r}) - 0.46 * r, 0.5 * r);
  const double reach = parameters_.hand_length;
  // Far from the hand its many small parts cannot matter.
  const double far = glm::length(q - wrist - Vec3{0.5 * reach, 0.0, 0.0}) - 0.75 * reach;
  const double k = 0.10 * reach;
  return far > d + k && far > 0.0 ? d : SmoothUnion(d, Hand(q, leaner), k);
}

double PersonShape::Hand(const Vec3& p, double leaner) const {
  const double length = parameters_.hand_length;
  return length * hand::Distance((p - Joint(J::kLeftHand)) / length, leaner);
}

double PersonShape::Leg(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const Vec3 q{std::abs(p.x), p.y, p.z};
  const Vec3& knee = Joint(J::kLeftLowerLeg);
  const Vec3& ankle = Joint(J::kLeftFoot);
  const double upper =
      Segment(q, Joint(J::kLeftUpperLeg), knee, upper_leg_, {0.0, 0.0, 0.08 * m.upper_leg_radius});
  const double lower = Segment(q, knee, ankle, lower_leg_, {0.0, 0.0, -0.16 * m.lower_leg_radius});
  const double r = m.lower_leg_radius;
  double d = SmoothUnion(upper, lower, 0.4 * r);
  d = SmoothUnion(d, glm::length(q - knee - Vec3{0.0, 0.15 * r, 0.58 * r}) - 0.50 * r, 0.5 * r);
  return SmoothUnion(d, Foot(q), 0.10 * m.foot_length);
}

double PersonShape::Foot(const Vec3& p) const {
  const double length = parameters_.foot_length;
  const Vec3& ankle = Joint(J::kLeftFoot);
  const Vec3 q = Vec3{p.x - ankle.x, p.y, p.z - ankle.z} / length;  // in foot lengths
  double d = Capsule(q, {0.0, 0.105, -0.085}, {0.0, 0.13, 0.16}, 0.135, 0.130);
  d = SmoothUnion(d, Ellipsoid(q, {0.012, 0.085, 0.40}, {0.178, 0.125, 0.27}), 0.14);
  d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.075, 0.60}, {0.155, 0.105, 0.18}), 0.08);
  return SmoothIntersection(d, -q.y, 0.03) * length;
}

double PersonShape::Neck(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const Vec3& neck = Joint(J::kNeck);
  return Capsule(p, {0.0, neck.y - 0.6 * m.neck_radius, neck.z},
                 {0.0, ChinHeight() + 0.30 * m.head_height, HeadDepth() - 0.16 * m.head_depth},
                 1.06 * m.neck_radius, 0.96 * m.neck_radius);
}

double PersonShape::Distance(const Vec3& p, double leaner) const {
  const PersonParameters& m = parameters_;
  const double length = TrunkLength();
  double d = Trunk(p);
  d = SmoothUnion(d, ArmWith(p, leaner), 0.9 * m.upper_arm_radius);
  // What is farther away than its seam is wide has no effect and is left out.
  if (p.y < HipHeight() + 0.25 * length) d = SmoothUnion(d, Leg(p), 0.5 * m.upper_leg_radius);
  if (p.y > Joint(J::kNeck).y - 0.3 * length) {
    d = SmoothUnion(d, Neck(p), 0.10 * length);
    d = SmoothUnion(d, head_.Skin(p, leaner > 0.0), 0.10 * m.head_height);
    d = SmoothUnion(d, head_.Hair(p), 0.012 * m.head_height);
  }
  return d;
}

Vec3 PersonShape::Normal(const Vec3& p) const {
  constexpr double kStep = 1e-4;
  const PersonShape& f = *this;
  const Vec3 dx{kStep, 0.0, 0.0};
  const Vec3 dy{0.0, kStep, 0.0};
  const Vec3 dz{0.0, 0.0, kStep};
  const Vec3 g{f(p + dx) - f(p - dx), f(p + dy) - f(p - dy), f(p + dz) - f(p - dz)};
  const double size = glm::length(g);
  return size > 1e-12 ? g / size : kUp;
}

double PersonShape::TrimWidth() const { return 0.0105 * parameters_.height; }

double PersonShape::CuffReach() const {
  const double end = parameters_.sleeve_end;
  const double elbow = Joint(J::kLeftLowerArm).x;
  return end < 1.0 ? glm::mix(Joint(J::kLeftUpperArm).x, elbow, end)
                   : glm::mix(elbow, Joint(J::kLeftHand).x, end - 1.0);
}

Region PersonShape::LegRegion(const Vec3& p, double arm, double trunk, double leg) const {
  const PersonParameters& m = parameters_;
  if (arm < std::min(trunk, leg)) return Region::kSkin;
  const Vec3& ankle = Joint(J::kLeftFoot);
  const Vec3& knee = Joint(J::kLeftLowerLeg);
  const double foot = m.foot_length;
  const double along = (p.z - ankle.z) / foot;
  // The sole is thicker under the heel.
  if (p.y < foot * (0.062 + 0.022 * SmoothStep(0.25, -0.05, along))) return Region::kSoles;
  const double shoe_top = ankle.y + 0.10 * foot * (1.0 - 0.9 * along);
  if (p.y < shoe_top) {
    // A cap over the toes, and a padded rim.
    const bool cap = along > 0.60 + 0.9 * std::max(0.0, p.y / foot - 0.10);
    return cap || p.y > shoe_top - 0.065 * foot ? Region::kSoles : Region::kShoes;
  }
  const double hem = m.trouser_end < 1.0 ? glm::mix(HipHeight(), knee.y, m.trouser_end)
                                         : glm::mix(knee.y, ankle.y, m.trouser_end - 1.0);
  return p.y < hem ? Region::kSkin : Region::kTrousers;
}

Region PersonShape::RegionAt(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double x = std::abs(p.x);
  const double neck_height = Joint(J::kNeck).y;
  const bool high = p.y > neck_height;
  const double head = high ? std::min(Head(p), Neck(p) + 0.004) : 1e9;
  if (high && head_.Hair(p) < head) return Region::kHair;
  const double trunk = Trunk(p);
  const double arm = Arm(p);
  const double length = TrunkLength();
  if (p.y < HipHeight() + 0.06 * length) return LegRegion(p, arm, trunk, Leg(p));

  const double cuff = CuffReach();
  const double trim = TrimWidth();
  if (x > cuff) return Region::kSkin;
  if (x > cuff - trim) return Region::kTrim;
  if (high && head < trunk && p.y > ChinHeight() - 0.3 * m.head_height) {
    return head_.FaceRegion(p);
  }
  // The collar: a tilted ring around the neck.
  const double from_neck = Neck(p);
  const double rim = neck_height - 0.015 * length - 0.30 * (p.z - Joint(J::kNeck).z);
  const double outside = SmoothIntersection(from_neck - 0.035 * length, rim - p.y, 0.10 * length);
  if (outside < 0.0) return Region::kSkin;
  if (outside < trim) return Region::kTrim;
  return Region::kShirt;
}

double PersonShape::LongestEdge(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double body = 0.027 * m.height;
  const Vec3 q{std::abs(p.x), p.y, p.z};
  // Where trim runs round the neck.
  if (q.y > Joint(J::kNeck).y - 0.2 * TrunkLength() && Neck(p) < 0.05 * TrunkLength()) {
    return 1.4 * TrimWidth();
  }
  const Vec3 from_wrist = (q - Joint(J::kLeftHand)) / m.hand_length;
  if (from_wrist.x > 0.0) return hand::LongestEdge(from_wrist) * m.hand_length;
  if (q.y > ChinHeight() - 0.02 * m.head_height && q.x < m.head_width) {
    return head_.LongestEdge(p);
  }
  if (q.y < 1.6 * m.ankle_height) return 0.092 * m.foot_length;
  return body;
}

}  // namespace ego
