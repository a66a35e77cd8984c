// SPDX-License-Identifier: MIT
#include "core/adapt/adapt.h"

#include "core/adapt/adapt_state.h"
#include "core/adapt/arm_clearance.h"
#include "core/adapt/body_folding.h"
#include "core/adapt/denormalize.h"
#include "core/adapt/extremity.h"
#include "core/adapt/hand_reach.h"
#include "core/adapt/spatial_order.h"
#include "core/adapt/stance.h"
#include "core/adapt/way_out.h"

namespace ego {
namespace {

constexpr std::array<Limb, 2> kArms = {Limb::kLeftArm, Limb::kRightArm};
constexpr std::array<Limb, 2> kLegs = {Limb::kLeftLeg, Limb::kRightLeg};

/// Section 6.1, after the captured joint angles: arms that need not fight their way out of the
/// legs.
void InitializeArms(AdaptState& state) {
  const auto task = [&](Limb arm) -> LimbTask {
    const LimbTargets targets = InitialTargets(state, arm);
    return {&state.chain[Index(arm)], state.limb[Index(arm)], targets.mid, targets.end,
            state.gamma[Index(arm)]};
  };
  const std::array<LimbPosture, 2> posture = BlendedIk({task(kArms[0]), task(kArms[1])});
  for (const Limb arm : kArms) state.Apply(arm, posture[Index(arm)]);
}

/// The limb IK of one limb (section 6.2): attraction towards the targets in proportion to w (figure
/// 13).
LimbTask TaskOf(const AdaptState& state, Limb limb, const LimbTargets& targets, double w) {
  const LimbChain& chain = state.chain[Index(limb)];
  const LimbPosture& posture = state.limb[Index(limb)];
  const LimbJoints joints = JointsOf(limb);
  return {&chain, state.settings.start_from_captured ? chain.captured : posture,
          glm::mix(state.posed.pose.Position(joints.mid), targets.mid, w),
          glm::mix(state.posed.pose.Position(joints.end), targets.end, w),
          state.gamma[Index(limb)]};
}

/// One limb alone: limb IK, then spatial order (section 6.3).
void AdaptLimb(AdaptState& state, Limb limb, double w, bool with_planes) {
  const LimbTask task = TaskOf(state, limb, TargetsOf(state, limb), w);
  const LimbPosture attracted = BlendedIk({task, task})[0];
  state.Apply(limb, with_planes ? EnsureSpatialOrder(state, limb, attracted, w) : attracted);
}

/// Targets of the arms that lead through the trunk or head.
void BringOutOfBody(const AdaptState& state, const std::array<Limb, 2>& arms,
                    std::array<LimbTargets, 2>& targets) {
  if (!state.egocentric.form.clearance || !state.egocentric.form.hand_points) return;
  const BodyObstacles body(state.avatar, state.posed);
  for (std::size_t k = 0; k < 2; ++k) {
    targets[k].end = OutOfBody(state, body, arms[k], targets[k].end);
  }
}

/// Both limbs of a pair from one state of the body, so that neither side is first.
void AdaptPair(AdaptState& state, const std::array<Limb, 2>& pair, double w, bool with_planes) {
  std::array<LimbTargets, 2> targets = TargetsOfPair(state, pair[0]);
  if (IsArm(pair[0])) {
    for (std::size_t k = 0; k < 2; ++k) ReachWithHand(state, pair[k], targets[k]);
    BringOutOfBody(state, pair, targets);
  }
  std::array<LimbPosture, 2> posture =
      BlendedIk({TaskOf(state, pair[0], targets[0], w), TaskOf(state, pair[1], targets[1], w)});
  for (std::size_t k = 0; k < 2; ++k) {
    // Without planes legs still do not pass through each other; arms are kept clear at the end.
    if (!with_planes && IsArm(pair[k])) break;
    const double overlap = with_planes ? 0.0 : state.settings.leg_overlap;
    posture[k] = EnsureSpatialOrder(state, pair[k], posture[k], w, overlap);
  }
  for (std::size_t k = 0; k < 2; ++k) state.Apply(pair[k], posture[k]);
}

void AlignExtremities(AdaptState& state, const std::array<Limb, 2>& pair,
                      const std::array<Quat, kLimbCount>& captured_ws) {
  std::array<Quat, 2> aligned;
  for (std::size_t k = 0; k < 2; ++k) {
    aligned[k] = AlignExtremity(state, pair[k], captured_ws[Index(pair[k])]);
  }
  for (std::size_t k = 0; k < 2; ++k) state.TurnExtremity(pair[k], aligned[k]);
}

/// One pass over all limbs, legs first: arms find them where they will be.
void AdaptLimbs(AdaptState& state, double w, bool with_planes,
                const std::array<Quat, kLimbCount>& captured_ws) {
  if (!state.settings.solve_pairs) {
    for (const Limb limb : kLimbs) AdaptLimb(state, limb, w, with_planes);
    return;
  }
  for (const auto& pair : {kLegs, kArms}) {
    if (state.settings.hands_keep_direction) AlignExtremities(state, pair, captured_ws);
    AdaptPair(state, pair, w, with_planes);
    if (w == 1.0 && pair == kLegs) {
      for (const Limb leg : kLegs) LockStance(state, leg);
    }
  }
}

void WritePose(AdaptState& state, Pose& out) {
  for (const Limb limb : kLimbs) {
    const LimbJoints joints = JointsOf(limb);
    const LimbPosture& posture = state.limb[Index(limb)];
    state.pose.rotation_ls[Index(joints.base)] = posture.base;
    state.pose.rotation_ls[Index(joints.mid)] = posture.mid;
    if (state.avatar.skeleton.locked[Index(joints.end)]) continue;
    const Quat lower = Place(state.chain[Index(limb)], posture).mid_ws;
    state.pose.rotation_ls[Index(joints.end)] =
        glm::normalize(glm::conjugate(lower) * state.extremity_ws[Index(limb)]);
  }
  out = state.pose;
}

}  // namespace

void Adapt(const Body& avatar, const EgocentricPose& egocentric, const AdaptSettings& settings,
           Pose& out) {
  AdaptState state(avatar, egocentric, settings);  // section 6.1: root and captured joint angles
  const std::array<Quat, kLimbCount> captured_ws = state.extremity_ws;
  StandOnLegs(state);
  SumBody(state);
  InitializeArms(state);

  for (int round = 0; round < settings.main_iterations; ++round) {     // main loop
    for (int count = 1; count <= settings.limb_iterations; ++count) {  // limb loop
      const double w = static_cast<double>(count) / settings.limb_iterations;
      AdaptLimbs(state, w, true, captured_ws);
    }
    FoldBody(state);  // section 6.4
  }
  if (settings.restore_ends) AdaptLimbs(state, 1.0, false, captured_ws);
  KeepArmsClear(state);
  if (!settings.hands_keep_direction) {  // section 6.5
    for (const Limb limb : kLimbs) {
      state.extremity_ws[Index(limb)] =
          AlignExtremity(state, limb, state.extremity_ws[Index(limb)]);
    }
  }
  WritePose(state, out);
}

}  // namespace ego
