// SPDX-License-Identifier: MIT
#include "assets/motions/motion_player.h"

#include <algorithm>
#include <cmath>

#include "assets/motions/keyed_curve.h"
#include "core/geometry/closest_point.h"
#include "core/metrics/surface_gap.h"

namespace ego {
namespace {

using J = HumanoidJoint;

double Ease(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

Vec3 Sided(const Vec3& v, std::size_t side) { return side == 0 ? v : Vec3{-v.x, v.y, v.z}; }

/// How deep the capsules of an arm, the half of the upper arm at the shoulder aside, lie in trunk,
/// head and legs made thicker by `margin`, metres.
double ArmDepthAt(const MeasuredBody& body, std::size_t side, const Vec3& shoulder,
                  const Vec3& elbow, const Vec3& wrist, double margin) {
  const auto& radius = body.body->surface.limb_radius;
  const std::size_t upper = 2 * side;
  double deepest = 0.0;
  const auto probe = [&](const Vec3& p, double r) {
    double distance = std::min(TrunkDistance(body, p), HeadDistance(body, p));
    for (std::size_t s = 4; s < kSegmentCount; ++s) {
      const auto segment = static_cast<LimbSegment>(s);
      const Vec3& a = body.pose.Position(StartJoint(segment));
      const Vec3& b = body.pose.Position(EndJoint(segment));
      distance = std::min(distance,
                          glm::distance(p, glm::mix(a, b, ClosestOnSegment(p, a, b))) - radius[s]);
    }
    deepest = std::max(deepest, r + margin - distance);
  };
  for (const double t : {0.55, 0.75, 1.0}) probe(glm::mix(shoulder, elbow, t), radius[upper]);
  for (const double t : {0.25, 0.5, 0.75}) probe(glm::mix(elbow, wrist, t), radius[upper + 1]);
  return deepest;
}

/// Seconds that a channel goes before the hands.
constexpr double kHeadLead = 0.10;
constexpr double kHipsLead = 0.07;
constexpr double kSpineLead = 0.04;

bool TouchesOtherLimb(const EndGoal& goal, bool foot) {
  if (!goal.touches || !goal.place.other) return false;
  const BodyPart part = goal.place.part;
  const bool leg = part == BodyPart::kThigh || part == BodyPart::kCalf || part == BodyPart::kFoot;
  return leg == foot;
}

bool SamePart(const EndGoal& a, const EndGoal& b) {
  return a.touches && b.touches && a.place.part == b.place.part && a.place.other == b.place.other &&
         a.face == b.face;
}

using GoalNumbers = std::array<double, 12>;
/// What of a touch changes while it slides.
GoalNumbers SlidingNumbers(const EndGoal& g) {
  return {g.place.along, g.place.toward.x, g.place.toward.y, g.place.toward.z,
          g.pointing.x,  g.pointing.y,     g.pointing.z,     g.pole.x,
          g.pole.y,      g.pole.z,         g.tilt,           g.lift};
}
EndGoal WithSliding(EndGoal g, const GoalNumbers& n) {
  g.place.along = n[0];
  g.place.toward = {n[1], n[2], n[3]};
  g.pointing = {n[4], n[5], n[6]};
  g.pole = {n[7], n[8], n[9]};
  g.tilt = n[10];
  g.lift = n[11];
  return g;
}

using FootNumbers = std::array<double, 9>;
FootNumbers NumbersOf(const EndGoal& g) {
  Vec3 pole = g.pole;
  if (glm::length(pole) < 1e-6) {
    pole = {std::sin(Radians(g.turn)), 0.0, std::cos(Radians(g.turn))};
  }
  return {g.at.x, g.at.y, g.at.z, g.turn, g.heel, g.roll, pole.x, pole.y, pole.z};
}
EndGoal FootFrom(const FootNumbers& n) {
  EndGoal g;
  g.at = {n[0], n[1], n[2]};
  g.turn = n[3];
  g.heel = n[4];
  g.roll = n[5];
  g.pole = {n[6], n[7], n[8]};
  return g;
}

using ArmNumbers = std::array<double, 11>;
ArmNumbers NumbersOf(const ArmTarget& t, const Quat& near) {
  const Quat q = glm::dot(t.swing, near) < 0.0 ? -t.swing : t.swing;
  return {t.wrist.x, t.wrist.y, t.wrist.z, t.elbow.x, t.elbow.y, t.elbow.z,
          t.twist,   q.w,       q.x,       q.y,       q.z};
}

}  // namespace

MotionPlayer::MotionPlayer(const MotionFigure& figure, const MotionScript& script)
    : figure_(figure), script_(script), solver_(figure) {
  const Vec3& hips = figure.canonical()[Index(J::kHips)];
  for (const MotionKey& from : script.keys) {
    Key key{from.time, from.posture, hips + figure.leg_scale() * from.posture.root, {}, {}};
    if (from.posture.seat) {
      key.root_ws.y = figure.leg_scale() * *from.posture.seat +
                      figure.SeatHeight(RotationOf(from.posture.hips, 1.0));
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const EndGoal& hand = from.posture.hand[side];
      const EndGoal& foot = from.posture.foot[side];
      if (hand.touches) key.hand_skin[side] = figure.At(hand.place, side);
      if (foot.touches) key.foot_skin[side] = figure.At(foot.place, side);
    }
    keys_.push_back(std::move(key));
  }
  ClearElbows();
  FindContacts();
}

MotionPlayer::Span MotionPlayer::SpanAt(double time) const {
  const double now = std::clamp(time, 0.0, keys_.back().time);
  std::size_t k = 0;
  while (k + 2 < keys_.size() && now >= keys_[k + 1].time) ++k;
  const Key* first = &keys_[k];
  const Key* second = &keys_[std::min(k + 1, keys_.size() - 1)];
  return {
      {k > 0 ? &keys_[k - 1] : first, first, second, k + 2 < keys_.size() ? &keys_[k + 2] : second},
      now};
}

BodyGoals MotionPlayer::BodyAt(double time, Vec3& root_ws) const {
  const double duration = script_.Duration();
  // Leads fade at both ends, so that the motion begins and ends in its first and last key.
  const double lead = script_.lead * Ease(time / 0.4) * Ease((duration - time) / 0.4);
  const auto value = [&](double ahead, auto read) {
    const Span span = SpanAt(time + lead * ahead);
    KeyedCurve curve;
    curve.now = span.time;
    std::array<double, 4> values;
    for (std::size_t i = 0; i < 4; ++i) {
      curve.time[i] = span.key[i]->time;
      values[i] = read(*span.key[i]);
    }
    return curve.At(values);
  };
  const auto bend = [&](double ahead, auto which) {
    return Bend{value(ahead, [&](const Key& k) { return which(k.posture).pitch; }),
                value(ahead, [&](const Key& k) { return which(k.posture).yaw; }),
                value(ahead, [&](const Key& k) { return which(k.posture).roll; })};
  };
  BodyGoals posture;
  for (int i = 0; i < 3; ++i) {
    root_ws[i] = value(kHipsLead, [&](const Key& k) { return k.root_ws[i]; });
  }
  posture.hips = bend(kHipsLead, [](const BodyGoals& p) -> const Bend& { return p.hips; });
  posture.spine = bend(kSpineLead, [](const BodyGoals& p) -> const Bend& { return p.spine; });
  posture.head = bend(kHeadLead, [](const BodyGoals& p) -> const Bend& { return p.head; });
  for (std::size_t side = 0; side < 2; ++side) {
    posture.shoulder[side] =
        bend(kSpineLead, [&](const BodyGoals& p) -> const Bend& { return p.shoulder[side]; });
  }
  // Breath and the slow sway of standing, periodic over the whole motion.
  const double phase = 2.0 * kPi * time / duration;
  const double breath =
      script_.breath * std::sin(std::max(1.0, std::round(duration / 3.6)) * phase);
  const double sway = script_.breath * std::sin(std::max(1.0, std::round(duration / 5.0)) * phase);
  posture.spine.pitch -= 0.9 * breath;
  posture.head.pitch += 0.5 * breath;
  posture.head.yaw += 1.2 * sway;
  posture.shoulder[0].roll += 0.8 * breath;
  posture.shoulder[1].roll += 0.8 * breath;
  root_ws += figure_.leg_scale() * Vec3{0.005 * sway, -0.0008 * std::abs(breath) * breath, 0.0};
  return posture;
}

LegTarget MotionPlayer::LegAt(const Span& span, std::size_t side, const ModelPose& model) const {
  const auto goal = [&](std::size_t i) -> const EndGoal& {
    return span.key[i]->posture.foot[side];
  };
  KeyedCurve curve;
  curve.now = span.time;
  for (std::size_t i = 0; i < 4; ++i) curve.time[i] = span.key[i]->time;
  if (!goal(1).touches && !goal(2).touches) {
    const std::size_t before = goal(0).touches ? 1 : 0;
    const std::size_t after = goal(3).touches ? 2 : 3;
    curve.time[0] = curve.time[before];
    curve.time[3] = curve.time[after];
    return solver_.FreeFoot(
        FootFrom(curve.At(std::array{NumbersOf(goal(before)), NumbersOf(goal(1)),
                                     NumbersOf(goal(2)), NumbersOf(goal(after))})),
        side);
  }
  const auto target = [&](std::size_t i) {
    return goal(i).touches ? solver_.FootOnSkin(goal(i), span.key[i]->foot_skin[side], side, model)
                           : solver_.FreeFoot(FootFrom(NumbersOf(goal(i))), side);
  };
  const LegTarget a = target(1);
  if (goal(1) == goal(2)) return a;
  const LegTarget b = target(2);
  const double share = Ease((curve.now - curve.time[1]) / (curve.time[2] - curve.time[1]));
  LegTarget mixed;
  mixed.ankle = glm::mix(a.ankle, b.ankle, share);
  mixed.knee = glm::mix(a.knee, b.knee, share);
  mixed.foot = glm::slerp(a.foot, b.foot, share);
  mixed.toes = glm::slerp(a.toes, b.toes, share);
  return mixed;
}

ArmTarget MotionPlayer::ArmAt(const Span& span, std::size_t side, const ModelPose& model) const {
  const auto goal = [&](std::size_t i) -> const EndGoal& {
    return span.key[i]->posture.hand[side];
  };
  const auto target = [&](std::size_t i) {
    return solver_.TargetOf(goal(i), span.key[i]->hand_skin[side], side, model);
  };
  if (goal(1) == goal(2)) return target(1);
  KeyedCurve curve;
  curve.now = span.time;
  for (std::size_t i = 0; i < 4; ++i) curve.time[i] = span.key[i]->time;
  const bool slides = goal(2).slide && SamePart(goal(1), goal(2));
  // A hand rests on the skin when it comes and before it goes.
  const bool through1 = slides ? goal(1).slide && SamePart(goal(0), goal(1)) : !goal(1).touches;
  const bool through2 = slides ? goal(3).slide && SamePart(goal(2), goal(3)) : !goal(2).touches;
  const std::size_t before = through1 ? 0 : 1;
  const std::size_t after = through2 ? 3 : 2;
  curve.time[0] = curve.time[before];
  curve.time[3] = curve.time[after];
  if (slides) {
    const EndGoal now = WithSliding(
        goal(1), curve.At(std::array{SlidingNumbers(goal(before)), SlidingNumbers(goal(1)),
                                     SlidingNumbers(goal(2)), SlidingNumbers(goal(after))}));
    return solver_.TargetOf(now, figure_.At(now.place, side), side, model);
  }
  const ArmTarget a = target(1);
  const ArmTarget b = target(2);
  const ArmNumbers n =
      curve.At(std::array{NumbersOf(before == 0 ? target(0) : a, a.swing), NumbersOf(a, a.swing),
                          NumbersOf(b, a.swing), NumbersOf(after == 3 ? target(3) : b, a.swing)});
  ArmTarget mixed;
  mixed.wrist = {n[0], n[1], n[2]};
  mixed.elbow = {n[3], n[4], n[5]};
  mixed.twist = n[6];
  mixed.swing = glm::normalize(Quat{n[7], n[8], n[9], n[10]});
  // Around the body, and off the skin before moving along it.
  const double share = Ease((curve.now - curve.time[1]) / (curve.time[2] - curve.time[1]));
  const double middle = 4.0 * share * (1.0 - share);
  const Vec3 up = model.Rotation(J::kChest) * kUp;
  Vec3 out = mixed.wrist - model.Position(J::kChest);
  out -= up * glm::dot(out, up);
  out /= std::max(glm::length(out), 0.05);
  mixed.wrist += middle * glm::distance(a.wrist, b.wrist) *
                 (goal(2).arc * out + 0.3 * glm::mix(a.away, b.away, share));
  return mixed;
}

Pose MotionPlayer::BodyPose(const BodyGoals& body, const Vec3& root_ws) const {
  Pose pose = CanonicalPose(figure_.body().skeleton);
  pose.root_ws = root_ws;
  pose.rotation_ls[Index(J::kHips)] = RotationOf(body.hips, 1.0);
  for (const J joint : {J::kSpine, J::kChest, J::kUpperChest}) {
    pose.rotation_ls[Index(joint)] = RotationOf(body.spine, 1.0 / 3.0);
  }
  pose.rotation_ls[Index(J::kNeck)] = RotationOf(body.head, 0.4);
  pose.rotation_ls[Index(J::kHead)] = RotationOf(body.head, 0.6);
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const Bend& clavicle = body.shoulder[side];
    pose.rotation_ls[Index(side == 0 ? J::kLeftShoulder : J::kRightShoulder)] =
        glm::angleAxis(Radians(-sign * clavicle.pitch), kUp) *
        glm::angleAxis(Radians(sign * clavicle.roll), Vec3{0.0, 0.0, 1.0});
  }
  return pose;
}

Pose MotionPlayer::At(double time) const {
  Vec3 root_ws{0.0};
  const BodyGoals body = BodyAt(time, root_ws);
  Pose pose = BodyPose(body, root_ws);
  const Span span = SpanAt(time);
  const auto second = [&](bool foot, std::size_t side) {
    return std::any_of(span.key.begin(), span.key.end(), [&](const Key* key) {
      return TouchesOtherLimb(foot ? key->posture.foot[side] : key->posture.hand[side], foot);
    });
  };
  // What is touched is placed first: legs before arms, a limb that touches its partner last.
  for (const bool foot : {true, false}) {
    const std::size_t last = second(foot, 0) ? 0 : 1;
    for (const std::size_t side : {1 - last, last}) {
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      if (foot) {
        solver_.PlaceLeg(side, LegAt(span, side, model), model, pose);
      } else {
        solver_.PlaceArm(side, ArmAt(span, side, model), model, pose);
      }
    }
  }
  for (Quat& q : pose.rotation_ls) {
    q = glm::normalize(q);
    if (q.w < 0.0) q = -q;
  }
  return pose;
}

void MotionPlayer::ClearElbows() {
  // The crude surfaces lie a little within the skin.
  constexpr double kMargin = 0.012;
  constexpr double kTurn = 8.0;  // degrees
  constexpr int kTurns = 10;
  std::array<EndGoal, 2> written_first;
  std::array<EndGoal, 2> written_before;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    Key& key = keys_[k];
    Pose pose = BodyPose(key.posture, key.root_ws);
    const Span span{{&key, &key, &key, &key}, key.time};
    const std::size_t last_leg = TouchesOtherLimb(key.posture.foot[0], true) ? 0 : 1;
    for (const std::size_t side : {1 - last_leg, last_leg}) {
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      solver_.PlaceLeg(side, LegAt(span, side, model), model, pose);
    }
    const std::size_t last_arm = TouchesOtherLimb(key.posture.hand[0], false) ? 0 : 1;
    for (const std::size_t side : {1 - last_arm, last_arm}) {
      EndGoal& goal = key.posture.hand[side];
      const EndGoal written = goal;
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      if (k == 0) written_first[side] = written;
      if (k > 0 && k + 1 == keys_.size() && written == written_first[side]) {
        goal.pole = keys_[0].posture.hand[side].pole;  // ends in the stance it began in
      } else if (k > 0 && written == written_before[side]) {
        goal.pole = keys_[k - 1].posture.hand[side].pole;  // a hold stays one
      } else {
        const ArmTarget target = ArmAt(span, side, model);
        const MeasuredBody measured(figure_.body(), pose);
        const Vec3 shoulder = model.Position(side == 0 ? J::kLeftUpperArm : J::kRightUpperArm);
        const Vec3 axis = glm::normalize(target.wrist - shoulder);
        double best_cost = 1e9;
        for (int i = -kTurns; i <= kTurns; ++i) {
          const Quat turn = glm::angleAxis(Radians(kTurn * i), axis);
          const Vec3 pole = turn * target.elbow;
          const double depth =
              ArmDepthAt(measured, side, shoulder, solver_.ElbowOf(side, target.wrist, pole, model),
                         target.wrist, kMargin);
          const double cost = depth + 0.0004 * std::abs(i) * (1.0 + 0.2 * std::abs(i));
          if (cost >= best_cost) continue;
          best_cost = cost;
          const Vec3 in_chest = glm::conjugate(model.Rotation(J::kUpperChest)) * pole;
          goal.pole = i == 0 ? written.pole : Sided(in_chest, side);
        }
      }
      written_before[side] = written;
      solver_.PlaceArm(side, ArmAt(span, side, model), model, pose);
    }
  }
}

