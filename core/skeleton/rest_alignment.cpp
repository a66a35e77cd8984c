// SPDX-License-Identifier: MIT
#include "core/skeleton/rest_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "core/base/check.h"

namespace ego {
namespace {

using J = HumanoidJoint;

std::size_t At(int node) { return static_cast<std::size_t>(node); }

double Smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Vec3 UnitOrZero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0);
}

double Angle(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Shortest rotation from a's direction to unit b; identity for a zero vector, about `fallback`
/// (perpendicular to b) when they are opposite.
Quat ShortestRotation(const Vec3& a, const Vec3& b, const Vec3& fallback) {
  const Vec3 from = UnitOrZero(a);
  if (from == Vec3(0.0)) return kIdentity;
  const double cosine = glm::dot(from, b);
  if (cosine < -1.0 + 1e-9) return glm::angleAxis(kPi, fallback);
  const Vec3 axis = glm::cross(from, b);
  return glm::normalize(Quat(1.0 + cosine, axis.x, axis.y, axis.z));
}

/// Signed angle about unit `axis` from a to b, both seen along the axis; 0 when one lies on it.
double AngleAbout(const Vec3& axis, const Vec3& a, const Vec3& b) {
  return std::atan2(glm::dot(glm::cross(a, b), axis),
                    glm::dot(a, b) - glm::dot(a, axis) * glm::dot(b, axis));
}

/// A rest pose in stage axes and metres, and the rotations being found.
struct Work {
  const JointTree& tree;
  const HumanoidMap& map;
  std::array<Vec3, kJointCount> rest;  // q_j
  std::array<Quat, kJointCount> turn;  // K_j
  std::vector<Vec3> node;              // every node, stage

  Vec3& Rest(J j) { return rest[Index(j)]; }
  Quat& Turn(J j) { return turn[Index(j)]; }
  bool Has(J j) const { return map.Node(j) >= 0; }
  Vec3 NodeAt(int n) const { return node[At(n)]; }
};

/// The farthest node below `top` and the first node on the way to it; -1 for a leaf.
std::pair<int, int> FarthestBelow(const Work& w, int top) {
  std::vector<int> first(w.tree.joints.size(), -1);
  std::pair<int, int> best{-1, -1};
  double best_distance = -1.0;
  for (std::size_t i = At(top) + 1; i < first.size(); ++i) {
    const int parent = w.tree.joints[i].parent;
    if (parent < 0) continue;
    first[i] = parent == top ? static_cast<int>(i) : first[At(parent)];
    const double distance = glm::length(w.node[i] - w.NodeAt(top));
    if (first[i] >= 0 && distance > best_distance) {
      best = {static_cast<int>(i), first[i]};
      best_distance = distance;
    }
  }
  return best;
}

/// Where a missing hand or foot sits: where the branches below the forearm (shin) begin, else as
/// far from the elbow (knee) as that is from the shoulder (hip).
Vec3 MissingEnd(const Work& w, Limb limb) {
  const LimbJoints joints = JointsOf(limb);
  const int mid = w.map.Node(joints.mid);
  const Vec3 upper = w.rest[Index(joints.mid)] - w.rest[Index(joints.base)];
  const int begin = FarthestBelow(w, mid).second;
  if (begin >= 0) {
    const Vec3 end = w.NodeAt(begin);
    const double length = glm::length(end - w.rest[Index(joints.mid)]);
    if (length > 0.2 * glm::length(upper) && length < 4.0 * glm::length(upper)) return end;
  }
  return w.rest[Index(joints.mid)] + 0.9 * upper;
}

void PlaceJoints(Work& w) {
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const int n = w.map.joint[j].node;
    if (n >= 0) w.rest[j] = w.NodeAt(n);
  }
  for (const J j : {J::kSpine, J::kChest, J::kUpperChest}) {
    if (!w.Has(j)) w.Rest(j) = w.Rest(Parent(j));
  }
  if (!w.Has(J::kNeck)) w.Rest(J::kNeck) = w.Rest(J::kHead);
  if (!w.Has(J::kLeftShoulder)) w.Rest(J::kLeftShoulder) = w.Rest(J::kLeftUpperArm);
  if (!w.Has(J::kRightShoulder)) w.Rest(J::kRightShoulder) = w.Rest(J::kRightUpperArm);
  for (const Limb limb : kLimbs) {
    const J end = JointsOf(limb).end;
    if (!w.Has(end)) w.Rest(end) = MissingEnd(w, limb);
  }
  for (const J j : {J::kLeftToes, J::kRightToes}) {
    if (!w.Has(j)) w.Rest(j) = w.Rest(Parent(j));
  }
}

