// SPDX-License-Identifier: MIT
#include "core/adapt/arm_clearance.h"

#include <algorithm>
#include <cmath>

#include "core/egocentric/clearance.h"
#include "core/geometry/rotation.h"
#include "core/geometry/small_solve.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

constexpr double kContactWeight = 10.0;  // of a touching hand point, against 1 of an arm sample
// Two hands that touch each other move against each other: a softer pull, or they shiver.
constexpr double kMutualWeight = 0.6;
constexpr double kHandMoveDamping = 0.5;  // in the same unit
constexpr double kHandTurnDamping = 1.0;  // likewise, about the length of a hand
constexpr double kArmDamping = 1.0;       // likewise, about the length of an arm
constexpr double kAnchorWeight = 10.0;    // of the wrist's place while the arm gives way
constexpr double kArmStep = 0.15;         // radians a step can hardly exceed
constexpr double kHandStep = 0.30;

/// In heights. What lies deeper than the first, and a contact farther off than the second, counts
/// less and less: which way leads out is undecided deep inside, and arms that do not fit between
/// the parts of a thick body are not to be thrown from one to the other. From inside contacts count
/// even less: the way out turns over where faces are equally near.
constexpr double kDeep = 0.02;
constexpr double kFarContact = 0.03;
double Bounded(double x) { return 1.0 / (1.0 + x * x); }
/// Where one way leads out of trunk or head and it is the performer's own, it does not turn over:
/// from inside a contact then counts this much farther instead.
constexpr double kDecidedContact = 1.25;
/// Cosine of both ways above which they begin to count as the same.
constexpr double kSameWay = 0.5;
/// Length of a gradient above which one way begins to lead out: where faces that look different
/// ways are equally near, it is short.
constexpr double kOneWay = 0.8;

/// A wish of one sample: to move by `value` metres along `normal`.
struct Row {
  std::size_t sample;
  Vec3 normal;
  double value;
  double weight;
};
struct Rows {
  // Filled up to `count`; the rest is never touched.
  std::array<Row, 2 * kClearanceSampleCount * kObstacleCount> row;
  std::size_t count = 0;
  void Add(const Row& wish) { row[count++] = wish; }
};

using ArmSamples = std::array<ArmSample, kClearanceSampleCount>;

/// Distances of one arm's samples to trunk and head as first measured. The corrections are small:
/// later steps follow the gradient, but for the points of contact, which are measured again.
struct MeshMemory {
  struct Entry {
    SignedDistance at;
    Vec3 center{0.0};
    double one_way = 0.0;  // 1 where the gradient says which way leads out
    bool measured = false;
  };
  std::array<std::array<Entry, 2>, kClearanceSampleCount> entry;
};

/// Signed distance of a sample to trunk or head and the way out. False where it is far.
bool MeasureMesh(const BodyObstacles& body, std::size_t obstacle, const ArmSample& sample,
                 bool anew, MeshMemory::Entry& memory, SignedDistance& out) {
  if (anew || !memory.measured) {
    if (!body.Distance(obstacle, sample, memory.at)) return false;
    memory.one_way = Smoothstep((glm::length(memory.at.gradient) - kOneWay) / (1.0 - kOneWay));
    memory.at.gradient = NormalizedOr(memory.at.gradient, Vec3{0.0});
    memory.center = sample.center;
    memory.measured = true;
  }
  out = memory.at;
  out.distance += glm::dot(out.gradient, sample.center - memory.center);
  return true;
}

/// How far the performer's side pulls at a direction out of a capsule, metres.
double Nudge(const AdaptState& state) { return 0.015 * state.scale; }

