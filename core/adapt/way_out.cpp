// SPDX-License-Identifier: MIT
#include "core/adapt/way_out.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Length of the mean direction from which on it begins to say, and says, which side it is.
constexpr double kUnclear = 0.3;
constexpr double kClear = 0.8;
/// The performer's distance, in heights, from which on the mean direction begins to count, and
/// counts alone; within reach of `MeasureClearance`.
constexpr double kNear = 0.01;
constexpr double kFar = 0.045;
/// In heights: over which a push begins, and how deep inside the performer's own point no side is
/// decided any more.
constexpr double kRamp = 0.02;
constexpr double kUndecided = 0.02;
/// What a push can hardly exceed, over the arm's length: it must not lead past the shoulder.
constexpr double kMostPush = 0.2;

/// The nearest point that the limb's end can reach.
Vec3 WithinReach(const LimbChain& chain, const Vec3& target) {
  const Vec3 offset = target - chain.base_ws;
  const double distance = glm::length(offset);
  const double reach = chain.Reach();
  return distance > reach ? chain.base_ws + offset * (reach / distance) : target;
}

}  // namespace

Vec3 WayOut(const AdaptState& state, Limb arm, std::size_t contact, std::size_t obstacle) {
  const MeshCoordinates& mesh = state.egocentric.mesh[Index(arm)];
  const MeshRelations& relations = obstacle == 0 ? mesh.trunk : mesh.head;
  const std::size_t lane = LaneOf(ContactPoint(arm, contact));
  const Vec3 mean = relations.inside.At(lane) / relations.importance[lane];
  const double length = glm::length(mean);
  const Vec3 side =
      Smoothstep((length - kUnclear) / (kClear - kUnclear)) * NormalizedOr(mean, Vec3{0.0});
  const Clearance& performer =
      state.egocentric.clearance[Index(arm)][kFirstContactSample + contact][obstacle];
  if (!performer.known) return state.posed.hips * side;
  const double far = Smoothstep((performer.distance - kNear) / (kFar - kNear));
  return state.posed.hips * glm::mix(performer.direction_ls, side, far);
}

Vec3 OutOfBody(const AdaptState& state, const BodyObstacles& body, Limb arm, const Vec3& target) {
  const LimbChain& chain = state.chain[Index(arm)];
  const double height = state.avatar.height;
  const Vec3& wrist = state.posed.point[Index(EndPoint(arm))];
  Vec3 p = WithinReach(chain, target);
  bool moved = false;
  if (!chain.has_bones) return target;
  for (int step = 0; step < state.settings.target_steps; ++step) {
    Vec3 push{0.0};
    double sum = 0.0;
    for (std::size_t contact = 0; contact < kContactCount; ++contact) {
      const LimbPoint j = ContactPoint(arm, contact);
      const ArmSample sample{p + (state.posed.point[Index(j)] - wrist),
                             state.constants.thickness[Index(j)]};
      for (std::size_t obstacle = 0; obstacle < kFirstCapsuleObstacle; ++obstacle) {
        SignedDistance now;
        if (body.LowerBound(obstacle, sample) > 0.0) continue;
        if (!body.Distance(obstacle, sample, now)) continue;
        const Clearance& performer =
            state.egocentric.clearance[Index(arm)][kFirstContactSample + contact][obstacle];
        const double allowed = performer.known ? std::min(0.0, performer.distance * height) : 0.0;
        const double clear =
            performer.known ? Smoothstep(1.0 + performer.distance / kUndecided) : 1.0;
        const double deeper = SoftRamp(allowed - now.distance, kRamp * height);
        if (!(deeper > 0.0)) continue;
        push += (clear * deeper * deeper) * WayOut(state, arm, contact, obstacle);
        sum += deeper;
      }
    }
    if (!(sum > 0.0)) break;
    push /= sum;
    const double most = kMostPush * chain.Reach();
    push /= std::sqrt(1.0 + glm::dot(push, push) / (most * most));
    p = WithinReach(chain, p + push);
    moved = true;
  }
  if (!moved) return target;
  // As far beyond reach as it was: the limb IK stretches the arm by that.
  const double beyond = std::max(1.0, glm::distance(target, chain.base_ws) / chain.Reach());
  return chain.base_ws + beyond * (p - chain.base_ws);
}

}  // namespace ego
