// SPDX-License-Identifier: MIT
#include "assets/motions/rigid_skin.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "assets/motions/skin_measure.h"
#include "core/model/rig.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kFarShare = 0.5;     // of upper arm and thigh, as in SkinMeasure
constexpr double kPieceShare = 0.35;  // pieces overlap where skin is shared, so that no gap opens
constexpr double kStraight = 0.6;     // cosine up to which the nearest skin is straight ahead
constexpr double kHandCell = 0.012;   // one probe each
constexpr double kLimbCell = 0.020;

struct Carried {
  std::array<int, 4> node{};
  std::array<double, 4> weight{};
};

Carried StrongestNodes(const Character& character, const MeshPart& part, std::size_t vertex) {
  std::vector<std::pair<double, int>> shares;
  for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
    const auto weight = static_cast<double>(part.influences[vertex].weight[k]);
    if (weight <= 0.0) continue;
    shares.emplace_back(weight, character.palette[part.influences[vertex].entry[k]].node);
  }
  std::sort(shares.begin(), shares.end(), std::greater<>());
  shares.resize(4, {0.0, 0});
  Carried carried;
  double sum = 0.0;
  for (const auto& share : shares) sum += share.first;
  for (std::size_t k = 0; k < 4; ++k) {
    carried.node[k] = shares[k].second;
    carried.weight[k] = shares[k].first / sum;
  }
  return carried;
}

Vec3 Moved(const Mat4& m, const Vec3& p) { return Vec3(m * Vec4(p, 1.0)); }

}  // namespace

RigidSkin::RigidSkin(const Character& character) : character_(character) {
  const Rig& rig = character.rig;
  const std::size_t nodes = character.nodes.joints.size();
  for (const Mat4& m : rig.canonical_global) from_canonical_.push_back(glm::inverse(m));
  const PosedMesh mesh = CanonicalMesh(character);
  const std::array<Vec3, kJointCount> canonical = CanonicalPositions(rig.skeleton);
  std::vector<std::vector<Carried>> carried;
  std::vector<bool> used(nodes, false);
  std::map<std::tuple<int, int, int, int>, bool> taken;
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const MeshPart& part = character.parts[p];
    std::vector<Carried>& of_part = carried.emplace_back();
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      const Carried c = StrongestNodes(character, part, v);
      of_part.push_back(c);
      const auto main = static_cast<std::size_t>(c.node[0]);
      used[main] = true;
      const J joint = rig.driver[main];
      const std::optional<Limb> limb = LimbOf(joint);
      if (!limb) continue;
      const Vec3& at = mesh.position_ws[p][v];
      const LimbJoints joints = JointsOf(*limb);
      if (joint == joints.base) {
        const Vec3 bone = canonical[Index(joints.mid)] - canonical[Index(joint)];
        if (glm::dot(at - canonical[Index(joint)], bone) < kFarShare * glm::dot(bone, bone)) {
          continue;
        }
      }
      const double cell = joint == joints.end && IsArm(*limb) ? kHandCell : kLimbCell;
      const glm::ivec3 key(glm::floor(at / cell));
      bool& there = taken[{static_cast<int>(joint), key.x, key.y, key.z}];
      if (there) continue;
      there = true;
      Probe probe{c.node, c.weight, at, -1, joint == joints.base};
      if (!rig.fingers.joint_of.empty() && rig.fingers.joint_of[main] >= 0) {
        probe.digit = static_cast<int>(
            rig.fingers.joints[static_cast<std::size_t>(rig.fingers.joint_of[main])].digit);
      }
      probes_[Index(*limb)].push_back(probe);
    }
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (!used[n]) continue;
    Piece piece{static_cast<int>(n), -1,
                MeshBvh(character, mesh,
                        [&](int p, std::uint32_t t) {
                          const auto part = static_cast<std::size_t>(p);
                          const std::uint32_t* corner =
                              &character.parts[part].triangles[std::size_t{3} * t];
                          for (int i = 0; i < 3; ++i) {
                            const Carried& c = carried[part][corner[i]];
                            for (std::size_t k = 0; k < 4; ++k) {
                              if (c.node[k] == static_cast<int>(n) && c.weight[k] >= kPieceShare) {
                                return true;
                              }
                            }
                          }
                          return false;
                        }),
                Vec3(std::numeric_limits<double>::max()),
                Vec3(std::numeric_limits<double>::lowest())};
    if (piece.skin.Empty()) continue;
    if (const auto limb = LimbOf(rig.driver[n])) piece.limb = static_cast<int>(*limb);
    for (std::size_t p = 0; p < carried.size(); ++p) {
      for (std::size_t v = 0; v < carried[p].size(); ++v) {
        const Carried& c = carried[p][v];
        for (std::size_t k = 0; k < 4; ++k) {
          if (c.node[k] != static_cast<int>(n) || c.weight[k] < kPieceShare) continue;
          piece.low = glm::min(piece.low, mesh.position_ws[p][v]);
          piece.high = glm::max(piece.high, mesh.position_ws[p][v]);
        }
      }
    }
    pieces_.push_back(std::move(piece));
  }
}

