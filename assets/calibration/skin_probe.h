// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/model/character.h"
#include "core/model/mesh_bvh.h"
#include "core/model/mesh_point.h"

namespace ego {

/// Pieces of skin told apart by the joints that carry them. They overlap.
enum class SkinRegion : std::uint8_t {
  kTrunk,      // hips to clavicles and neck
  kPelvis,     // the trunk and the thighs
  kShoulders,  // the trunk and the upper arms
  kHead,
  kHeadAndNeck,
  kLeftHand,
  kRightHand,
  kLeftFoot,  // with the toes
  kRightFoot,
  kSegments,  // and the next seven: a limb segment with the joints next to it
};
inline constexpr std::size_t kSkinRegionCount = static_cast<std::size_t>(SkinRegion::kSegments) + 8;
constexpr SkinRegion RegionOf(LimbSegment segment) {
  return static_cast<SkinRegion>(static_cast<std::size_t>(SkinRegion::kSegments) + Index(segment));
}

/// What a ray found: the skin that a hand from outside would meet.
struct SkinHit {
  MeshPoint place;
  Vec3 position_ms{0.0};
  Vec3 normal_ms{0.0};
  double distance = 0.0;
  bool loose_layer = false;  // more skin lies farther out, beyond a gap
};

/// A character in its canonical pose, ready to be searched for its skin: model space, metres. For
/// one thread at a time.
class SkinProbe {
 public:
  explicit SkinProbe(const Character& character);

  /// From inside the body outward: the last of the layers that lie on each other. A layer farther
  /// than `gap` from the one below it (a cape, a skirt, a hat's tip) is taken for loose and left,
  /// unless it is at most `reach` from the origin: heads are often hollow below the hair.
  std::optional<SkinHit> Outward(SkinRegion region, const Vec3& origin_ms, const Vec3& direction,
                                 double gap, double reach = 0.0) const;

  /// All the layers that Outward chooses from, nearest first: the outside of the first, then of
  /// what lies beyond a gap over it, and so on.
  std::vector<SkinHit> Layers(SkinRegion region, const Vec3& origin_ms, const Vec3& direction,
                              double gap) const;

  /// The median, by distance, of a bundle of parallel rays `spread` apart (3 x 3), or nothing when
  /// fewer than half of them meet skin. The hit returned is the one straight ahead where it agrees
  /// with the median, else the one with the median distance. `agreement` in [0, 1].
  std::optional<SkinHit> OutwardBundle(SkinRegion region, const Vec3& origin_ms,
                                       const Vec3& direction, double gap, double spread,
                                       double* agreement, double reach = 0.0) const;

  std::optional<SkinHit> Nearest(SkinRegion region, const Vec3& point_ms) const;
  /// Nearest place of any skin.
  std::optional<SkinHit> NearestAnywhere(const Vec3& point_ms) const;

  /// A triangle of a region, for what rays cannot answer (lowest, farthest, middle).
  struct Face {
    int part;
    std::uint32_t triangle;
    std::array<Vec3, 3> corner_ms;
    double area;
  };
  const std::vector<Face>& Faces(SkinRegion region) const;

  const Character& TheCharacter() const { return *character_; }
  const std::array<Vec3, kJointCount>& Joints() const { return joint_; }
  const Vec3& Joint(HumanoidJoint joint) const { return joint_[Index(joint)]; }
  Vec3 PositionOf(const MeshPoint& place) const { return Position(*character_, mesh_, place); }
  bool Empty() const { return All().Empty(); }

 private:
  const MeshBvh& Of(SkinRegion region) const;
  const MeshBvh& All() const;

  const Character* character_;
  PosedMesh mesh_;
  std::array<Vec3, kJointCount> joint_;
  std::vector<std::vector<std::int32_t>> closed_;  // see ClosedPieces
  std::array<std::vector<Face>, kSkinRegionCount> faces_;
  std::vector<std::vector<std::uint32_t>> regions_of_;  // by part and triangle: bit per region
  // Made when a region is first asked for: a check needs few of them.
  mutable std::array<std::unique_ptr<MeshBvh>, kSkinRegionCount> bvh_;
  mutable std::unique_ptr<MeshBvh> all_;
};

}  // namespace ego
