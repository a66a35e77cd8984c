// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "core/base/math.h"

namespace ego {

/// A hand in hand lengths (wrist joint to the tip of the middle finger) from the wrist joint, palm
/// down: x along the fingers, z towards the thumb. A right hand is its mirror image in x.
namespace hand {

inline constexpr std::size_t kFingerCount = 5;
inline constexpr std::size_t kJointsPerFinger = 3;
/// Of one hand: thumb, index, middle, ring, little; three each, from the palm outward.
inline constexpr std::size_t kFingerJointCount = kFingerCount * kJointsPerFinger;

struct Finger {
  const char* name;                                      // "Thumb", ...
  std::array<const char*, kJointsPerFinger> joint_name;  // VRM 1.0: "Metacarpal", "Proximal", ...
  std::array<Vec3, kJointsPerFinger + 1> point;  // the joints, then the middle of the tip's ball
  std::array<double, kJointsPerFinger + 1> radius;
};
/// The knuckles of index and little finger lie as far before as behind the middle line: the hand
/// that they span points straight out.
const std::array<Finger, kFingerCount>& Fingers();

/// VRM 1.0 name of a finger joint, "leftIndexProximal".
std::string FingerJointName(bool left, std::size_t joint);

/// Approximate signed distance to the skin of the hand, hand lengths. `leaner`: by how much fingers
/// are thinner than they are, so that a coarse lattice can tell them apart.
double Distance(const Vec3& q, double leaner = 0.0);

/// How long an edge of the mesh may be there, so that finger tips are round, hand lengths.
double LongestEdge(const Vec3& q);

/// How much of a point of the hand each finger joint carries; what is left is the hand joint's.
std::array<double, kFingerJointCount> FingerShares(const Vec3& q);

}  // namespace hand
}  // namespace ego
