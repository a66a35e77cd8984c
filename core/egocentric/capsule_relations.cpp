// SPDX-License-Identifier: MIT
#include "core/egocentric/capsule_relations.h"

#include <algorithm>

namespace ego {
namespace {

using Slots = std::array<CapsuleQuad, kOtherCapsuleCount>;

/// The capsules that the points of a group relate to, in place.
struct Capsules {
  QuadVectors start;
  QuadVectors axis;  // start to end
  Quad per_square;   // one over the square of its length, 0 where it has none
  Quad filled;       // radius, and the point's own thickness
  std::array<QuadVectors, 3> frame;
};

const PosedCapsule& OtherCapsule(const PosedBody& posed, Limb limb, std::size_t slot) {
  return slot == kHandSlot ? posed.hand[Index(Mirror(limb))]
                           : posed.capsule[Index(OtherSegment(limb, slot))];
}

/// What the thickness of the points and `radius` of the limbs' capsules fill.
Quad Filled(const BodyConstants& constants, std::size_t group, bool own_thickness,
            const std::array<double, 2>& radius) {
  Quad filled;
  for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
    const double own = own_thickness ? constants.thickness[Index(kPointGroups[group][lane])] : 0.0;
    filled[lane] = radius[lane % 2] + own;
  }
  return filled;
}

Capsules CapsulesOf(const GroupQuery& query, std::size_t slot) {
  const std::array<Limb, 2> limb = LimbsOf(query.group);
  const PosedCapsule& even = OtherCapsule(query.posed, limb[0], slot);
  const PosedCapsule& odd = OtherCapsule(query.posed, limb[1], slot);
  const auto per_square = [](const Vec3& axis) {
    const double square = glm::dot(axis, axis);
    return square > 0.0 ? 1.0 / square : 0.0;
  };
  const Vec3 even_axis = even.end - even.start;
  const Vec3 odd_axis = odd.end - odd.start;
  const double even_square = per_square(even_axis);
  const double odd_square = per_square(odd_axis);
  Capsules capsules;
  capsules.start.SetAlternating(even.start, odd.start);
  capsules.axis.SetAlternating(even_axis, odd_axis);
  capsules.per_square = {even_square, odd_square, even_square, odd_square};
  capsules.filled =
      Filled(query.constants, query.group, query.own_thickness, {even.radius, odd.radius});
  for (int k = 0; k < 3; ++k) {
    capsules.frame[static_cast<std::size_t>(k)].SetAlternating(even.frame[k], odd.frame[k]);
  }
  return capsules;
}

/// All bones of a group's paths.
struct Bones {
  std::array<QuadVectors, kMaxGroupBones> direction;
  std::array<Quad, kMaxGroupBones> length;
};

Quad Lengths(const std::array<std::uint8_t, kPointGroupSize>& bone,
             const std::array<double, kBoneCount>& length) {
  return {length[bone[0]], length[bone[1]], length[bone[2]], length[bone[3]]};
}

template <class V>
EGO_LANES_INLINE void RelateToCapsule(const GroupQuery& query, const LaneVectors<V>& point,
                                      const Capsules& capsules, const CapsulePaths::Path& path,
                                      const Bones& bones, std::size_t first, CapsuleQuad& relation,
                                      CapsuleDistance& distance, Importances& total) {
  const V zero{};
  const V one = Splat<V>(1.0);
  const LaneVectors<V> axis = Load<V>(capsules.axis, first);
  const LaneVectors<V> offset = point - Load<V>(capsules.start, first);
  const V axial =
      Min<V>(one, Max<V>(zero, Dot(offset, axis) * Load<V>(capsules.per_square, first)));
  const LaneVectors<V> away = offset - axial * axis;
  const V reach = Sqrt<V>(Dot(away, away));
  const LaneMask<V> is_away = reach > Splat<V>(1e-12);
  const LaneVectors<V> across = Load<V>(capsules.frame[1], first);
  const LaneVectors<V> direction =
      Select<V>(is_away, (one / Select<V>(is_away, reach, one)) * away, across);
  V tau{};
  for (std::size_t i = 0; i < path.length; ++i) {
    const std::size_t bone = path.bone[i];
    const V cosine = Abs<V>(Dot(direction, Load<V>(bones.direction[bone], first)));
    Store<V>(cosine, distance.cosine[i], first);
    tau += Load<V>(bones.length[bone], first) * (Splat<V>(kLeastCosine) + cosine);
  }
  const V filled = Load<V>(capsules.filled, first);
  const LaneMask<V> is_filled = filled > zero;
  const V inside = Min<V>(one, reach / Select<V>(is_filled, filled, one));
  const V gap = reach - filled;
  Store<V>(Select<V>(is_filled, inside, one), distance.inside, first);
  Store<V>(Max<V>(zero, gap) / Max<V>(tau, Splat<V>(query.least_factor)), distance.gap, first);
  // The displacement from a capsule is always along its normal.
  const V importance = one / Max<V>(gap, Splat<V>(query.epsilon));
  const V priority = one / Max<V>(gap, Splat<V>(query.gamma_epsilon));
  Store<V>(importance, relation.importance, first);
  Store<V>(axial, relation.axial, first);
  Store<V>(LaneVectors<V>{Dot(direction, Load<V>(capsules.frame[0], first)), Dot(direction, across),
                          Dot(direction, Load<V>(capsules.frame[2], first))},
           relation.direction_ls, first);
  Store<V>(Load<V>(total.sum, first) + importance, total.sum, first);
  Store<V>(Max<V>(Load<V>(total.max, first), importance), total.max, first);
  Store<V>(Max<V>(Load<V>(total.priority, first), priority), total.priority, first);
}

void RelateInTwoLanes(const GroupQuery& query, const QuadVectors& points, const Capsules& capsules,
                      const CapsulePaths::Path& path, const Bones& bones, CapsuleQuad& relation,
                      CapsuleDistance& distance, Importances& total) {
  for (const std::size_t first : {0, 2}) {
    RelateToCapsule<Lanes>(query, Load<Lanes>(points, first), capsules, path, bones, first,
                           relation, distance, total);
  }
}

EGO_WIDE_LANES_TARGET
void RelateInFourLanes(const GroupQuery& query, const QuadVectors& points, const Capsules& capsules,
                       const CapsulePaths::Path& path, const Bones& bones, CapsuleQuad& relation,
                       CapsuleDistance& distance, Importances& total) {
  RelateToCapsule<WideLanes>(query, Load<WideLanes>(points, 0), capsules, path, bones, 0, relation,
                             distance, total);
}

}  // namespace