void MotionPlayer::FindContacts() {
  for (const bool foot : {false, true}) {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto goal = [&](std::size_t i) -> const EndGoal& {
        return foot ? keys_[i].posture.foot[side] : keys_[i].posture.hand[side];
      };
      const auto on_skin = [&](std::size_t i) { return goal(i).touches && goal(i).lift == 0.0; };
      for (std::size_t i = 0; i < keys_.size(); ++i) {
        if (!on_skin(i)) continue;
        TrueContact contact;
        contact.side = side;
        contact.foot = foot;
        contact.face = goal(i).face;
        const J of = foot ? J::kLeftFoot : J::kLeftHand;
        contact.of = side == 0 ? of : Mirror(of);
        contact.on = MotionFigure::JointOf(goal(i).place, side);
        contact.from_s = keys_[i].time;
        contact.places.push_back({keys_[i].time, goal(i).place});
        while (i + 1 < keys_.size() && on_skin(i + 1) &&
               (goal(i + 1) == goal(i) || (goal(i + 1).slide && SamePart(goal(i), goal(i + 1))))) {
          ++i;
          contact.places.push_back({keys_[i].time, goal(i).place});
        }
        contact.to_s = keys_[i].time;
        contacts_.push_back(std::move(contact));
      }
    }
  }
  std::stable_sort(contacts_.begin(), contacts_.end(),
                   [](const TrueContact& a, const TrueContact& b) { return a.from_s < b.from_s; });
}

}  // namespace ego
