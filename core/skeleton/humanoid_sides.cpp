// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "core/skeleton/humanoid_search.h"

namespace ego {
namespace {

using J = HumanoidJoint;

std::size_t At(int joint) { return static_cast<std::size_t>(joint); }

Vec3 UnitOrZero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0);
}

/// The joint below `top` (itself included; all joints of the file, also end sites) farthest from
/// it. -1 when nothing is farther than `least`.
int FarthestBelow(const HumanoidSearch& s, int top, double least) {
  std::vector<bool> below(s.tree.joints.size(), false);
  below[At(top)] = true;
  int best = -1;
  double best_distance = least;
  for (std::size_t i = At(top) + 1; i < s.tree.joints.size(); ++i) {
    const int parent = s.tree.joints[i].parent;
    if (parent < 0 || !below[At(parent)]) continue;
    below[i] = s.body.vote[i].role != NameRole::kIgnored;
    const double distance = glm::length(s.body.position[i] - s.body.At(top));
    if (below[i] && distance > best_distance) {
      best = static_cast<int>(i);
      best_distance = distance;
    }
  }
  return best;
}

/// Joints of one finger from its first joint outwards.
std::vector<int> Finger(const HumanoidSearch& s, int first) {
  std::vector<int> chain{first};
  while (s.body.Children(chain.back()).size() == 1) {
    chain.push_back(s.body.Children(chain.back())[0]);
  }
  return chain;
}

struct HandRoots {
  int index = -1;
  int little = -1;
  int thumb = -1;
  int ring = -1;  // any other finger, farthest from the index
};

HandRoots RootsByName(const HumanoidSearch& s, int hand) {
  HandRoots roots;
  double farthest = -1.0;
  std::vector<int> queue = s.body.Children(hand);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const int j = queue[i];
    const NameRole role = s.body.Vote(j).role;
    if (role == NameRole::kThumb && roots.thumb < 0) roots.thumb = j;
    if (role == NameRole::kIndex && roots.index < 0) roots.index = j;
    if (role == NameRole::kLittle && roots.little < 0) roots.little = j;
    for (const int child : s.body.Children(j)) queue.push_back(child);
  }
  if (roots.index >= 0 && roots.little < 0) {
    for (const int j : queue) {
      if (s.body.Vote(j).role != NameRole::kFinger || s.body.IsAncestor(j, roots.index)) continue;
      const double distance = glm::length(s.body.At(j) - s.body.At(roots.index));
      if (distance > farthest) {
        roots.ring = j;
        farthest = distance;
      }
    }
    roots.little = roots.ring;
  }
  return roots;
}

/// Four or five unnamed branches: the thumb starts nearest to the wrist and points away from the
/// others.
HandRoots RootsByShape(const HumanoidSearch& s, int hand) {
  HandRoots roots;
  const std::vector<int>& fingers = s.body.Children(hand);
  if (fingers.size() < 4 || fingers.size() > 6) return roots;
  Vec3 mean(0.0);
  for (const int f : fingers) mean += UnitOrZero(s.body.At(f) - s.body.At(hand));
  mean = UnitOrZero(mean);
  double least = 2.0;
  for (const int f : fingers) {
    const double aligned = glm::dot(UnitOrZero(s.body.At(f) - s.body.At(hand)), mean);
    if (aligned < least) {
      least = aligned;
      roots.thumb = f;
    }
  }
  double nearest = 1e300;
  double farthest = -1.0;
  for (const int f : fingers) {
    if (f == roots.thumb) continue;
    const double distance = glm::length(s.body.At(f) - s.body.At(roots.thumb));
    if (distance < nearest) {
      nearest = distance;
      roots.index = f;
    }
    if (distance > farthest) {
      farthest = distance;
      roots.little = f;
    }
  }
  return roots;
}

/// How clearly the rest pose shows that the body's front is `forward`: toes, knees, elbows and
/// thumbs. Toes alone can say at most 1.2, everything together 2.5.
double FrontEvidence(const HumanoidSearch& s, const Vec3& forward) {
  const double leg = glm::length(s.At(J::kLeftLowerLeg) - s.At(J::kLeftUpperLeg));
  if (!(leg > 0.0)) return 0.0;
  double evidence = 0.0;
  const auto vote = [&](const Vec3& offset, double full, double weight) {
    evidence += weight * std::clamp(glm::dot(offset, forward) / (full * leg), -1.0, 1.0);
  };
  for (const Limb limb : kLimbs) {
    const std::size_t side = IsLeft(limb) ? 0 : 1;
    const LimbJoints joints = JointsOf(limb);
    if (s.Node(joints.end) < 0) continue;
    const Vec3 end = s.At(joints.end);
    const Vec3 line = end - s.At(joints.base);
    const Vec3 to_mid = s.At(joints.mid) - s.At(joints.base);
    const double square = glm::dot(line, line);
    const Vec3 bend = square > 0.0 ? to_mid - line * (glm::dot(to_mid, line) / square) : Vec3(0.0);
    vote(IsArm(limb) ? -bend : bend, 0.1, IsArm(limb) ? 0.15 : 0.25);
    if (IsArm(limb)) {
      if (s.map.thumb_base[side] >= 0) vote(s.body.At(s.map.thumb_base[side]) - end, 0.05, 0.25);
    } else {
      const int toes = s.Node(side == 0 ? J::kLeftToes : J::kRightToes);
      const int tip = s.map.toe_tip[side] >= 0 ? s.map.toe_tip[side] : toes;
      if (tip >= 0) vote(s.body.At(tip) - end, 0.15, 0.6);
    }
  }
  return evidence;
}

