// SPDX-License-Identifier: MIT
#include "core/adapt/arm_clearance.h"

#include <algorithm>
#include <cmath>

#include "core/adapt/arm_solve.h"
#include "core/egocentric/clearance.h"
#include "core/geometry/rotation.h"
#include "core/geometry/smooth.h"

namespace ego {
namespace {

/// Weights of a touching hand point, against 1 of an arm sample; hands that touch each other give
/// rows for both, and their surfaces are curved more: a softer pull, or they shiver.
constexpr double kContactWeight = 14.0;
constexpr double kMutualWeight = 3.0;
constexpr double kHandWeight = 2.0;     // of a hand point in trunk or head
constexpr double kHandMargin = 0.004;   // metres: how near it may come where the performer's is far
constexpr double kAnchorWeight = 10.0;  // of the wrist's place while the arm gives way
constexpr double kContactDamping = 0.5;  // that a contact's weight is measured against

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
/// Cosine of both ways from which on a contact counts whole from inside, and heights inside below
/// which it does in any case.
constexpr double kSameSide = 0.5;
constexpr double kInside = 0.02;
/// The performer's clearance, in heights, from which on it counts as ample, and is: below where
/// `MeasureClearance` begins not to know it, which depends on how the body is turned.
constexpr double kNearlyFar = 0.025;
constexpr double kFar = 0.045;
/// In heights: how much less the smooth distance to trunk or head may be than that to their box,
/// seen from where their faces meet at a sharp angle.
constexpr double kBeyondBox = 0.03;
/// Length of a gradient above which one way begins to lead out: where faces that look different
/// ways are equally near, it is short.
constexpr double kOneWay = 0.8;

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

/// Way out over that pull below which it is undecided and counts less.
constexpr double kUndecided = 1.5;

struct CapsuleMeasure {
  SignedDistance at;
  Vec3 on_axis{0.0};   // the point of the axis that is met
  double trust = 1.0;  // 0 where no way leads out
};

/// The same for a capsule. False where it is farther than `horizon`.
bool MeasureCapsule(const AdaptState& state, const CapsuleObstacle& obstacle,
                    const ArmSample& sample, const Vec3& side_ls, double horizon,
                    CapsuleMeasure& out) {
  // Along any direction the distance is less than the length, so `horizon` rejects safely.
  const double filled = obstacle.capsule->radius + sample.radius;
  const double nudge = Nudge(state);
  const double far = filled + horizon + 2.0 * nudge;
  if (obstacle.IsFartherThan(far, sample.center)) return false;
  const Vec3 from_axis = obstacle.FromAxis(sample.center);
  if (glm::dot(from_axis, from_axis) > far * far) return false;
  // The performer's side of the obstacle decides where the avatar's lies deep inside.
  const Vec3 side = obstacle.capsule->frame * side_ls;
  const Vec3 way = from_axis + nudge * side;
  out.at.gradient = NormalizedOr(way, side);
  out.trust = Smoothstep(glm::length(way) / (kUndecided * nudge));
  out.at.distance = glm::dot(out.at.gradient, from_axis) - filled;
  out.on_axis = sample.center - from_axis;
  return true;
}

/// Clearance that is kept of the performer's own, `clearance` in heights: all of it where there is
/// little, the whole margin where there is as much as need not be known.
double Need(double clearance, double height, double margin) {
  if (clearance <= 0.0) return clearance * height;
  const double kept = -std::expm1(-clearance * height / margin);
  return margin * glm::mix(kept, 1.0, Smoothstep((clearance - kNearlyFar) / (kFar - kNearlyFar)));
}

/// Whether a way out of trunk or head is the performer's own, `along` their cosine: 0 to 1.
double Decided(double along) { return Smoothstep((along - kSameWay) / (1.0 - kSameWay)); }

/// Share of what a contact wants, `wanted` in heights out of the obstacle, that is asked for.
double ContactShare(double wanted, double decided) {
  const double bounded = Bounded(wanted / kFarContact);
  if (wanted <= 0.0) return bounded;
  return glm::mix(bounded * bounded, Bounded(wanted / (kDecidedContact * kFarContact)), decided);
}

/// Share of a contact whose point lies `wanted` heights inside: none where the nearest way leads
/// out on another side than the performer's.
double SameSide(double wanted, double along) {
  return glm::mix(1.0, Smoothstep(along / kSameSide), Smoothstep(wanted / kInside));
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

/// Upper arm and elbow, forearm, points of contact: where their samples begin.
constexpr std::size_t kPartCount = 3;
constexpr std::array<std::size_t, kPartCount + 1> kPartBegin = {0, 3, kFirstContactSample,
                                                                kClearanceSampleCount};

/// From which obstacles all samples of a part are too far to be asked anything, or asked to touch.
std::array<std::array<bool, kObstacleCount>, kPartCount> FarFrom(
    const AdaptState& state, const BodyObstacles& body, const CapsuleObstacles& capsules, Limb arm,
    const ArmSamples& samples, double margin, double fade) {
  const double height = state.avatar.height;
  std::array<std::array<bool, kObstacleCount>, kPartCount> far;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    const SampleBall ball(samples, kPartBegin[part], kPartBegin[part + 1]);
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      far[part][o] =
          o < kFirstCapsuleObstacle
              ? body.LowerBound(o, {ball.center, ball.reach}) > margin + kBeyondBox * height
              : ball.IsFartherThan(margin + 2.0 * Nudge(state),
                                   capsules[o - kFirstCapsuleObstacle]);
    }
  }
  for (std::size_t s = kFirstContactSample; s < kClearanceSampleCount; ++s) {
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      const Clearance& performer = state.egocentric.clearance[Index(arm)][s][o];
      if (performer.known && performer.distance * height < fade) far[2][o] = false;
    }
  }
  return far;
}