void RelateToCapsules(const GroupQuery& query, const EgocentricForm& form, Slots& relations,
                      GroupDistances& distances, Importances& total, LaneWidth lanes) {
  const CapsulePaths& paths = PathsFromCapsules(query.group);
  Bones bones;
  for (std::size_t b = 0; b < paths.bone_count; ++b) {
    bones.length[b] = Lengths(paths.bone[b], query.constants.bone_length);
    for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
      bones.direction[b].Set(lane, query.bone_direction[paths.bone[b][lane]]);
    }
  }
  QuadVectors points;
  for (std::size_t lane = 0; lane < kPointGroupSize; ++lane) {
    points.Set(lane, query.posed.point[Index(kPointGroups[query.group][lane])]);
  }
  for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
    if (!RelatesToCapsule(form, query.group, slot)) continue;
    const Capsules capsules = CapsulesOf(query, slot);
    if (lanes == LaneWidth::kFour) {
      RelateInFourLanes(query, points, capsules, paths.from[slot], bones, relations[slot],
                        distances[slot], total);
    } else {
      RelateInTwoLanes(query, points, capsules, paths.from[slot], bones, relations[slot],
                       distances[slot], total);
    }
  }
}

void CapsuleReaches(const Body& body, const BodyConstants& constants, const EgocentricForm& form,
                    std::size_t group, const GroupDistances& distances,
                    std::array<Quad, kOtherCapsuleCount>& reach) {
  const CapsulePaths& paths = PathsFromCapsules(group);
  std::array<Quad, kMaxGroupBones> length;
  for (std::size_t b = 0; b < paths.bone_count; ++b) {
    length[b] = Lengths(paths.bone[b], constants.bone_length);
  }
  for (std::size_t slot = 0; slot < kOtherCapsuleCount; ++slot) {
    reach[slot] = {};
    if (!RelatesToCapsule(form, group, slot)) continue;
    const auto radius = [&](Limb limb) {
      return slot == kHandSlot ? body.surface.hand[Index(Mirror(limb))].half_thickness
                               : body.surface.limb_radius[Index(OtherSegment(limb, slot))];
    };
    const std::array<Limb, 2> limb = LimbsOf(group);
    const Quad filled =
        Filled(constants, group, form.own_thickness, {radius(limb[0]), radius(limb[1])});
    const CapsulePaths::Path& path = paths.from[slot];
    for (const std::size_t first : {0, 2}) {
      Lanes tau{};
      for (std::size_t i = 0; i < path.length; ++i) {
        tau += Load<Lanes>(length[path.bone[i]], first) *
               (Splat(kLeastCosine) + Load<Lanes>(distances[slot].cosine[i], first));
      }
      Store<Lanes>(Load<Lanes>(filled, first) * Load<Lanes>(distances[slot].inside, first) +
                       Load<Lanes>(distances[slot].gap, first) * tau,
                   reach[slot], first);
    }
  }
}

}  // namespace ego
