// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/motions/motion_player.h"

namespace ego {
namespace {

using J = HumanoidJoint;

Limb ArmOf(std::size_t side) { return side == 0 ? Limb::kLeftArm : Limb::kRightArm; }

bool TouchesOtherLimb(const EndGoal& goal, bool foot) {
  if (!goal.touches || !goal.place.other) return false;
  const BodyPart part = goal.place.part;
  const bool leg = part == BodyPart::kThigh || part == BodyPart::kCalf || part == BodyPart::kFoot;
  return leg == foot;
}

}  // namespace

bool MotionPlayer::TouchesPartner(const Span& span, bool foot, std::size_t side) {
  return std::any_of(span.key.begin(), span.key.end(), [&](const Key* key) {
    return TouchesOtherLimb(foot ? key->posture.foot[side] : key->posture.hand[side], foot);
  });
}

void MotionPlayer::PlaceLegs(const Span& span, Pose& pose) const {
  const std::size_t last = LastPlaced(span, true);
  // Feet that lie on each other's legs find their places together.
  const int rounds = TouchesPartner(span, true, 0) && TouchesPartner(span, true, 1) ? 8 : 1;
  for (int round = 0; round < rounds; ++round) {
    for (const std::size_t side : {1 - last, last}) {
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      solver_.PlaceLeg(side, LegAt(span, side, model), model, pose);
    }
  }
}

Pose MotionPlayer::KeyPose(const Key& key, std::optional<std::size_t> arm) const {
  Pose pose = BodyPose(key.posture, key.root_ws);
  const Span span = SpanOf(key);
  PlaceLegs(span, pose);
  if (arm) {
    const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
    solver_.PlaceArm(*arm, ArmAt(span, *arm, model), model, pose);
    pose.hand[*arm] = key.fingers[*arm];
  }
  return pose;
}

void MotionPlayer::ClearKeys() {
  std::vector<BodyGoals> written;
  for (Key& key : keys_) {
    written.push_back(key.posture);
    for (std::size_t side = 0; side < 2; ++side) {
      key.fingers[side] = ShapeOf(key.posture.hand[side].form);
    }
  }
  // First the arms that are placed first, everywhere.
  for (const bool last : {false, true}) {
    for (std::size_t k = 0; k < keys_.size();) {
      const std::size_t last_placed = LastPlaced(SpanOf(keys_[k]), false);
      const std::size_t side = last ? last_placed : 1 - last_placed;
      // A hold stays one.
      std::size_t end = k + 1;
      while (end < keys_.size() && written[end].hand[side] == written[k].hand[side] &&
             LastPlaced(SpanOf(keys_[end]), false) == last_placed) {
        ++end;
      }
      const std::span hold = std::span(keys_).subspan(k, end - k);
      const std::optional<std::size_t> other =
          last ? std::optional<std::size_t>(1 - side) : std::nullopt;
      // What was cleared once needs not be again.
      const auto same =
          std::find(written.begin(), written.begin() + static_cast<std::ptrdiff_t>(k), written[k]);
      const auto before = static_cast<std::size_t>(same - written.begin());
      if (before < k) {
        for (Key& key : hold) {
          key.posture.hand[side] = keys_[before].posture.hand[side];
          key.fingers[side] = keys_[before].fingers[side];
        }
      } else {
        ClearGoal(hold, side, other);
        LayFingers(hold, side, other);
      }
      k = end;
    }
  }
}

void MotionPlayer::ClearGoal(std::span<Key> hold, std::size_t side,
                             std::optional<std::size_t> other) {
  constexpr std::size_t kMostLooks = 2;
  const EndGoal written = hold.front().posture.hand[side];
  const SkinPoint& skin = hold.front().hand_skin[side];
  GoalClearing clearing(figure_, solver_, side,
                        other ? std::nullopt : std::optional<Limb>(ArmOf(1 - side)));
  Vec3 axis{0.0};
  const std::size_t count = std::min(hold.size(), kMostLooks);
  for (std::size_t i = 0; i < count; ++i) {
    const Key& key = hold[count == 1 ? 0 : i * (hold.size() - 1) / (count - 1)];
    Pose pose = KeyPose(key, other);
    pose.hand[side] = key.fingers[side];
    if (i == 0) {
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      axis = GoalClearing::ArmAxis(solver_.TargetOf(written, skin, side, model), side, model);
    }
    clearing.Look(written, skin, pose, 1.0);
  }
  const EndGoal goal = GoalClearing::Turned(written, clearing.Find(), 1.0, side, skin, axis);
  for (Key& key : hold) key.posture.hand[side] = goal;
}

void MotionPlayer::ClearSlide(std::size_t to, std::size_t side) {
  GoalClearing clearing(figure_, solver_, side, std::nullopt);
  for (const double share : {0.35, 0.65}) {
    const double time = glm::mix(keys_[to - 1].time, keys_[to].time, share);
    const EndGoal goal = SlidingGoal(SpanAt(time), side);
    clearing.Look(goal, figure_.At(goal.place, side), At(time), Swerving(share));
  }
  keys_[to].slide_turn[side] = clearing.Find();
}

void MotionPlayer::LayFingers(std::span<Key> hold, std::size_t side,
                              std::optional<std::size_t> other) {
  Key& key = hold.front();
  const EndGoal& goal = key.posture.hand[side];
  if (!goal.touches || goal.lift != 0.0) return;
  const std::optional<Limb> absent = other ? std::nullopt : std::optional<Limb>(ArmOf(1 - side));
  Pose pose = KeyPose(key, other);
  const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
  solver_.PlaceArm(side, solver_.TargetOf(goal, key.hand_skin[side], side, model), model, pose);
  HandShape& shape = key.fingers[side];
  for (std::size_t d = 0; d < HandShape::kDigits; ++d) {
    // The finger that touches by its tip stays as it is.
    if (goal.face == TouchFace::kFingertips && d == 2) continue;
    const HandShape::Digit from = shape.digit[d];
    // Fingers stretch as far as they can, or close until they meet the skin.
    const double least = d == 0 ? -20.0 : -25.0;
    const double most = goal.form == HandForm::kLaid ? (d == 0 ? 20.0 : 40.0) : 0.0;
    double best = 1e9;
    HandShape::Digit found = from;
    for (double degrees = least; degrees <= most; degrees += 2.5) {
      pose.hand[side] = shape;
      HandShape::Digit& digit = pose.hand[side].digit[d];
      digit.bend = from.bend + Radians(degrees);
      digit.curl = from.curl + std::max(0.0, Radians(0.8 * degrees));
      double gap = 0.0;
      const RigidSkin::Depth depth = figure_.rigid_skin().OfFinger(side, d, pose, absent, gap);
      const double cost = 4.0 * std::max(0.0, depth.deepest - 0.001) +
                          (goal.form == HandForm::kLaid ? std::max(0.0, gap) : 0.0) +
                          0.0001 * std::abs(degrees);
      if (cost >= best) continue;
      best = cost;
      found = digit;
    }
    shape.digit[d] = found;
  }
  for (Key& same : hold) same.fingers[side] = shape;
}

void MotionPlayer::ClearWays() {
  const auto same_way = [&](std::size_t a, std::size_t b) {
    return keys_[a].posture == keys_[b].posture && keys_[a - 1].posture == keys_[b - 1].posture;
  };
  for (const bool last : {false, true}) {
    for (std::size_t k = 1; k < keys_.size(); ++k) {
      const std::size_t last_placed = LastPlaced(SpanOf(keys_[k]), false);
      const std::size_t side = last ? last_placed : 1 - last_placed;
      const EndGoal& to = keys_[k].posture.hand[side];
      if (keys_[k - 1].posture.hand[side] == to) continue;
      // A way that was gone before needs not be cleared again.
      std::size_t before = 1;
      while (before < k && !same_way(before, k)) ++before;
      if (before < k) {
        keys_[k].swerve[side] = keys_[before].swerve[side];
        keys_[k].elbow_swerve[side] = keys_[before].elbow_swerve[side];
        keys_[k].slide_turn[side] = keys_[before].slide_turn[side];
      } else if (to.slide && SamePart(keys_[k - 1].posture.hand[side], to)) {
        ClearSlide(k, side);
      } else {
        ClearWay(k, side, last);
      }
    }
  }
}

void MotionPlayer::ClearWay(std::size_t to, std::size_t side, bool last) {
  constexpr int kRounds = 5;
  constexpr double kDeep = 0.002;
  constexpr double kFarthest = 0.12;  // metres
  constexpr double kMostTurn = 1.2;   // of the elbow's unit direction
  Key& key = keys_[to];
  const double from = keys_[to - 1].time;
  for (int round = 0; round < kRounds; ++round) {
    double deepest = kDeep;
    Vec3 push{0.0};
    Vec3 turn{0.0};
    for (const double share : {0.08, 0.16, 0.25, 0.36, 0.5, 0.64, 0.75, 0.84, 0.92}) {
      const Pose pose = At(glm::mix(from, key.time, share));
      const RigidSkin::Depth own = figure_.rigid_skin().Of(
          ArmOf(side), pose, last ? std::nullopt : std::optional<Limb>(ArmOf(1 - side)));
      // The other arm may lie in this one, which is the one that gives way.
      RigidSkin::Depth other;
      if (last) other = figure_.rigid_skin().Of(ArmOf(1 - side), pose);
      const double depth = std::max(own.deepest, other.deepest);
      if (depth <= deepest) continue;
      deepest = depth;
      const ModelPose model = ForwardKinematics(figure_.body().skeleton, pose);
      const Quat to_chest = glm::conjugate(model.Rotation(J::kUpperChest));
      const double swerving = std::min(share, 1.0 - share) < 0.25 ? 0.5 : 1.0;
      const auto step = [&](const Vec3& out) {
        const double length = glm::length(out);
        return length < 1e-9 ? Vec3{0.0} : to_chest * out * (1.15 * depth / length / swerving);
      };
      push = step(own.deepest >= other.deepest ? own.out_ws : -other.out_ws);
      // An elbow stands about a hand's length from the line from shoulder to wrist.
      turn = step(own.upper_out_ws) / 0.12;
    }
    if (deepest == kDeep) return;
    const auto add = [](Vec3& sum, const Vec3& more, double most) {
      sum += more;
      const double length = glm::length(sum);
      if (length > most) sum *= most / length;
    };
    add(key.swerve[side], push, kFarthest);
    add(key.elbow_swerve[side], turn, kMostTurn);
  }
}

}  // namespace ego