ArmSolve::Part PartOf(std::size_t sample) {
  if (sample < 3) return ArmSolve::Part::kUpperArm;
  return sample <= kFirstContactSample ? ArmSolve::Part::kForearm : ArmSolve::Part::kHand;
}

/// The part of the other arm that an obstacle is; kUpperArm for all that is none.
ArmSolve::Part PartOfOther(std::size_t obstacle) {
  if (obstacle == kObstacleCount - 1) return ArmSolve::Part::kHand;
  return obstacle == kFirstCapsuleObstacle + 1 ? ArmSolve::Part::kForearm
                                               : ArmSolve::Part::kUpperArm;
}

/// What one arm's samples, or its contacts alone, want of the obstacles, as rows of `solve`.
/// Returns the largest share of a contact.
double AskForArm(const AdaptState& state, const BodyObstacles& body, Limb arm, MeshMemory& memory,
                 bool contacts_alone, ArmSolve& solve) {
  ArmSamples samples;
  for (std::size_t s = 0; s < kClearanceSampleCount; ++s) {
    samples[s] = SampleOf(state.avatar, state.posed, arm, s);
  }
  const double height = state.avatar.height;
  const double arm_margin = state.scale * state.settings.clearance_margin;
  const double fade = state.scale * state.settings.contact_fade;
  const CapsuleObstacles capsules = CapsuleObstaclesOf(state.posed, arm);
  const std::array<std::array<bool, kObstacleCount>, kPartCount> is_far =
      FarFrom(state, body, capsules, arm, samples, arm_margin, fade);
  const std::size_t count =
      state.egocentric.form.hand_points ? kClearanceSampleCount : kFirstContactSample + 1;
  double most_touching = 0.0;
  for (std::size_t s = contacts_alone ? kFirstContactSample : 0; s < count; ++s) {
    const ArmSample& sample = samples[s];
    const ArmSolve::Point point{arm, PartOf(s), sample.center};
    const bool of_hand = s >= kFirstContactSample;
    for (std::size_t o = 0; o < kObstacleCount; ++o) {
      if (is_far[s < 3 ? 0 : of_hand ? 2 : 1][o]) continue;
      const Clearance& performer = state.egocentric.clearance[Index(arm)][s][o];
      const double clearance = performer.distance * height;
      const bool other_hand = o == kObstacleCount - 1;
      const bool other_arm =
          o == kFirstCapsuleObstacle || o == kFirstCapsuleObstacle + 1 || other_hand;
      const double touching = of_hand && performer.known && clearance < fade
                                  ? performer.trust * (1.0 - Smoothstep(clearance / fade))
                                  : 0.0;
      most_touching = std::max(most_touching, touching);
      // Far from an obstacle nothing can be asked: most samples of most postures.
      // A hand in trunk or head is seen at once, and may touch them where its own place is too far.
      const bool hand_in_body = of_hand && o < kFirstCapsuleObstacle;
      const double margin = hand_in_body ? kHandMargin * state.scale : arm_margin;
      const double most = performer.known ? std::min(clearance, margin) : margin;
      SignedDistance now;
      CapsuleMeasure capsule;
      if (o < kFirstCapsuleObstacle) {
        if (touching == 0.0 && body.LowerBound(o, sample) > most + kBeyondBox * height) continue;
        if (!MeasureMesh(body, o, sample, touching > 0.0, memory.entry[s][o], now)) continue;
      } else if (!MeasureCapsule(state, capsules[o - kFirstCapsuleObstacle], sample,
                                 performer.direction_ls, touching > 0.0 ? 10.0 * height : most,
                                 capsule)) {
        continue;
      } else {
        now = capsule.at;
      }
      const auto ask = [&](double value, double weight) {
        if (other_arm) {
          solve.AskApart(point, {Mirror(arm), PartOfOther(o), capsule.on_axis}, now.gradient, value,
                         capsule.trust * weight);
        } else {
          solve.Ask(point, now.gradient, value, capsule.trust * weight);
        }
      };
      if (touching > 0.0) {
        // A share `touching` of the way, whatever the damping.
        const double most_weight = other_hand ? kMutualWeight : kContactWeight;
        const double pull =
            kContactDamping * touching / (1.0 - touching + kContactDamping / most_weight);
        const double wanted = clearance - now.distance;
        // Only where it really touches.
        double decided = 0.0;
        double same_side = 1.0;
        if (o < kFirstCapsuleObstacle) {
          const double along = glm::dot(now.gradient, state.posed.hips * performer.direction_ls);
          decided = touching * touching * memory.entry[s][o].one_way * Decided(along);
          same_side = SameSide(wanted / height, along);
        }
        ask(wanted * ContactShare(wanted / height, decided), same_side * pull);
      }
      if ((contacts_alone && o >= kFirstCapsuleObstacle) || now.distance >= most) continue;
      const double short_of =
          (performer.known ? Need(performer.distance, height, margin) : margin) - now.distance;
      const double weight = performer.trust * (hand_in_body ? kHandWeight : 1.0) *
                            Smoothstep(short_of / ((hand_in_body ? 1.0 : 2.0) * kDeep * height)) *
                            Bounded(short_of / (kDeep * height));
      if (weight > 0.0) ask(short_of, weight);
    }
  }
  return most_touching;
}

