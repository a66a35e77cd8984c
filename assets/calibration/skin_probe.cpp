// SPDX-License-Identifier: MIT
#include "assets/calibration/skin_probe.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "assets/calibration/closed_pieces.h"

namespace ego {
namespace {

using J = HumanoidJoint;
using Mask = std::uint32_t;

constexpr double kFar = 1e6;

constexpr Mask Joints(std::initializer_list<J> joints) {
  Mask mask = 0;
  for (const J joint : joints) mask |= Mask{1} << Index(joint);
  return mask;
}

constexpr Mask kTrunk = Joints({J::kHips, J::kSpine, J::kChest, J::kUpperChest, J::kNeck,
                                J::kLeftShoulder, J::kRightShoulder});

/// The joints whose skin a region holds.
constexpr std::array<Mask, kSkinRegionCount> kMasks = {
    kTrunk,
    kTrunk | Joints({J::kLeftUpperLeg, J::kRightUpperLeg}),
    kTrunk | Joints({J::kLeftUpperArm, J::kRightUpperArm}),
    Joints({J::kHead}),
    Joints({J::kHead, J::kNeck}),
    Joints({J::kLeftHand}),
    Joints({J::kRightHand}),
    Joints({J::kLeftFoot, J::kLeftToes}),
    Joints({J::kRightFoot, J::kRightToes}),
    Joints({J::kLeftShoulder, J::kLeftUpperArm, J::kLeftLowerArm}),
    Joints({J::kLeftUpperArm, J::kLeftLowerArm, J::kLeftHand}),
    Joints({J::kRightShoulder, J::kRightUpperArm, J::kRightLowerArm}),
    Joints({J::kRightUpperArm, J::kRightLowerArm, J::kRightHand}),
    Joints({J::kHips, J::kLeftUpperLeg, J::kLeftLowerLeg}),
    Joints({J::kLeftUpperLeg, J::kLeftLowerLeg, J::kLeftFoot}),
    Joints({J::kHips, J::kRightUpperLeg, J::kRightLowerLeg}),
    Joints({J::kRightUpperLeg, J::kRightLowerLeg, J::kRightFoot}),
};

/// Parts that are rigid on a node of their own: weapons, hats, bags, or a robot's pieces.
std::vector<bool> RigidParts(const Character& character) {
  std::vector<int> users(character.palette.size(), 0);
  std::vector<int> only(character.parts.size(), -1);  // the one entry that carries the part
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    std::vector<bool> seen(character.palette.size(), false);
    for (const MeshPart::Influences& influences : character.parts[p].influences) {
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (influences.weight[k] > 0.0f) seen[influences.entry[k]] = true;
      }
    }
    int count = 0;
    for (std::size_t e = 0; e < seen.size(); ++e) {
      if (!seen[e]) continue;
      ++count;
      ++users[e];
      only[p] = static_cast<int>(e);
    }
    if (count != 1) only[p] = -1;
  }
  std::vector<bool> rigid(character.parts.size());
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    rigid[p] = only[p] >= 0 && users[static_cast<std::size_t>(only[p])] == 1;
  }
  return rigid;
}

/// Regions where what is carried (a sword, a shield) must not be taken for the body.
constexpr bool LeavesOutCarried(std::size_t region) {
  const auto r = static_cast<SkinRegion>(region);
  return r != SkinRegion::kHead && r != SkinRegion::kHeadAndNeck && r != SkinRegion::kTrunk &&
         r != SkinRegion::kPelvis && r != SkinRegion::kShoulders;
}

SkinHit FromBvh(const MeshBvh::Hit& hit) {
  return {hit.place, hit.position_ws, hit.normal_ws, hit.distance, false};
}

}  // namespace

SkinProbe::SkinProbe(const Character& character)
    : character_(&character),
      mesh_(CanonicalMesh(character)),
      joint_(CanonicalPositions(character.rig.skeleton)),
      closed_(ClosedPieces(character, mesh_)) {
  regions_of_.resize(character.parts.size());
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const MeshPart& part = character.parts[p];
    std::vector<std::array<double, kJointCount>> share(part.positions.size());
    for (std::size_t v = 0; v < share.size(); ++v) share[v] = JointShares(character, part, v);
    regions_of_[p].assign(part.triangles.size() / 3, 0);
    for (std::size_t t = 0; 3 * t + 2 < part.triangles.size(); ++t) {
      std::array<double, kJointCount> sum{};
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < kJointCount; ++j) {
          sum[j] += share[part.triangles[3 * t + k]][j] / 3.0;
        }
      }
      const std::vector<Vec3>& position = mesh_.position_ws[p];
      const std::array<Vec3, 3> corner = {position[part.triangles[3 * t]],
                                          position[part.triangles[3 * t + 1]],
                                          position[part.triangles[3 * t + 2]]};
      const double area =
          0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      if (!(area > 0.0)) continue;
      for (std::size_t r = 0; r < kSkinRegionCount; ++r) {
        double in_region = 0.0;
        for (std::size_t j = 0; j < kJointCount; ++j) {
          if ((kMasks[r] >> j & 1u) != 0u) in_region += sum[j];
        }
        if (in_region < 0.5) continue;
        regions_of_[p][t] |= Mask{1} << r;
        faces_[r].push_back({static_cast<int>(p), static_cast<std::uint32_t>(t), corner, area});
      }
    }
  }
  const std::vector<bool> rigid = RigidParts(character);
  for (std::size_t r = 0; r < kSkinRegionCount; ++r) {
    const auto is_rigid = [&](const Face& face) {
      return rigid[static_cast<std::size_t>(face.part)];
    };
    std::vector<Face>& faces = faces_[r];
    if (LeavesOutCarried(r) && !std::all_of(faces.begin(), faces.end(), is_rigid)) {
      for (const Face& face : faces) {
        if (is_rigid(face)) {
          regions_of_[static_cast<std::size_t>(face.part)][face.triangle] &= ~(Mask{1} << r);
        }
      }
      std::erase_if(faces, is_rigid);
    }
  }
}

