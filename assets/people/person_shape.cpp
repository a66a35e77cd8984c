// SPDX-License-Identifier: MIT
#include "assets/people/person_shape.h"

#include <algorithm>
#include <cmath>

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
  head_z_ = Joint(J::kHead).z + 0.09 * m.head_depth;
  crown_ = m.height - (m.hair == Hair::kNone ? 0.0 : 0.05 * m.head_height);

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

double PersonShape::Arm(const Vec3& p) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  const Vec3& wrist = Joint(J::kLeftHand);
  const Vec3& elbow = Joint(J::kLeftLowerArm);
  const double upper = Segment(q, Joint(J::kLeftUpperArm), elbow, upper_arm_, Vec3(0.0));
  const double lower = Segment(q, elbow, wrist, lower_arm_, Vec3(0.0));
  double d = SmoothUnion(upper, lower, 0.5 * parameters_.lower_arm_radius);
  const double reach = parameters_.hand_length;
  // Far from the hand its many small parts cannot matter.
  const double far = glm::length(q - wrist - Vec3{0.5 * reach, 0.0, 0.0}) - 0.75 * reach;
  const double k = 0.10 * reach;
  return far > d + k && far > 0.0 ? d : SmoothUnion(d, Hand(q), k);
}

double PersonShape::Hand(const Vec3& p) const {
  const double length = parameters_.hand_length;
  const Vec3 q = (p - Joint(J::kLeftHand)) / length;  // in hand lengths
  // The palm widens from the wrist to the knuckles.
  const double widen = 1.0 / (0.72 + 0.55 * std::clamp(q.x, 0.0, 0.5));
  double d =
      field::RoundBox({q.x, q.y, q.z * widen}, {0.27, 0.0, 0.0}, {0.27, 0.078, 0.215}, 0.075);
  d = SmoothUnion(d, Ellipsoid(q, {0.17, -0.02, 0.13}, {0.17, 0.062, 0.10}), 0.06);  // thumb's ball

  struct Finger {
    double knuckle_x, knuckle_z, length, spread;
  };
  constexpr std::array<Finger, 4> kFingers = {{{0.50, 0.165, 0.43, 0.045},
                                               {0.53, 0.055, 0.47, 0.012},
                                               {0.51, -0.055, 0.44, -0.022},
                                               {0.47, -0.160, 0.35, -0.055}}};
  double fingers = 1e9;
  for (const Finger& f : kFingers) {
    const double r = 0.047;
    const Vec3 a{f.knuckle_x - 0.06, 0.0, f.knuckle_z};
    const Vec3 b{f.knuckle_x + 0.45 * f.length, -0.012, f.knuckle_z + 0.5 * f.spread};
    const Vec3 c{f.knuckle_x + f.length - 0.042, -0.045, f.knuckle_z + f.spread};
    const double finger =
        SmoothUnion(Capsule(q, a, b, r + 0.004, r), Capsule(q, b, c, r, 0.041), 0.01);
    fingers = std::min(fingers, finger);
  }
  d = SmoothUnion(d, fingers, 0.03);
  const double thumb =
      SmoothUnion(Capsule(q, {0.12, -0.02, 0.12}, {0.32, -0.035, 0.29}, 0.075, 0.056),
                  Capsule(q, {0.32, -0.035, 0.29}, {0.50, -0.05, 0.345}, 0.056, 0.046), 0.02);
  d = SmoothUnion(d, thumb, 0.05);
  return d * length;
}

double PersonShape::Leg(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const Vec3 q{std::abs(p.x), p.y, p.z};
  const Vec3& knee = Joint(J::kLeftLowerLeg);
  const Vec3& ankle = Joint(J::kLeftFoot);
  const double upper =
      Segment(q, Joint(J::kLeftUpperLeg), knee, upper_leg_, {0.0, 0.0, 0.08 * m.upper_leg_radius});
  const double lower = Segment(q, knee, ankle, lower_leg_, {0.0, 0.0, -0.16 * m.lower_leg_radius});
  const double d = SmoothUnion(upper, lower, 0.4 * m.lower_leg_radius);
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

double PersonShape::Head(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const double chin = ChinHeight();
  const Vec3 q{std::abs(p.x), p.y - chin, p.z - head_z_};
  const double top = crown_ - chin;
  const double skull = 0.41 * h;
  double d = Ellipsoid(q, {0.0, top - skull, -0.04 * l}, {w, skull, 0.96 * l});
  d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.32 * h, 0.30 * l}, {0.76 * w, 0.30 * h, 0.60 * l}),
                  0.16 * h);
  d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.10 * h, 0.66 * l}, {0.30 * w, 0.09 * h, 0.20 * l}),
                  0.10 * h);  // chin
  d = SmoothUnion(d, Ellipsoid(q, {0.50 * w, 0.37 * h, 0.52 * l}, {0.28 * w, 0.12 * h, 0.27 * l}),
                  0.10 * h);  // cheek
  const double socket =
      Ellipsoid(q, {0.42 * w, 0.495 * h, 1.02 * l}, {0.30 * w, 0.075 * h * m.eye_size, 0.20 * l});
  d = SmoothIntersection(d, -socket, 0.05 * h);
  d = SmoothUnion(d,
                  Capsule(q, {0.0, 0.50 * h, 0.90 * l}, {0.0, 0.385 * h, 1.03 * l},
                          0.035 * h * m.nose_size, 0.052 * h * m.nose_size),
                  0.045 * h);
  const double e = m.ear_size;
  const double ear = Ellipsoid(q, {w + 0.015 * h * e, (0.36 + 0.10 * e) * h, -0.10 * l},
                               {0.045 * h * e, 0.14 * h * e, 0.15 * l * e});
  d = SmoothUnion(d, ear, 0.03 * h);
  return d;
}