RigidSkin::Posed RigidSkin::PosedAs(const Pose& pose) const {
  Posed posed;
  posed.motion.resize(from_canonical_.size());
  PoseNodes(character_.rig, pose, posed.motion);
  for (std::size_t n = 0; n < posed.motion.size(); ++n) posed.motion[n] *= from_canonical_[n];
  for (const Piece& piece : pieces_) {
    posed.inverse.push_back(glm::inverse(posed.motion[static_cast<std::size_t>(piece.node)]));
  }
  return posed;
}

Vec3 RigidSkin::At(const Probe& probe, const Posed& posed) {
  Vec3 at{0.0};
  for (std::size_t k = 0; k < 4 && probe.weight[k] > 0.0; ++k) {
    at += probe.weight[k] *
          Moved(posed.motion[static_cast<std::size_t>(probe.node[k])], probe.position_ms);
  }
  return at;
}

std::vector<std::size_t> RigidSkin::Near(std::span<const Vec3> probes, const Posed& posed, int limb,
                                         int absent, double reach) const {
  Vec3 low(std::numeric_limits<double>::max());
  Vec3 high(std::numeric_limits<double>::lowest());
  for (const Vec3& p : probes) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (piece.limb >= 0 && (piece.limb == limb || piece.limb == absent)) continue;
    const Vec3 at = Moved(posed.motion[static_cast<std::size_t>(piece.node)], piece.Middle());
    if (glm::distance(at, glm::clamp(at, low, high)) < piece.Radius() + reach) near.push_back(i);
  }
  return near;
}

std::optional<double> RigidSkin::Distance(const Vec3& p, const Posed& posed,
                                          std::span<const std::size_t> pieces, double reach,
                                          Vec3& out_ws) const {
  double best = reach;
  std::optional<double> distance;
  for (const std::size_t i : pieces) {
    const Piece& piece = pieces_[i];
    const Vec3 local = Moved(posed.inverse[i], p);
    if (glm::any(glm::lessThan(local, piece.low - best)) ||
        glm::any(glm::greaterThan(local, piece.high + best))) {
      continue;
    }
    const auto hit = piece.skin.Nearest(local);
    if (!hit || hit->distance >= best) continue;
    best = hit->distance;
    // Nearest to the rim of a piece says nothing: what lies beyond the rim is another piece's.
    const double along = glm::dot(local - hit->position_ws, hit->normal_ws);
    distance = along < -kStraight * best ? -best : best;
    out_ws = Mat3(posed.motion[static_cast<std::size_t>(piece.node)]) * (hit->position_ws - local);
  }
  return distance;
}

RigidSkin::Depth RigidSkin::Of(Limb limb, const Pose& pose, std::optional<Limb> absent) const {
  constexpr double kReach = 0.08;
  const Posed posed = PosedAs(pose);
  const std::vector<Probe>& probes = probes_[Index(limb)];
  std::vector<Vec3> at;
  for (const Probe& probe : probes) at.push_back(At(probe, posed));
  const std::vector<std::size_t> pieces =
      Near(at, posed, static_cast<int>(limb), absent ? static_cast<int>(*absent) : -1, 0.0);
  Depth depth;
  double upper = 0.0;
  for (std::size_t n = 0; n < probes.size(); ++n) {
    // Only what lies in the box of a piece can lie deep.
    const bool within = std::any_of(pieces.begin(), pieces.end(), [&](std::size_t i) {
      const Vec3 local = Moved(posed.inverse[i], at[n]);
      return glm::all(glm::greaterThan(local, pieces_[i].low)) &&
             glm::all(glm::lessThan(local, pieces_[i].high));
    });
    if (!within) continue;
    Vec3 out{0.0};
    const auto distance = Distance(at[n], posed, pieces, kReach, out);
    if (!distance || *distance >= 0.0) continue;
    depth.deepest = std::max(depth.deepest, -*distance);
    depth.sum -= *distance;
    // The deepest count most.
    (probes[n].upper ? depth.upper_out_ws : depth.out_ws) += -*distance * out;
    if (probes[n].upper) upper -= *distance;
  }
  if (depth.sum > upper) depth.out_ws /= depth.sum - upper;
  if (upper > 0.0) depth.upper_out_ws /= upper;
  return depth;
}

RigidSkin::Depth RigidSkin::OfFinger(std::size_t side, std::size_t digit, const Pose& pose,
                                     std::optional<Limb> absent, double& gap) const {
  constexpr double kReach = 0.04;
  const Limb limb = side == 0 ? Limb::kLeftArm : Limb::kRightArm;
  const Posed posed = PosedAs(pose);
  std::vector<Vec3> at;
  for (const Probe& probe : probes_[Index(limb)]) {
    if (probe.digit == static_cast<int>(digit)) at.push_back(At(probe, posed));
  }
  const std::vector<std::size_t> pieces =
      Near(at, posed, static_cast<int>(limb), absent ? static_cast<int>(*absent) : -1, kReach);
  Depth depth;
  gap = kReach;
  for (const Vec3& p : at) {
    Vec3 out{0.0};
    const auto distance = Distance(p, posed, pieces, kReach, out);
    if (!distance) continue;
    gap = std::min(gap, *distance);
    if (*distance >= 0.0) continue;
    depth.deepest = std::max(depth.deepest, -*distance);
    depth.sum -= *distance;
  }
  return depth;
}

}  // namespace ego