/// Rotation about the limb that brings the bend of the mid joint onto its canonical hinge. Counts
/// little where the limb is nearly straight and not at all where it bends the wrong way.
double HingeTwist(const Vec3& lower, const Vec3& direction, const Vec3& bend_to, double none,
                  double full) {
  if (lower == Vec3(0.0)) return 0.0;
  const double twist = AngleAbout(direction, lower, bend_to);
  return twist * Smooth(none, full, Angle(lower, direction)) *
         (1.0 - Smooth(Radians(100.0), Radians(170.0), std::abs(twist)));
}

void AlignArm(Work& w, Limb limb) {
  const LimbJoints joints = JointsOf(limb);
  const std::size_t side = IsLeft(limb) ? 0 : 1;
  const Vec3 along = CanonicalDirection(limb);
  const Vec3 front(0.0, 0.0, 1.0);
  const Vec3 upper = w.Rest(joints.mid) - w.Rest(joints.base);
  const Vec3 lower = w.Rest(joints.end) - w.Rest(joints.mid);

  Quat base = ShortestRotation(upper, along, front);
  base =
      glm::angleAxis(HingeTwist(base * lower, along, front, Radians(8.0), Radians(25.0)), along) *
      base;
  Quat mid = ShortestRotation(base * lower, along, front) * base;

  // The hand: knuckles say where it points and how the palm lies; a fingertip or a thumb alone
  // says less.
  const int index = w.map.index_base[side];
  const int little = w.map.little_base[side];
  const int thumb = w.map.thumb_base[side];
  const int tip = w.map.fingertip[side];
  const Vec3 wrist = w.Rest(joints.end);
  Quat end = mid;
  if (w.Has(joints.end)) {
    const bool knuckles = index >= 0 && little >= 0;
    if (knuckles || tip >= 0) {
      const Vec3 toward = knuckles ? 0.5 * (w.NodeAt(index) + w.NodeAt(little)) : w.NodeAt(tip);
      const Vec3 hand = mid * (toward - wrist);
      const double angle = Angle(hand, along);
      const double trust = 1.0 - (knuckles ? Smooth(Radians(60.0), Radians(90.0), angle)
                                           : Smooth(Radians(20.0), Radians(50.0), angle));
      end = glm::slerp(kIdentity, ShortestRotation(hand, along, front), trust) * mid;
    }
  }
  double twist = 0.0;
  if (index >= 0 && little >= 0) {
    const Vec3 across = end * (w.NodeAt(index) - w.NodeAt(little));
    const double seen = glm::length(across - along * glm::dot(across, along));
    const double full = std::max(1e-12, 0.1 * glm::length(lower));
    twist = AngleAbout(along, across, front) * Smooth(0.1, 0.6, seen / full);
  } else if (thumb >= 0) {
    const Vec3 out = end * (w.NodeAt(thumb) - wrist);
    const double angle = AngleAbout(along, out, Vec3(0.0, -0.35, 1.0));
    twist = std::copysign(std::max(0.0, std::abs(angle) - Radians(35.0)), angle);
  }
  end = glm::angleAxis(twist, along) * end;
  mid = glm::angleAxis(w.Has(joints.end) ? 0.5 * twist : twist, along) * mid;
  w.Turn(joints.base) = base;
  w.Turn(joints.mid) = mid;
  w.Turn(joints.end) = w.Has(joints.end) ? end : mid;
}

void AlignLeg(Work& w, Limb limb) {
  const LimbJoints joints = JointsOf(limb);
  const std::size_t side = IsLeft(limb) ? 0 : 1;
  const J toes = IsLeft(limb) ? J::kLeftToes : J::kRightToes;
  const Vec3 along = CanonicalDirection(limb);
  const Vec3 sideways(1.0, 0.0, 0.0);
  const Vec3 back(0.0, 0.0, -1.0);
  const Vec3 upper = w.Rest(joints.mid) - w.Rest(joints.base);
  const Vec3 lower = w.Rest(joints.end) - w.Rest(joints.mid);

  Quat base = ShortestRotation(upper, along, sideways);
  base =
      glm::angleAxis(HingeTwist(base * lower, along, back, Radians(10.0), Radians(30.0)), along) *
      base;
  const Quat mid = ShortestRotation(base * lower, along, sideways) * base;

  // A foot stands as it is, whatever the shin does, unless the leg is not a standing one.
  Quat end = mid;
  if (w.Has(joints.end)) {
    const double lifted = Angle(upper + lower, along);
    end = glm::slerp(kIdentity, mid, Smooth(Radians(35.0), Radians(70.0), lifted));
    const int tip = w.map.toe_tip[side];
    if (tip >= 0 || w.Has(toes)) {
      const Vec3 toward = end * ((w.Has(toes) ? w.Rest(toes) : w.NodeAt(tip)) - w.Rest(joints.end));
      const double flat = std::hypot(toward.x, toward.z);
      const double length = glm::length(toward);
      if (length > 0.0) {
        const double yaw = std::atan2(toward.x, toward.z) * Smooth(0.1, 0.35, flat / length);
        const double slope = std::atan2(-toward.y, flat);
        const double level = std::clamp(slope, Radians(-20.0), Radians(75.0)) - slope;
        end = glm::angleAxis(level, sideways) * glm::angleAxis(-yaw, kUp) * end;
      }
    }
  }
  w.Turn(joints.base) = base;
  w.Turn(joints.mid) = mid;
  w.Turn(joints.end) = end;
  w.Turn(toes) = end;
}

