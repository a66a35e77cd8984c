// SPDX-License-Identifier: MIT
#include "assets/motions/motion_player.h"

#include <algorithm>
#include <cmath>

#include "assets/motions/keyed_curve.h"

namespace ego {
namespace {

using J = HumanoidJoint;

double Ease(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

/// Seconds that a channel goes before the hands.
constexpr double kHeadLead = 0.10;
constexpr double kHipsLead = 0.07;
constexpr double kSpineLead = 0.04;

using GoalNumbers = std::array<double, 13>;
/// What of a touch changes while it slides.
GoalNumbers SlidingNumbers(const EndGoal& g) {
  return {g.place.along, g.place.toward.x, g.place.toward.y, g.place.toward.z,
          g.pointing.x,  g.pointing.y,     g.pointing.z,     g.pole.x,
          g.pole.y,      g.pole.z,         g.tilt,           g.lift,
          g.lean};
}
EndGoal WithSliding(EndGoal g, const GoalNumbers& n) {
  g.place.along = n[0];
  g.place.toward = {n[1], n[2], n[3]};
  g.pointing = {n[4], n[5], n[6]};
  g.pole = {n[7], n[8], n[9]};
  g.tilt = n[10];
  g.lift = n[11];
  g.lean = n[12];
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

bool MotionPlayer::SamePart(const EndGoal& a, const EndGoal& b) {
  return a.touches && b.touches && a.place.part == b.place.part && a.place.other == b.place.other &&
         a.face == b.face;
}

double MotionPlayer::Swerving(double share) {
  return Ease(share / 0.35) * Ease((1.0 - share) / 0.35);
}

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
  ClearKeys();
  ClearWays();
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

EndGoal MotionPlayer::SlidingGoal(const Span& span, std::size_t side) const {
  const auto goal = [&](std::size_t i) -> const EndGoal& {
    return span.key[i]->posture.hand[side];
  };
  // A hand rests where it comes to the skin and before it leaves.
  const std::size_t before = goal(1).slide && SamePart(goal(0), goal(1)) ? 0 : 1;
  const std::size_t after = goal(3).slide && SamePart(goal(2), goal(3)) ? 3 : 2;
  KeyedCurve curve;
  curve.now = span.time;
  std::array<GoalNumbers, 4> numbers;
  const std::array<std::size_t, 4> index = {before, 1, 2, after};
  for (std::size_t i = 0; i < 4; ++i) {
    curve.time[i] = span.key[index[i]]->time;
    numbers[i] = SlidingNumbers(goal(index[i]));
  }
  return WithSliding(goal(1), curve.At(numbers));
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
  const std::size_t before = goal(1).touches ? 1 : 0;
  const std::size_t after = goal(2).touches ? 2 : 3;
  curve.time[0] = curve.time[before];
  curve.time[3] = curve.time[after];
  const double way = (curve.now - span.key[1]->time) / (span.key[2]->time - span.key[1]->time);
  if (slides) {
    const EndGoal now = SlidingGoal(span, side);
    const SkinPoint skin = figure_.At(now.place, side);
    const ArmTarget straight = solver_.TargetOf(now, skin, side, model);
    const GoalTurn& turn = span.key[2]->slide_turn[side];
    if (turn == GoalTurn{}) return straight;
    return solver_.TargetOf(GoalClearing::Turned(now, turn, Swerving(way), side, skin,
                                                 GoalClearing::ArmAxis(straight, side, model)),
                            skin, side, model);
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
  const Quat& chest = model.Rotation(J::kUpperChest);
  mixed.wrist += Swerving(way) * (chest * span.key[2]->swerve[side]);
  mixed.elbow += Swerving(way) * (chest * span.key[2]->elbow_swerve[side]);
  return mixed;
}

HandShape MotionPlayer::FingersAt(const Span& span, std::size_t side) const {
  KeyedCurve curve;
  curve.now = span.time;
  std::array<std::array<double, 2 * HandShape::kDigits>, 4> values;
  for (std::size_t i = 0; i < 4; ++i) {
    curve.time[i] = span.key[i]->time;
    for (std::size_t d = 0; d < HandShape::kDigits; ++d) {
      values[i][2 * d] = span.key[i]->fingers[side].digit[d].bend;
      values[i][2 * d + 1] = span.key[i]->fingers[side].digit[d].curl;
    }
  }
  const auto now = curve.At(values);
  HandShape shape;
  for (std::size_t d = 0; d < HandShape::kDigits; ++d) {
    shape.digit[d] = {now[2 * d], now[2 * d + 1]};
  }
  return shape;
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
  // What is touched is placed first: legs before arms, a limb that touches its partner last.
  PlaceLegs(span, pose);
  const std::size_t last = LastPlaced(span, false);
  for (const std::size_t side : {1 - last, last}) {
    const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
    solver_.PlaceArm(side, ArmAt(span, side, model), model, pose);
  }
  for (std::size_t side = 0; side < 2; ++side) pose.hand[side] = FingersAt(span, side);
  for (Quat& q : pose.rotation_ls) {
    q = glm::normalize(q);
    if (q.w < 0.0) q = -q;
  }
  return pose;
}

void MotionPlayer::FindContacts() {
  for (const bool foot : {false, true}) {
    for (std::size_t side = 0; side < 2; ++side) {
      const auto goal = [&](std::size_t i) -> const EndGoal& {
        return foot ? keys_[i].posture.foot[side] : keys_[i].posture.hand[side];
      };
      const auto on_skin = [&](std::size_t i) {
        return goal(i).on_plate || (goal(i).touches && goal(i).lift == 0.0);
      };
      for (std::size_t i = 0; i < keys_.size(); ++i) {
        if (!on_skin(i)) continue;
        TrueContact contact;
        contact.side = side;
        contact.foot = foot;
        contact.face = goal(i).face;
        const J of = foot ? J::kLeftFoot : J::kLeftHand;
        contact.of = side == 0 ? of : Mirror(of);
        contact.from_s = keys_[i].time;
        if (goal(i).on_plate) {
          contact.plate_ws = figure_.leg_scale() * goal(i).at.y;
          while (i + 1 < keys_.size() && goal(i + 1) == goal(i)) ++i;
          contact.to_s = keys_[i].time;
          contacts_.push_back(std::move(contact));
          continue;
        }
        contact.on = MotionFigure::JointOf(goal(i).place, side);
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