const MeshBvh& SkinProbe::Of(SkinRegion region) const {
  const auto r = static_cast<std::size_t>(region);
  if (!bvh_[r]) {
    bvh_[r] = std::make_unique<MeshBvh>(*character_, mesh_, [&](int part, std::uint32_t triangle) {
      return (regions_of_[static_cast<std::size_t>(part)][triangle] >> r & 1u) != 0u;
    });
  }
  return *bvh_[r];
}

const MeshBvh& SkinProbe::All() const {
  if (!all_) all_ = std::make_unique<MeshBvh>(*character_, mesh_);
  return *all_;
}

const std::vector<SkinProbe::Face>& SkinProbe::Faces(SkinRegion region) const {
  return faces_[static_cast<std::size_t>(region)];
}

std::vector<SkinHit> SkinProbe::Layers(SkinRegion region, const Vec3& origin_ms,
                                       const Vec3& direction, double gap) const {
  const std::vector<MeshBvh::Hit> hits = Of(region).AllHits(origin_ms, direction, kFar);
  const auto piece_of = [&](const MeshBvh::Hit& hit) {
    return closed_[static_cast<std::size_t>(hit.place.part)][hit.place.triangle];
  };
  // 1 for a way out of the skin, -1 for a way in, by the piece's true outside.
  const auto way = [&](const MeshBvh::Hit& hit) {
    const double along = glm::dot(hit.normal_ws, direction);
    return (along > 0.0) == (piece_of(hit) >= 0) ? 1 : -1;
  };
  // After hit i the ray is inside when a closed piece is left later that was not entered in
  // between, or when hit i itself leads in.
  const auto inside_after = [&](std::size_t i) {
    if (way(hits[i]) < 0) return true;
    for (std::size_t j = i + 1; j < hits.size(); ++j) {
      const std::int32_t piece = piece_of(hits[j]);
      if (piece == 0 || way(hits[j]) < 0) continue;
      bool entered = false;
      for (std::size_t k = i + 1; k < j && !entered; ++k) entered = piece_of(hits[k]) == piece;
      if (!entered) return true;
    }
    return false;
  };
  std::vector<SkinHit> layers;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (i + 1 < hits.size() &&
        (hits[i + 1].distance - hits[i].distance <= gap || inside_after(i))) {
      continue;
    }
    layers.push_back(FromBvh(hits[i]));
  }
  return layers;
}

std::optional<SkinHit> SkinProbe::Outward(SkinRegion region, const Vec3& origin_ms,
                                          const Vec3& direction, double gap, double reach) const {
  const std::vector<SkinHit> layers = Layers(region, origin_ms, direction, gap);
  if (layers.empty()) return std::nullopt;
  std::size_t at = 0;
  while (at + 1 < layers.size() && layers[at + 1].distance <= reach) ++at;
  SkinHit hit = layers[at];
  hit.loose_layer = at + 1 < layers.size();
  return hit;
}

std::optional<SkinHit> SkinProbe::OutwardBundle(SkinRegion region, const Vec3& origin_ms,
                                                const Vec3& direction, double gap, double spread,
                                                double* agreement, double reach) const {
  // Rays above and below, and to both sides alike, so that a mirrored mesh answers mirrored.
  const Vec3 side =
      glm::normalize(std::abs(direction.y) < 0.9 ? glm::cross(direction, kUp)
                                                 : glm::cross(direction, Vec3{0.0, 0.0, 1.0}));
  const Vec3 up = glm::cross(side, direction);
  std::vector<SkinHit> hits;
  std::optional<SkinHit> ahead;
  for (const double u : {-1.0, 0.0, 1.0}) {
    for (const double s : {-1.0, 0.0, 1.0}) {
      const std::optional<SkinHit> hit =
          Outward(region, origin_ms + spread * (u * up + s * side), direction, gap, reach);
      if (hit) hits.push_back(*hit);
      if (u == 0.0 && s == 0.0) ahead = hit;
    }
  }
  if (hits.size() < 5) {
    *agreement = ahead ? 0.3 : 0.0;
    return ahead;
  }
  std::sort(hits.begin(), hits.end(),
            [](const SkinHit& a, const SkinHit& b) { return a.distance < b.distance; });
  const SkinHit& middle = hits[hits.size() / 2];
  const double tolerance = std::max(spread, 0.08 * middle.distance);
  std::size_t agreeing = 0;
  for (const SkinHit& hit : hits) {
    agreeing += std::abs(hit.distance - middle.distance) <= tolerance ? 1u : 0u;
  }
  *agreement = static_cast<double>(agreeing) / 9.0;
  if (ahead && std::abs(ahead->distance - middle.distance) <= tolerance) return ahead;
  return middle;
}

std::optional<SkinHit> SkinProbe::Nearest(SkinRegion region, const Vec3& point_ms) const {
  const std::optional<MeshBvh::Hit> hit = Of(region).Nearest(point_ms);
  if (!hit) return std::nullopt;
  return FromBvh(*hit);
}

std::optional<SkinHit> SkinProbe::NearestAnywhere(const Vec3& point_ms) const {
  const std::optional<MeshBvh::Hit> hit = All().Nearest(point_ms);
  if (!hit) return std::nullopt;
  return FromBvh(*hit);
}

}  // namespace ego