/// How much the wrist stays while the arm gives way: the more the closer it is to a surface, but
/// for what it touches itself.
double HoldOf(const AdaptState& state, Limb arm, double touching) {
  const double gap = 1.0 / std::max(1e-9, state.egocentric.point[Index(EndPoint(arm))].priority);
  const double near = 0.02 / 1.78 / (0.02 / 1.78 + gap);
  return kAnchorWeight * near * near * (1.0 - touching);
}

}  // namespace

void KeepArmsClear(AdaptState& state) {
  if (!state.egocentric.form.clearance || state.settings.clearance_steps <= 0) return;
  const BodyObstacles body(state.avatar, state.posed);
  std::array<MeshMemory, 2> memory;
  constexpr std::array<Limb, 2> kArms = {Limb::kLeftArm, Limb::kRightArm};
  const int steps = state.settings.clearance_steps + state.settings.contact_steps;
  for (int step = 0; step < steps; ++step) {
    ArmSolve solve(state);
    std::array<double, 2> touching;
    for (const Limb arm : kArms) {
      touching[Index(arm)] = AskForArm(state, body, arm, memory[Index(arm)],
                                       step >= state.settings.clearance_steps, solve);
    }
    if (solve.empty()) return;
    for (const Limb arm : kArms) solve.HoldWrist(arm, HoldOf(state, arm, touching[Index(arm)]));
    const std::array<ArmSolve::Move, 2> move = solve.Solve();
    for (const Limb arm : kArms) {
      state.extremity_ws[Index(arm)] = move[Index(arm)].hand_ws;
      state.Apply(arm, move[Index(arm)].posture);
    }
  }
}

}  // namespace ego
