// SPDX-License-Identifier: MIT
#include "core/adapt/spatial_order.h"

#include "core/adapt/half_space.h"

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

}  // namespace

LimbPosture EnsureSpatialOrder(const AdaptState& state, Limb limb, const LimbPosture& posture,
                               double w) {
  const LimbChain& chain = state.chain[Index(limb)];
  const double ramp = state.scale * state.settings.plane_ramp;
  LimbPosture ordered = posture;
  LimbPlacement placed = Place(chain, ordered);
  for (std::size_t part = 0; part < 2; ++part) {
    const auto segment = static_cast<LimbSegment>(2 * Index(limb) + part);
    PosedCapsule own = PlaceSegment(state, segment, placed);
    for (std::size_t slot = 0; slot < kOtherSegmentCount; ++slot) {
      const LimbSegment other = OtherSegment(limb, slot);
      if (!IsArm(limb) && IsArm(LimbOf(other)) && !state.egocentric.form.legs_relate_to_arms) {
        continue;
      }
      const EgocentricPlane& plane = state.egocentric.plane[Index(segment)][slot];
      const EgocentricPlane& reverse =
          state.egocentric.plane[Index(other)][SlotOf(LimbOf(other), segment)];
      const PosedCapsule& obstacle = state.posed.capsule[Index(other)];
      const RelaxedPlane relaxed = Relax(MapPlane(plane, obstacle, state.avatar.height), reverse,
                                         own, obstacle, state.avatar.height, plane.slack);
      if (!(relaxed.strength > 0.0)) continue;
      HalfSpace active = Activate(relaxed.half_space, state.settings.plane_retreat * own.radius, w);
      active.offset += own.radius;  // deflation (figure 17b)
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
