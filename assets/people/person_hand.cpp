// SPDX-License-Identifier: MIT
#include "assets/people/person_hand.h"

#include <algorithm>
#include <cmath>

#include "assets/people/field.h"

namespace ego::hand {
namespace {

using field::Capsule;
using field::Ellipsoid;
using field::SmoothStep;
using field::SmoothUnion;

constexpr std::array<const char*, kJointsPerFinger> kThumbJoints = {"Metacarpal", "Proximal",
                                                                    "Distal"};
constexpr std::array<const char*, kJointsPerFinger> kFingerJoints = {"Proximal", "Intermediate",
                                                                     "Distal"};

/// A finger that bends a little and spreads a little.
Finger Long(const char* name, double x, double z, double length, double spread, double radius) {
  const auto at = [&](double share, double y) {
    return Vec3{x + share * length, y, z + share * spread};
  };
  const double tip = 1.0 - 0.042 / length;
  return {name,
          kFingerJoints,
          {at(0.0, 0.0), at(0.43, -0.002), at(0.72, -0.020), at(tip, -0.045)},
          {radius + 0.004, 1.02 * radius, 0.95 * radius, 0.82 * radius}};
}

/// Distance to the polyline through the joints, and where on it the nearest point lies: the number
/// of the bone plus the share of it, below zero before the first joint.
struct OnFinger {
  double distance;
  double at;
};

OnFinger Nearest(const Finger& f, const Vec3& q, double root) {
  OnFinger nearest{1e9, 0.0};
  for (std::size_t k = 0; k + 1 < f.point.size(); ++k) {
    const Vec3 bone = f.point[k + 1] - f.point[k];
    const double low = k == 0 ? -root / glm::length(bone) : 0.0;
    const double t = std::clamp(glm::dot(q - f.point[k], bone) / glm::dot(bone, bone), low, 1.0);
    const double distance = glm::distance(q, f.point[k] + t * bone);
    if (distance < nearest.distance) nearest = {distance, static_cast<double>(k) + t};
  }
  return nearest;
}

/// One tube about the bones whose radius is smooth all along: a little slimmer between the joints.
/// Fingers reach into the palm, so that their roots are smooth. `leaner` holds for the root, where
/// fingers lie closest, and a quarter of it for the tip.
double FingerDistance(const Finger& f, const field::Profile& radius, const Vec3& q, double leaner) {
  const OnFinger nearest = Nearest(f, q, f.joint_name == kFingerJoints ? 0.14 : 0.0);
  return nearest.distance - radius(nearest.at) + leaner * (1.0 - 0.25 * nearest.at);
}

field::Profile RadiusOf(const Finger& f) {
  const auto between = [&](std::size_t k, double slim) {
    return slim * 0.5 * (f.radius[k] + f.radius[k + 1]);
  };
  return field::Profile({{0.0, f.radius[0]},
                         {0.5, between(0, 0.97)},
                         {1.0, f.radius[1]},
                         {1.5, between(1, 0.96)},
                         {2.0, f.radius[2]},
                         {2.5, between(2, 1.0)},
                         {3.0, f.radius[3]}});
}

const std::array<field::Profile, kFingerCount>& Radii() {
  static const std::array<field::Profile, kFingerCount> kRadii = [] {
    std::array<field::Profile, kFingerCount> radii;
    for (std::size_t f = 0; f < kFingerCount; ++f) radii[f] = RadiusOf(Fingers()[f]);
    return radii;
  }();
  return kRadii;
}

}  // namespace

const std::array<Finger, kFingerCount>& Fingers() {
  static const std::array<Finger, kFingerCount> kFingers = {
      Finger{"Thumb",
             kThumbJoints,
             {Vec3{0.09, -0.022, 0.105}, Vec3{0.285, -0.040, 0.255}, Vec3{0.405, -0.048, 0.318},
              Vec3{0.500, -0.056, 0.345}},
             {0.078, 0.060, 0.054, 0.044}},
      Long("Index", 0.50, 0.168, 0.43, 0.058, 0.044),
      Long("Middle", 0.53, 0.055, 0.47, 0.014, 0.045),
      Long("Ring", 0.51, -0.058, 0.44, -0.030, 0.043),
      Long("Little", 0.47, -0.168, 0.35, -0.075, 0.038)};
  return kFingers;
}

std::string FingerJointName(bool left, std::size_t joint) {
  const Finger& finger = Fingers()[joint / kJointsPerFinger];
  return std::string(left ? "left" : "right") + finger.name +
         finger.joint_name[joint % kJointsPerFinger];
}

double Distance(const Vec3& q, double leaner) {
  // The palm widens from the wrist to the knuckles, arches over its back and is hollow below.
  const double widen = 1.0 / (0.70 + 0.57 * std::clamp(q.x, 0.0, 0.5));
  const double arch = 0.30 * q.z * q.z;
  double d = field::RoundBox({q.x, q.y + arch, q.z * widen}, {0.27, 0.004, 0.0},
                             {0.27, 0.076, 0.215}, 0.074);
  d = SmoothUnion(d, Ellipsoid(q, {0.20, -0.030, 0.125}, {0.17, 0.064, 0.090}), 0.05);   // thumb's
  d = SmoothUnion(d, Ellipsoid(q, {0.19, -0.022, -0.115}, {0.18, 0.064, 0.075}), 0.05);  // little's
  double fingers = 1e9;
  for (std::size_t f = 1; f < kFingerCount; ++f) {
    const Finger& finger = Fingers()[f];
    fingers = SmoothUnion(fingers, FingerDistance(finger, Radii()[f], q, leaner), 0.02);
    // Knuckles on the back.
    const double back = 0.034 - 0.30 * finger.point[0].z * finger.point[0].z;
    d = SmoothUnion(d, glm::length(q - finger.point[0] - Vec3{-0.01, back, 0.0}) - 0.044, 0.03);
  }
  d = SmoothUnion(d, fingers, 0.04);
  return SmoothUnion(d, FingerDistance(Fingers()[0], Radii()[0], q, 0.0), 0.05);
}

double LongestEdge(const Vec3& q) {
  for (const Finger& finger : Fingers()) {
    const Vec3 on = glm::normalize(finger.point[3] - finger.point[2]);
    const double past = glm::dot(q - finger.point[3], on) / finger.radius[3];
    if (past > -0.4 && glm::distance(q, finger.point[3]) < 1.6 * finger.radius[3]) return 0.026;
  }
  return 0.08;
}

std::array<double, kFingerJointCount> FingerShares(const Vec3& q) {
  std::array<double, kFingerCount> from{};
  double nearest = 1e9;
  for (std::size_t f = 0; f < kFingerCount; ++f) {
    const Finger& finger = Fingers()[f];
    double d = 1e9;
    for (std::size_t k = 0; k + 1 < finger.point.size(); ++k) {
      d = std::min(d, Capsule(q, finger.point[k], finger.point[k + 1], finger.radius[k],
                              finger.radius[k + 1]));
    }
    from[f] = d;
    nearest = std::min(nearest, d);
  }
  // Between two fingers both take part: no crease tears the web.
  double sum = 0.0;
  for (double& d : from) {
    d = std::exp(-(d - nearest) / 0.012);
    sum += d;
  }
  std::array<double, kFingerJointCount> shares{};
  for (std::size_t f = 0; f < kFingerCount; ++f) {
    const Finger& finger = Fingers()[f];
    double passed = from[f] / sum;
    for (std::size_t k = 0; k < kJointsPerFinger; ++k) {
      // Past the joint along the mean direction of the bones that meet there.
      const Vec3 on = glm::normalize(finger.point[k + 1] - finger.point[k]);
      const Vec3 before = k == 0 ? on : glm::normalize(finger.point[k] - finger.point[k - 1]);
      const double along = glm::dot(q - finger.point[k], glm::normalize(on + before));
      const double band = f == 0 && k == 0 ? 0.09 : 0.85 * finger.radius[k];
      const double share = passed * SmoothStep(-band, band, along);
      if (k > 0) shares[f * kJointsPerFinger + k - 1] -= share;
      shares[f * kJointsPerFinger + k] += share;
      passed = share;
    }
  }
  return shares;
}

}  // namespace ego::hand