void SwapSides(HumanoidSearch& s) {
  for (const J j : {J::kLeftShoulder, J::kLeftUpperArm, J::kLeftLowerArm, J::kLeftHand,
                    J::kLeftUpperLeg, J::kLeftLowerLeg, J::kLeftFoot, J::kLeftToes}) {
    std::swap(s.map.joint[Index(j)], s.map.joint[Index(Mirror(j))]);
  }
  for (auto* pair : {&s.map.fingertip, &s.map.toe_tip, &s.map.index_base, &s.map.little_base,
                     &s.map.thumb_base}) {
    std::swap((*pair)[0], (*pair)[1]);
  }
}

}  // namespace

void FindTips(HumanoidSearch& s) {
  for (std::size_t side = 0; side < 2; ++side) {
    const int forearm = s.Node(side == 0 ? J::kLeftLowerArm : J::kRightLowerArm);
    int hand = s.Node(side == 0 ? J::kLeftHand : J::kRightHand);
    if (hand < 0) hand = forearm;
    HandRoots roots = RootsByName(s, hand);
    if (roots.index < 0 && roots.thumb < 0) roots = RootsByShape(s, hand);
    const double forearm_length =
        glm::length(s.body.At(forearm) - s.At(side == 0 ? J::kLeftUpperArm : J::kRightUpperArm));
    s.map.fingertip[side] = FarthestBelow(s, hand, 0.05 * forearm_length);
    s.map.thumb_base[side] = roots.thumb;
    // Knuckles that lie in one point say nothing: take the first joints that are apart.
    if (roots.index >= 0 && roots.little >= 0) {
      const std::vector<int> index = Finger(s, roots.index);
      const std::vector<int> little = Finger(s, roots.little);
      for (std::size_t k = std::min(index.size(), little.size()); k-- > 0;) {
        if (k == 0 || glm::length(s.body.At(index[k - 1]) - s.body.At(little[k - 1])) <
                          0.03 * forearm_length) {
          s.map.index_base[side] = index[k];
          s.map.little_base[side] = little[k];
          break;
        }
      }
    }
    if (s.map.thumb_base[side] >= 0) {
      for (const int joint : Finger(s, roots.thumb)) {
        s.map.thumb_base[side] = joint;
        if (glm::length(s.body.At(joint) - s.body.At(hand)) > 0.1 * forearm_length) break;
      }
    }
    const int foot = s.Node(side == 0 ? J::kLeftFoot : J::kRightFoot);
    const int toes = s.Node(side == 0 ? J::kLeftToes : J::kRightToes);
    const int from = toes >= 0 ? toes : foot;
    if (from >= 0) s.map.toe_tip[side] = FarthestBelow(s, from, 1e-3 * forearm_length);
  }
}

void SettleSides(HumanoidSearch& s, bool limbs_named) {
  if (s.Declared(J::kLeftUpperArm) || s.Declared(J::kLeftUpperLeg)) return;
  const Vec3 hips = 0.5 * (s.At(J::kLeftUpperLeg) + s.At(J::kRightUpperLeg));
  const Vec3 shoulders = 0.5 * (s.At(J::kLeftUpperArm) + s.At(J::kRightUpperArm));
  const Vec3 up = UnitOrZero(shoulders - hips);
  const Vec3 left = UnitOrZero(s.At(J::kLeftUpperLeg) - s.At(J::kRightUpperLeg)) +
                    UnitOrZero(s.At(J::kLeftUpperArm) - s.At(J::kRightUpperArm));
  const Vec3 forward = UnitOrZero(glm::cross(left, up));
  const double evidence = FrontEvidence(s, forward);
  if (limbs_named) {
    // Names are wrong only if more than the toes says so.
    if (evidence < -1.4) {
      SwapSides(s);
      s.map.notes.push_back(
          "left and right are exchanged against the joint names: feet and hands look the other "
          "way");
    }
    return;
  }
  if (std::abs(evidence) > 0.05) {
    if (evidence < 0.0) SwapSides(s);
    return;
  }
  // Nothing shows the front: files look along +Z (or, lying with Z up, along -Y).
  const Vec3 assumed = std::abs(up.z) > 0.7 ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  if (glm::dot(forward, assumed) < 0.0) SwapSides(s);
  s.map.notes.push_back("nothing in the rest pose shows the front of the body: +Z is assumed");
}

}  // namespace ego