/// The same for a capsule. False where it is farther than `horizon`.
bool MeasureCapsule(const AdaptState& state, const CapsuleObstacle& obstacle,
                    const ArmSample& sample, const Vec3& side_ls, double horizon,
                    SignedDistance& out) {
  // Along any direction the distance is less than the length, so `horizon` rejects safely.
  const double filled = obstacle.capsule->radius + sample.radius;
  const double nudge = Nudge(state);
  const double far = filled + horizon + 2.0 * nudge;
  if (obstacle.IsFartherThan(far, sample.center)) return false;
  const Vec3 from_axis = obstacle.FromAxis(sample.center);
  if (glm::dot(from_axis, from_axis) > far * far) return false;
  // The performer's side of the obstacle decides where the avatar's lies deep inside.
  const Vec3 side = obstacle.capsule->frame * side_ls;
  out.gradient = NormalizedOr(from_axis + nudge * side, side);
  out.distance = glm::dot(out.gradient, from_axis) - filled;
  return true;
}

/// Clearance that is kept of the performer's own: all of it where there is little.
double Need(double clearance, double margin) {
  return clearance <= 0.0 ? clearance : margin * -std::expm1(-clearance / margin);
}

/// Whether the way out of trunk or head, `gradient`, is the performer's own: 0 to 1.
double Decided(const AdaptState& state, const Clearance& performer, const Vec3& gradient) {
  const double along = glm::dot(gradient, state.posed.hips * performer.direction_ls);
  return Smoothstep((along - kSameWay) / (1.0 - kSameWay));
}

/// Share of what a contact wants, `wanted` in heights out of the obstacle, that is asked for.
double ContactShare(double wanted, double decided) {
  const double bounded = Bounded(wanted / kFarContact);
  if (wanted <= 0.0) return bounded;
  return glm::mix(bounded * bounded, Bounded(wanted / (kDecidedContact * kFarContact)), decided);
}

/// Some samples of an arm in one ball, to leave out together what is far from all of them.
struct SampleBall {
  SampleBall(const ArmSamples& samples, std::size_t first, std::size_t end)
      : center(0.5 * (samples[first].center + samples[end - 1].center)) {
    for (std::size_t s = first; s < end; ++s) {
      reach = std::max(reach, glm::distance(center, samples[s].center) + samples[s].radius);
    }
  }
  bool IsFartherThan(double distance, const CapsuleObstacle& obstacle) const {
    return obstacle.IsFartherThan(reach + obstacle.capsule->radius + distance, center);
  }
  Vec3 center;
  double reach = 0.0;
};