struct BodyFrame {
  Quat rotation = kIdentity;
  bool valid = false;
};

/// Stage axes from file positions of the mapped joints.
BodyFrame FindBodyFrame(const std::array<Vec3, kJointCount>& p) {
  const auto at = [&](J j) { return p[Index(j)]; };
  const auto between = [&](J a, J b) { return 0.5 * (at(a) + at(b)); };
  const Vec3 trunk = UnitOrZero(at(J::kHead) - at(J::kHips));
  const Vec3 legs = UnitOrZero(between(J::kLeftUpperLeg, J::kRightUpperLeg) -
                               between(J::kLeftFoot, J::kRightFoot));
  if (trunk == Vec3(0.0)) return {};
  Vec3 up = trunk;
  double best = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Vec3 candidate(0.0);
      candidate[axis] = sign;
      const double along_trunk = glm::dot(trunk, candidate);
      const double along_legs = glm::dot(legs, candidate);
      const bool upright = along_trunk > std::cos(Radians(30.0));
      const bool stands =
          along_legs > std::cos(Radians(30.0)) && along_trunk > std::cos(Radians(65.0));
      if ((upright || stands) && along_trunk + along_legs > best) {
        best = along_trunk + along_legs;
        up = candidate;
      }
    }
  }
  Vec3 left = UnitOrZero(at(J::kLeftUpperLeg) - at(J::kRightUpperLeg)) +
              UnitOrZero(at(J::kLeftUpperArm) - at(J::kRightUpperArm));
  left -= up * glm::dot(left, up);
  if (glm::length(left) < 1e-6) return {};
  left = glm::normalize(left);
  const Vec3 forward = glm::cross(left, up);
  return {glm::normalize(glm::quat_cast(glm::transpose(Mat3(left, up, forward)))), true};
}

}  // namespace

Quat RotationOf(const Mat4& matrix) {
  Vec3 x = UnitOrZero(Vec3(matrix[0]));
  Vec3 y = Vec3(matrix[1]);
  if (x == Vec3(0.0)) x = {1.0, 0.0, 0.0};
  y = UnitOrZero(y - x * glm::dot(x, y));
  if (y == Vec3(0.0)) {
    y = std::abs(x.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
    y = glm::normalize(y - x * glm::dot(x, y));
  }
  return glm::normalize(glm::quat_cast(Mat3(x, y, glm::cross(x, y))));
}

Quat Alignment::CanonicalRotation(HumanoidJoint j, const Quat& node_rotation,
                                  const Quat& node_rest_rotation) const {
  return glm::normalize(body_rotation * node_rotation * glm::conjugate(node_rest_rotation) *
                        glm::conjugate(to_canonical[Index(j)]));
}

Vec3 Alignment::ToStage(const Vec3& point_file) const {
  return metres_per_unit * (body_rotation * point_file);
}

Mat4 Alignment::CanonicalFromRest(HumanoidJoint j) const {
  Mat4 matrix = glm::mat4_cast(to_canonical[Index(j)]);
  for (int c = 0; c < 3; ++c) matrix[c] *= metres_per_unit;
  const Vec3 canonical = CanonicalPositions(skeleton)[Index(j)];
  matrix[3] = Vec4(canonical - Vec3(Mat3(matrix) * rest_position[Index(j)]), 1.0);
  return matrix;
}

void Alignment::MoveGround(double lowest_y) {
  skeleton.offset[Index(J::kHips)].y -= lowest_y;
  ground_point += glm::conjugate(body_rotation) * Vec3(0.0, lowest_y / metres_per_unit, 0.0);
}

void Alignment::RaiseToes(bool left, double angle) {
  const Quat turn = glm::angleAxis(-angle, Vec3(1.0, 0.0, 0.0));
  const std::size_t toes = Index(left ? J::kLeftToes : J::kRightToes);
  for (const std::size_t j : {Index(left ? J::kLeftFoot : J::kRightFoot), toes}) {
    to_canonical[j] = glm::normalize(turn * to_canonical[j]);
  }
  skeleton.offset[toes] = turn * skeleton.offset[toes];
}

Pose PoseFromNodes(const Alignment& alignment, const HumanoidMap& map,
                   std::span<const Quat> node_rest_rotation, std::span<const Quat> node_rotation,
                   std::span<const Vec3> node_position) {
  std::array<Quat, kJointCount> rotation_ws;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const int node = map.joint[j].node;
    if (node >= 0 && !alignment.skeleton.locked[j]) {
      rotation_ws[j] = alignment.CanonicalRotation(static_cast<J>(j), node_rotation[At(node)],
                                                   node_rest_rotation[At(node)]);
    } else {
      rotation_ws[j] = j == 0 ? kIdentity : rotation_ws[Index(kParent[j])];
    }
  }
  return PoseFromWorldRotations(rotation_ws,
                                alignment.ToStage(node_position[At(map.Node(J::kHips))]));
}

