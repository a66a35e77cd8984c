// SPDX-License-Identifier: MIT
#include "core/adapt/spatial_order.h"

#include <span>

#include "core/adapt/half_space.h"
#include "core/geometry/lanes.h"

namespace ego {
namespace {

inline PosedCapsule PlaceSegment(const AdaptState& state, LimbSegment segment,
                                 const LimbPlacement& placed) {
  const LimbChain& chain = state.chain[Index(LimbOf(segment))];
  const bool lower = IsLower(segment);
  return {lower ? placed.mid : chain.base_ws, lower ? placed.end : placed.mid,
          state.avatar.surface.limb_radius[Index(segment)],
          glm::mat3_cast(lower ? placed.mid_ws : placed.base_ws) *
              state.constants.segment_frame[Index(segment)]};
}

/// Both capsules of a limb side by side, upper and lower.
struct LimbCapsules {
  LimbCapsules(const PosedCapsule& upper, const PosedCapsule& lower)
      : start(Pair(upper.start, lower.start)),
        end(Pair(upper.end, lower.end)),
        frame{Pair(upper.frame[0], lower.frame[0]), Pair(upper.frame[1], lower.frame[1]),
              Pair(upper.frame[2], lower.frame[2])},
        radius{upper.radius, lower.radius} {}
  Lanes3 start;
  Lanes3 end;
  std::array<Lanes3, 3> frame;
  Lanes radius;
};

/// Whether `own` satisfies both planes against both capsules of another limb (see `Relax`), of
/// which `plane` and `reverse` are the planes.
bool Satisfies(const PosedCapsule& own, const LimbCapsules& other,
               const std::array<const EgocentricPlane*, 2>& plane,
               const std::array<const EgocentricPlane*, 2>& reverse, double height) {
  const Lanes zero{};
  const Lanes own_radius = Splat(own.radius);
  const Lanes slack = Splat(height) * Lanes{plane[0]->slack, plane[1]->slack};
  const Lanes3 start = Splat(own.start);
  const Lanes3 end = Splat(own.end);
  const auto inside = [&](const Lanes3& normal, const Lanes& offset) {
    const Lanes least = Min<Lanes>(Dot(normal, start) - offset, Dot(normal, end) - offset);
    return least - own_radius >= zero;
  };
  const Lanes3 normal_ls = Pair(plane[0]->normal_ls, plane[1]->normal_ls);
  const Lanes3 normal =
      normal_ls.x * other.frame[0] + normal_ls.y * other.frame[1] + normal_ls.z * other.frame[2];
  const Lanes3 at =
      other.start + Lanes{plane[0]->axial, plane[1]->axial} * (other.end - other.start);
  const Lanes3 reverse_ls = Pair(reverse[0]->normal_ls, reverse[1]->normal_ls);
  const Lanes3 opposite = -reverse_ls.x * Splat(own.frame[0]) - reverse_ls.y * Splat(own.frame[1]) -
                          reverse_ls.z * Splat(own.frame[2]);
  const Lanes support = Max<Lanes>(Dot(opposite, other.start), Dot(opposite, other.end));
  const LaneMask<Lanes> both = inside(normal, Dot(normal, at) + other.radius + slack) &
                               inside(opposite, support + other.radius + slack);
  return (both[0] & both[1]) != 0;
}

/// Whether there is nothing to do for a segment: most of them, most of the time.
bool IsInOrder(const AdaptState& state, LimbSegment segment, const PosedCapsule& own,
               std::span<const LimbCapsules> others) {
  const Limb limb = LimbOf(segment);
  for (std::size_t k = 0; k < others.size(); ++k) {
    const auto& plane = state.egocentric.plane;
    const std::size_t reverse = SlotOf(LimbOf(OtherSegment(limb, 2 * k)), segment);
    if (!Satisfies(own, others[k],
                   {&plane[Index(segment)][2 * k], &plane[Index(segment)][2 * k + 1]},
                   {&plane[Index(OtherSegment(limb, 2 * k))][reverse],
                    &plane[Index(OtherSegment(limb, 2 * k + 1))][reverse]},
                   state.avatar.height)) {
      return false;
    }
  }
  return true;
}

}  // namespace

LimbPosture EnsureSpatialOrder(const AdaptState& state, Limb limb, const LimbPosture& posture,
                               double w, double overlap) {
  const LimbChain& chain = state.chain[Index(limb)];
  const double ramp = state.scale * state.settings.plane_ramp;
  const auto capsules_of = [&](std::size_t k) {
    return LimbCapsules(state.posed.capsule[Index(OtherSegment(limb, 2 * k))],
                        state.posed.capsule[Index(OtherSegment(limb, 2 * k + 1))]);
  };
  const std::array<LimbCapsules, 3> others = {capsules_of(0), capsules_of(1), capsules_of(2)};
  // The partner comes first; legs need not heed arms.
  const bool heeds_all = IsArm(limb) || state.egocentric.form.legs_relate_to_arms;
  const std::span<const LimbCapsules> heeded(others.data(), heeds_all ? 3 : 1);
  LimbPosture ordered = posture;
  LimbPlacement placed = Place(chain, ordered);
  for (std::size_t part = 0; part < 2; ++part) {
    const auto segment = static_cast<LimbSegment>(2 * Index(limb) + part);
    PosedCapsule own = PlaceSegment(state, segment, placed);
    if (IsInOrder(state, segment, own, heeded)) continue;
    for (std::size_t slot = 0; slot < 2 * heeded.size(); ++slot) {
      const LimbSegment other = OtherSegment(limb, slot);
      const EgocentricPlane& plane = state.egocentric.plane[Index(segment)][slot];
      const EgocentricPlane& reverse =
          state.egocentric.plane[Index(other)][SlotOf(LimbOf(other), segment)];
      const PosedCapsule& obstacle = state.posed.capsule[Index(other)];
      const RelaxedPlane relaxed = Relax(MapPlane(plane, obstacle, state.avatar.height), reverse,
                                         own, obstacle, state.avatar.height, plane.slack);
      if (!(relaxed.strength > 0.0)) continue;
      HalfSpace active = Activate(relaxed.half_space, state.settings.plane_retreat * own.radius, w);
      active.offset += own.radius;  // deflation (figure 17b)
      active.offset -= overlap * (own.radius + obstacle.radius);
      if (part == 0) {
        const LimbPosture turned = SatisfyUpper(chain, ordered, active, ramp, relaxed.strength);
        ordered = state.settings.restore_ends ? ReachEnd(chain, turned, placed.end) : turned;
      } else {
        ordered = SatisfyLower(chain, ordered, active, ramp, relaxed.strength);
      }
      placed = Place(chain, ordered);
      own = PlaceSegment(state, segment, placed);
    }
  }
  return ordered;
}

}  // namespace ego