double PersonShape::Neck(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const Vec3& neck = Joint(J::kNeck);
  return Capsule(p, {0.0, neck.y - 0.6 * m.neck_radius, neck.z},
                 {0.0, ChinHeight() + 0.30 * m.head_height, head_z_ - 0.16 * m.head_depth},
                 1.06 * m.neck_radius, 0.96 * m.neck_radius);
}

double PersonShape::Hair(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  if (m.hair == Hair::kNone) return 1e9;
  const double h = m.head_height;
  const double w = m.head_width / 2.0;
  const double l = m.head_depth / 2.0;
  const Vec3 q{std::abs(p.x), p.y - ChinHeight(), p.z - head_z_};
  const double top = m.height - ChinHeight();
  const double half = 0.43 * h;
  const Vec3 cap_centre{0.0, top - half, -0.07 * l};
  double d = Ellipsoid(q, cap_centre, {1.07 * w, half, 1.03 * l});
  // The hairline: a tilted plane from the forehead to the nape, raised around the ears.
  const double front = m.hair == Hair::kBob ? 0.70 : 0.735;
  const double nape = m.hair == Hair::kBob ? 0.02 : 0.24;
  const double along = SmoothStep(-0.75, 0.95, q.z / l);
  double line = (nape + (front - nape) * along) * h;
  if (m.hair == Hair::kBob) {
    d = SmoothUnion(
        d, Ellipsoid(q, {0.50 * w, 0.36 * h, -0.30 * l}, {0.66 * w, 0.38 * h, 0.74 * l}), 0.10 * h);
    line = 0.04 * h + (front - 0.04) * h * SmoothStep(0.15, 0.62, q.z / l - 0.25 * q.x / w + 0.1);
  }
  d = SmoothIntersection(d, 0.9 * (line - q.y), 0.03 * h);
  if (m.hair == Hair::kShort) {
    const Vec3 tuft{0.0, top - 0.125 * h, 0.50 * l};
    d = SmoothUnion(d, Ellipsoid(q, tuft, {0.74 * w, 0.115 * h, 0.56 * l}), 0.05 * h);
  }
  if (m.hair == Hair::kBun) {
    d = SmoothUnion(d, Ellipsoid(q, {0.0, 0.70 * h, -1.12 * l}, Vec3(0.17 * h)), 0.03 * h);
  }
  return d;
}

double PersonShape::operator()(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double length = TrunkLength();
  double d = Trunk(p);
  d = SmoothUnion(d, Arm(p), 0.9 * m.upper_arm_radius);
  // What is farther away than its seam is wide has no effect and is left out.
  if (p.y < HipHeight() + 0.25 * length) d = SmoothUnion(d, Leg(p), 0.5 * m.upper_leg_radius);
  if (p.y > Joint(J::kNeck).y - 0.3 * length) {
    d = SmoothUnion(d, Neck(p), 0.10 * length);
    d = SmoothUnion(d, Head(p), 0.10 * m.head_height);
    d = SmoothUnion(d, Hair(p), 0.012 * m.head_height);
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

Region PersonShape::RegionAt(const Vec3& p) const {
  const PersonParameters& m = parameters_;
  const double x = std::abs(p.x);
  const double head = std::min(Head(p), Neck(p) + 0.004);
  if (Hair(p) < head && p.y > Joint(J::kNeck).y) return Region::kHair;
  const double trunk = Trunk(p);
  const double arm = Arm(p);
  const double leg = Leg(p);
  const double length = TrunkLength();

  if (p.y < HipHeight() + 0.06 * length) {
    if (arm < std::min(trunk, leg)) return Region::kSkin;
    const Vec3& ankle = Joint(J::kLeftFoot);
    const Vec3& knee = Joint(J::kLeftLowerLeg);
    const double shoe_top =
        ankle.y + 0.10 * m.foot_length * (1.0 - 0.9 * (p.z - ankle.z) / m.foot_length);
    if (p.y < shoe_top) return Region::kShoes;
    const double hem = m.trouser_end < 1.0 ? glm::mix(HipHeight(), knee.y, m.trouser_end)
                                           : glm::mix(knee.y, ankle.y, m.trouser_end - 1.0);
    return p.y < hem ? Region::kSkin : Region::kTrousers;
  }
  const Vec3& shoulder = Joint(J::kLeftUpperArm);
  const Vec3& elbow = Joint(J::kLeftLowerArm);
  const Vec3& wrist = Joint(J::kLeftHand);
  const double cuff = m.sleeve_end < 1.0 ? glm::mix(shoulder.x, elbow.x, m.sleeve_end)
                                         : glm::mix(elbow.x, wrist.x, m.sleeve_end - 1.0);
  if (x > cuff) return Region::kSkin;
  if (std::min(head, Head(p)) < trunk && p.y > Joint(J::kNeck).y) return Region::kSkin;
  // The collar: a tilted ring around the neck.
  const double collar =
      Joint(J::kNeck).y - 0.035 * length - 0.30 * (p.z - Joint(J::kNeck).z) + 0.02 * length;
  const double from_neck = Neck(p);
  if (p.y > collar && from_neck < 0.035 * length) return Region::kSkin;
  return Region::kShirt;
}

}  // namespace ego