Result<Alignment> AlignRestPose(const JointTree& tree, std::span<const Mat4> rest_global,
                                const HumanoidMap& map, double metres_per_unit) {
  EGO_CHECK(rest_global.size() == tree.joints.size());
  EGO_CHECK(metres_per_unit > 0.0);
  Work w{tree, map, {}, {}, {}};
  w.node.resize(rest_global.size());
  for (std::size_t n = 0; n < rest_global.size(); ++n) w.node[n] = Vec3(rest_global[n][3]);
  PlaceJoints(w);
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (!std::isfinite(glm::dot(w.rest[j], w.rest[j]))) {
      return Error{"the rest position of " + std::string(Name(static_cast<J>(j))) +
                   " is not a finite number"};
    }
  }
  const BodyFrame frame = FindBodyFrame(w.rest);
  if (!frame.valid) {
    return Error{"the rest pose has no shape: hips and head, or left and right, lie in one place"};
  }

  Alignment alignment;
  alignment.metres_per_unit = metres_per_unit;
  alignment.body_rotation = frame.rotation;
  alignment.rest_position = w.rest;
  for (Vec3& p : w.node) p = metres_per_unit * (frame.rotation * p);
  for (Vec3& p : w.rest) p = metres_per_unit * (frame.rotation * p);
  w.turn.fill(kIdentity);
  for (const Limb limb : kLimbs) {
    if (IsArm(limb)) {
      AlignArm(w, limb);
    } else {
      AlignLeg(w, limb);
    }
  }
  Skeleton& skeleton = alignment.skeleton;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    alignment.to_canonical[j] = glm::normalize(w.turn[j] * frame.rotation);
    const std::size_t parent = Index(kParent[j]);
    if (j > 0) skeleton.offset[j] = w.turn[parent] * (w.rest[j] - w.rest[parent]);
  }
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    const auto stretch = [&](J from, J to) {
      skeleton.offset[Index(to)] =
          CanonicalDirection(limb) * glm::length(w.Rest(to) - w.Rest(from));
    };
    stretch(joints.base, joints.mid);
    stretch(joints.mid, joints.end);
  }
  for (const J j : {J::kSpine, J::kChest, J::kUpperChest, J::kLeftHand, J::kRightHand, J::kLeftFoot,
                    J::kRightFoot, J::kLeftToes, J::kRightToes}) {
    skeleton.locked[Index(j)] = !w.Has(j);
  }

  // The lowest sole that joints show, in the canonical and in the rest pose.
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(skeleton);
  double lowest = std::numeric_limits<double>::infinity();
  double lowest_rest = lowest;
  const auto lower = [&](J foot, const Vec3& rest) {
    const Vec3 p = canonical[Index(foot)] + w.Turn(foot) * (rest - w.Rest(foot));
    lowest = std::min(lowest, p.y);
    lowest_rest = std::min(lowest_rest, rest.y);
  };
  for (std::size_t side = 0; side < 2; ++side) {
    const J foot = side == 0 ? J::kLeftFoot : J::kRightFoot;
    lower(foot, w.Rest(foot));
    lower(foot, w.Rest(side == 0 ? J::kLeftToes : J::kRightToes));
    if (map.toe_tip[side] >= 0) lower(foot, w.NodeAt(map.toe_tip[side]));
  }
  skeleton.offset[Index(J::kHips)] = {0.0, -lowest, 0.0};
  const Vec3 hips = w.Rest(J::kHips);
  alignment.ground_point =
      glm::conjugate(frame.rotation) * (Vec3(hips.x, lowest_rest, hips.z) / metres_per_unit);
  return alignment;
}

}  // namespace ego