void CollectRows(const AdaptState& state, const BodyObstacles& body, Limb arm,
                 const ArmSamples& samples, MeshMemory& memory, Rows& rows) {
  const double height = state.avatar.height;
  const double margin = state.scale * state.settings.clearance_margin;
  const double fade = state.scale * state.settings.contact_fade;
  const CapsuleObstacles capsules = CapsuleObstaclesOf(state.posed, arm);
  // Upper arm and elbow, then forearm and hand.
  const std::array<SampleBall, 2> ball = {SampleBall(samples, 0, 3),
                                          SampleBall(samples, 3, kClearanceSampleCount)};
  std::array<std::array<bool, kObstacleCount>, 2> is_far{};
  for (std::size_t b = 0; b < ball.size(); ++b) {
    for (std::size_t o = kFirstCapsuleObstacle; o < kObstacleCount; ++o) {
      is_far[b][o] =
          ball[b].IsFartherThan(margin + 2.0 * Nudge(state), capsules[o - kFirstCapsuleObstacle]);
    }
  }
  const std::size_t count =
      state.egocentric.form.hand_points ? kClearanceSampleCount : kFirstContactSample + 1;
  for (std::size_t s = 0; s < count; ++s) {
    const ArmSample& sample = samples[s];
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      const bool of_hand = s >= kFirstContactSample;
      if (!of_hand && is_far[s < 3 ? 0 : 1][o]) continue;
      const Clearance& performer = state.egocentric.clearance[Index(arm)][s][o];
      const double clearance = performer.distance * height;
      const bool other_hand = o == kObstacleCount - 1;
      // Both arms move when one is in the other's way.
      const bool other_arm = o == 2 || o == 3 || other_hand;
      const double share = other_arm ? 0.5 : 1.0;
      const double touching = of_hand && performer.known && clearance < fade
                                  ? performer.trust * (1.0 - Smoothstep(clearance / fade))
                                  : 0.0;
      // Far from an obstacle nothing can be asked: most samples of most postures.
      const double most = performer.known ? std::min(clearance, margin) : margin;
      SignedDistance now;
      if (o < kFirstCapsuleObstacle) {
        if (touching == 0.0 && body.LowerBound(o, sample) > most + 0.01 * height) continue;
        if (!MeasureMesh(body, o, sample, touching > 0.0, memory.entry[s][o], now)) continue;
      } else if (!MeasureCapsule(state, capsules[o - kFirstCapsuleObstacle], sample,
                                 performer.direction_ls, touching > 0.0 ? 10.0 * height : most,
                                 now)) {
        continue;
      }
      if (touching > 0.0) {
        // A share `touching` of the way, whatever the damping.
        const double most_weight = other_hand ? kMutualWeight : kContactWeight;
        const double pull =
            kHandMoveDamping * touching / (1.0 - touching + kHandMoveDamping / most_weight);
        const double wanted = clearance - now.distance;
        // Only where it really touches.
        const double decided = o < kFirstCapsuleObstacle
                                   ? touching * touching * memory.entry[s][o].one_way *
                                         Decided(state, performer, now.gradient)
                                   : 0.0;
        rows.Add({s, now.gradient, share * wanted * ContactShare(wanted / height, decided), pull});
      }
      if (now.distance >= most) continue;
      const double short_of = (performer.known ? Need(clearance, margin) : margin) - now.distance;
      const double weight = performer.trust * Smoothstep(short_of / (0.04 * height)) *
                            Bounded(short_of / (kDeep * height));
      if (weight > 0.0) rows.Add({s, now.gradient, share * short_of, weight});
    }
  }
}

struct ArmMove {
  LimbPosture posture;
  Quat hand_ws = kIdentity;
};

/// Move and turn of a hand about its wrist that its rows ask for.
struct HandMove {
  Vec3 move{0.0};
  Vec3 turn{0.0};
};
HandMove MoveHand(const AdaptState& state, Limb arm, const ArmSamples& samples, const Rows& rows) {
  const bool can_turn = !state.avatar.skeleton.locked[Index(JointsOf(arm).end)];
  const double length =
      std::max(0.05 * state.scale, state.constants.bone_length[HandBone(FingertipPoint(arm))]);
  const Vec3& wrist = state.posed.point[Index(EndPoint(arm))];
  NormalEquations<6> equations;
  for (std::size_t k = 0; k < 3; ++k) equations.Damp(k, kHandMoveDamping);
  for (std::size_t k = 3; k < 6; ++k) equations.Damp(k, kHandTurnDamping * length * length);
  for (std::size_t k = 0; k < rows.count; ++k) {
    const Row& row = rows.row[k];
    if (row.sample + 1 < kFirstContactSample) continue;  // the arm's own
    const Vec3 arm_of = samples[row.sample].center - wrist;
    const Vec3 turn = can_turn ? glm::cross(arm_of, row.normal) : Vec3{0.0};
    equations.Add({row.normal.x, row.normal.y, row.normal.z, turn.x, turn.y, turn.z}, row.value,
                  row.weight);
  }
  const std::array<double, 6> x = equations.Solve();
  Vec3 turn{x[3], x[4], x[5]};
  turn /= std::sqrt(1.0 + glm::dot(turn, turn) / (kHandStep * kHandStep));
  return {{x[0], x[1], x[2]}, turn};
}

ArmMove MoveArm(const AdaptState& state, Limb arm, const ArmSamples& samples, const Rows& rows) {
  const LimbChain& chain = state.chain[Index(arm)];
  const LimbPosture& posture = state.limb[Index(arm)];
  const LimbPlacement placed = Place(chain, posture);
  const HandMove hand = MoveHand(state, arm, samples, rows);

  const Vec3 axis_ls = MeasureFlexion(chain, posture.mid).axis_ls;
  const Vec3 hinge = placed.base_ws * axis_ls;
  const double reach = chain.Reach();
  NormalEquations<4> equations;
  for (std::size_t k = 0; k < 4; ++k) equations.Damp(k, kArmDamping * reach * reach + 1e-12);
  const auto add = [&](const Vec3& point, bool beyond_elbow, const Vec3& normal, double value,
                       double weight) {
    const Vec3 turn = chain.base_locked ? Vec3{0.0} : glm::cross(point - chain.base_ws, normal);
    const double flex = beyond_elbow && !chain.mid_locked
                            ? glm::dot(hinge, glm::cross(point - placed.mid, normal))
                            : 0.0;
    equations.Add({turn.x, turn.y, turn.z, flex}, value, weight);
  };
  double anchor = 0.0;
  for (std::size_t k = 0; k < rows.count; ++k) {
    const Row& row = rows.row[k];
    if (row.sample >= kFirstContactSample) {
      anchor = std::max(anchor, row.weight);
      continue;  // through the wrist
    }
    add(samples[row.sample].center, row.sample >= 3, row.normal, row.value, row.weight);
  }
  // The wrist stays, the more so the closer the hand is to a contact of its own.
  const double gap = 1.0 / std::max(1e-9, state.egocentric.point[Index(EndPoint(arm))].priority);
  const double near = 0.02 / 1.78 / (0.02 / 1.78 + gap);
  const double weight = std::max(kAnchorWeight * near * near, anchor);
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 axis{0.0};
    axis[static_cast<int>(k)] = 1.0;
    add(placed.end, true, axis, hand.move[static_cast<int>(k)], weight);
  }
  const std::array<double, 4> x = equations.Solve();
  double square = 0.0;
  for (const double v : x) square += v * v;
  const double shrink = 1.0 / std::sqrt(1.0 + square / (kArmStep * kArmStep));

  ArmMove move;
  move.posture = posture;
  const Quat turn = FromRotationVector(shrink * Vec3{x[0], x[1], x[2]});
  move.posture.base = glm::normalize(glm::conjugate(chain.frame_ws) * turn * placed.base_ws);
  move.posture.mid = glm::normalize(FromRotationVector(shrink * x[3] * axis_ls) * posture.mid);
  move.hand_ws = glm::normalize(FromRotationVector(hand.turn) * state.extremity_ws[Index(arm)]);
  return move;
}

}  // namespace

void KeepArmsClear(AdaptState& state) {
  if (!state.egocentric.form.clearance || state.settings.clearance_steps <= 0) return;
  const BodyObstacles body(state.avatar, state.posed);
  std::array<MeshMemory, 2> memory;
  for (int step = 0; step < state.settings.clearance_steps; ++step) {
    std::array<ArmMove, 2> move;
    bool any = false;
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      ArmSamples samples;
      for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
        samples[s] = SampleOf(state.avatar, state.posed, arm, s);
      }
      Rows rows;
      CollectRows(state, body, arm, samples, memory[Index(arm)], rows);
      move[Index(arm)] = {state.limb[Index(arm)], state.extremity_ws[Index(arm)]};
      if (rows.count == 0) continue;
      move[Index(arm)] = MoveArm(state, arm, samples, rows);
      any = true;
    }
    if (!any) return;
    for (const Limb arm : {Limb::kLeftArm, Limb::kRightArm}) {
      state.extremity_ws[Index(arm)] = move[Index(arm)].hand_ws;
      state.Apply(arm, move[Index(arm)].posture);
    }
  }
}

}  // namespace ego
