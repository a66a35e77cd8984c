// SPDX-License-Identifier: MIT
#include "assets/people/motions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "assets/people/field.h"
#include "assets/people/performer_markers.h"
#include "assets/people/person_shape.h"
#include "assets/people/posture.h"
#include "core/base/check.h"

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr double kRate = 60.0;

/// The performer with the places of the body that the scripts touch.
struct Stage {
  const Person& person = ScriptedPerformer();
  PersonShape shape{DemoCast().front()};
  FigureSurface surface = SurfaceOf(person.character);
  PostureSolver solver{person.body};

  Vec3 Joint(J joint) const { return shape.Joint(joint); }
  /// On the trunk, at a share of the way from the hip joints to the neck joint.
  SkinPoint Trunk(double share, const Vec3& direction) const {
    return PointAlong(surface, {0.0, shape.HipHeight() + share * shape.TrunkLength(), -0.02},
                      glm::normalize(direction));
  }
  SkinPoint At(const Vec3& origin, const Vec3& direction) const {
    return PointAlong(surface, origin, glm::normalize(direction));
  }
  SkinPoint BackOfHand(std::size_t side) const {
    Vec3 origin = person.body.surface.hand[side].palm_ms;
    origin.y = Joint(J::kLeftHand).y;
    return At(origin, kUp);
  }
};

HandGoal Touch(const SkinPoint& skin, const Vec3& fingers, const Vec3& elbow) {
  HandGoal goal;
  goal.touches = true;
  goal.skin = skin;
  goal.fingers = fingers;
  goal.elbow = elbow;
  return goal;
}

HandGoal Free(const Vec3& position, const Vec3& palm, const Vec3& fingers, const Vec3& elbow) {
  HandGoal goal;
  goal.position = position;
  goal.palm = palm;
  goal.fingers = fingers;
  goal.elbow = elbow;
  return goal;
}

/// The relaxed stance in which every motion begins and ends.
Posture Stand() {
  Posture posture;
  posture.spine.pitch = 1.0;
  posture.head.pitch = -1.0;
  for (HandGoal& hand : posture.hand) {
    hand = Free({0.075, -0.615, 0.035}, {-1.0, 0.0, -0.25}, {-0.05, -1.0, 0.12}, {0.25, 0.0, -1.0});
  }
  return posture;
}

struct Key {
  double time;  // seconds
  Posture posture;
};
using Script = std::vector<Key>;

/// Stand, go to the posture, stay, and go back.
Script Visit(const Posture& posture, double go, double stay, double back) {
  return {{0.0, Stand()}, {go, posture}, {go + stay, posture}, {go + stay + back, Stand()}};
}

Script HandsOnBelly(const Stage& stage) {
  Posture p = Stand();
  p.spine.pitch = 4.0;
  p.head.pitch = 8.0;
  p.hand[0] = Touch(stage.Trunk(0.25, {0.30, 0.0, 1.0}), {-1.0, -0.30, 0.0}, {1.0, -0.2, 0.35});
  p.hand[1] = Touch(stage.BackOfHand(0), {0.15, 0.0, 1.0}, {1.0, -0.2, 0.55});
  // The fingers of the right hand lie along those of the left, across its back.
  p.hand[1].fingers = {-0.9, 0.0, -0.45};
  p.hand[1].after_other = true;
  // From the front, so that no forearm cuts the corner of the hip.
  Posture front = Stand();
  front.spine.pitch = 3.0;
  front.head.pitch = 6.0;
  front.hand[0] =
      Free({-0.10, -0.40, 0.26}, {-0.2, 0.0, -1.0}, {-1.0, -0.3, 0.1}, {1.0, -0.3, 0.0});
  front.hand[1] =
      Free({-0.12, -0.37, 0.33}, {-0.2, 0.0, -1.0}, {-1.0, -0.2, 0.0}, {1.0, -0.3, 0.1});
  return {{0.0, Stand()}, {0.85, front}, {1.45, p}, {2.85, p}, {3.45, front}, {4.3, Stand()}};
}

Script ArmsCrossed(const Stage& stage) {
  Posture p = Stand();
  p.spine.pitch = -2.0;
  p.head.pitch = 2.0;
  p.head.yaw = 8.0;
  const Vec3 shoulder = stage.Joint(J::kLeftUpperArm);
  // The left hand lies on the right ribs, the right one on the left upper arm.
  p.hand[0] = Touch(stage.Trunk(0.56, {-0.8, 0.0, 1.0}), {-0.75, 0.65, -0.3}, {0.8, -0.6, 0.6});
  p.hand[1] = Touch(stage.At(shoulder + Vec3{0.16, 0.0, 0.0}, {0.0, 0.75, -0.8}),
                    {-0.25, -0.7, -0.7}, {0.8, -0.75, 0.75});
  p.hand[1].after_other = true;
  // On the way the forearms are held in front of the chest, one above the other.
  Posture front = Stand();
  front.hand[0] =
      Free({-0.16, -0.30, 0.32}, {-0.25, -0.2, -1.0}, {-1.0, 0.1, 0.1}, {0.9, -0.6, 0.2});
  front.hand[1] =
      Free({-0.16, -0.17, 0.36}, {-0.25, -0.2, -1.0}, {-1.0, 0.1, 0.1}, {0.9, -0.6, 0.3});
  return {{0.0, Stand()}, {0.9, front}, {1.5, p}, {3.0, p}, {3.6, front}, {4.5, Stand()}};
}

Script HandOnShoulder(const Stage& stage) {
  Posture p = Stand();
  p.spine.yaw = 6.0;
  p.head.yaw = 18.0;
  p.head.pitch = 4.0;
  const Vec3 shoulder = stage.Joint(J::kLeftUpperArm);
  p.hand[1] = Touch(stage.At(shoulder + Vec3{-0.03, 0.0, 0.0}, {0.1, 1.0, 0.5}), {-0.25, 0.3, -1.0},
                    {0.45, -0.8, 1.0});
  p.shrug[1] = 4.0;
  p.hand[1].after_other = true;
  return Visit(p, 1.0, 1.2, 1.0);
}

Script Salute(const Stage& stage) {
  Posture p = Stand();
  p.spine.pitch = -3.0;
  p.head.pitch = -3.0;
  const Vec3 head = {0.0, stage.shape.ChinHeight() + 0.66 * stage.shape.parameters().head_height,
                     stage.shape.HeadDepth()};
  p.hand[1] = Touch(stage.At(head, {-1.0, 0.0, 0.75}), {-0.75, 0.55, 0.1}, {1.0, -0.15, -0.1});
  p.hand[1].fingertip = true;
  p.hand[1].tilt = -38.0;
  p.shrug[1] = 8.0;
  return Visit(p, 0.7, 1.2, 0.8);
}

Script HandsOnHips(const Stage& stage) {
  Posture p = Stand();
  p.root.x = 0.02;
  p.pelvis.roll = 2.0;
  p.spine.roll = -2.0;
  p.head.yaw = -14.0;
  p.spine.pitch = -1.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const double out = side == 0 ? 1.0 : -1.0;
    p.hand[side] =
        Touch(stage.Trunk(0.15, {out, 0.0, 0.12}), {-0.10, -0.55, 0.9}, {1.0, 0.1, -0.5});
  }
  return Visit(p, 1.0, 1.4, 1.0);
}

Script Clap(const Stage& stage) {
  const double middle = stage.Joint(J::kLeftUpperArm).x;
  Posture closed = Stand();
  closed.head.pitch = 4.0;
  for (HandGoal& hand : closed.hand) {
    hand = Free({-middle, -0.16, 0.36}, {-1.0, 0.0, 0.0}, {0.0, 0.75, 0.65}, {0.8, -1.0, -0.2});
  }
  Posture open = closed;
  for (HandGoal& hand : open.hand) hand.position.x = -middle + 0.13;
  Script script = {{0.0, Stand()}, {0.8, open}};
  for (int i = 0; i < 4; ++i) {
    script.push_back({1.0 + 0.44 * i, closed});
    script.push_back({1.06 + 0.44 * i, closed});
    script.push_back({1.26 + 0.44 * i, open});
  }
  script.push_back({3.5, Stand()});
  return script;
}

Script Wave(const Stage&) {
  Posture left = Stand();
  left.head.yaw = -6.0;
  left.head.roll = 4.0;
  left.spine.roll = -2.0;
  left.shrug[1] = 10.0;
  left.hand[1] = Free({0.20, 0.30, 0.20}, {0.0, 0.0, 1.0}, {0.30, 1.0, 0.0}, {1.0, -0.9, -0.3});
  Posture right = left;
  right.hand[1].position.x = 0.36;
  right.hand[1].fingers = {0.75, 1.0, 0.0};
  Script script = {{0.0, Stand()}, {0.9, left}};
  for (int i = 0; i < 3; ++i) {
    script.push_back({1.2 + 0.6 * i, right});
    script.push_back({1.5 + 0.6 * i, left});
  }
  script.push_back({3.7, Stand()});
  return script;
}

Script HandsOnKnees(const Stage& stage) {
  Posture p = Stand();
  p.root = {0.0, -0.27, -0.16};
  p.pelvis.pitch = 42.0;
  p.spine.pitch = 18.0;
  p.head.pitch = -34.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 knee = stage.Joint(side == 0 ? J::kLeftLowerLeg : J::kRightLowerLeg);
    p.hand[side] = Touch(stage.At(knee + Vec3{0.0, 0.085, 0.0}, {0.0, 0.0, 1.0}),
                         {-0.25, -1.0, 0.0}, {0.9, -0.1, -0.5});
  }
  return Visit(p, 1.55, 1.3, 1.65);
}

Script HandToAnkle(const Stage& stage) {
  Posture p = Stand();
  p.root = {0.03, -0.36, -0.13};
  p.pelvis.pitch = 62.0;
  p.spine.pitch = 48.0;
  p.spine.roll = -8.0;
  p.head.pitch = -18.0;
  const Vec3 ankle = stage.Joint(J::kLeftFoot);
  p.hand[0] = Touch(stage.At(ankle + Vec3{0.0, 0.07, 0.0}, {1.0, 0.0, 0.25}), {0.0, -0.8, 0.75},
                    {1.0, 0.1, 0.0});
  const Vec3 knee = stage.Joint(J::kRightLowerLeg);
  p.hand[1] = Touch(stage.At(knee + Vec3{0.0, 0.06, 0.0}, {0.0, 0.0, 1.0}), {-0.3, -1.0, 0.0},
                    {0.9, 0.2, -0.3});
  return Visit(p, 1.85, 1.1, 1.85);
}

Script WalkInPlace(const Stage&) {
  const auto step = [](std::size_t lifted) {
    Posture p = Stand();
    const double out = lifted == 0 ? 1.0 : -1.0;
    p.root = {-0.045 * out, -0.012, 0.0};
    p.pelvis.roll = 2.0 * out;
    p.pelvis.yaw = -4.0 * out;
    p.spine.yaw = 7.0 * out;
    p.spine.roll = -2.0 * out;
    p.foot[lifted].offset = {0.0, 0.13, 0.02};
    p.foot[lifted].heel_up = 22.0;
    for (std::size_t side = 0; side < 2; ++side) {
      const double swing = side == lifted ? -1.0 : 1.0;
      p.hand[side] = Free({0.085, -0.60 + (swing > 0.0 ? 0.06 : 0.03), 0.03 + 0.20 * swing},
                          {-1.0, 0.0, -0.1}, {-0.05, -1.0, 0.15 + 0.5 * swing}, {0.25, -0.1, -1.0});
    }
    return p;
  };
  Posture low = Stand();
  low.root.y = -0.022;
  Script script = {{0.0, Stand()}};
  for (int i = 0; i < 6; ++i) {
    script.push_back({0.45 + 0.6 * i, step(static_cast<std::size_t>(i % 2))});
    if (i < 5) script.push_back({0.75 + 0.6 * i, low});
  }
  script.push_back({4.0, Stand()});
  return script;
}

struct Entry {
  std::string_view name;
  Script (*script)(const Stage&);
};
constexpr std::array<Entry, 10> kMotions = {{{"wave", Wave},
                                             {"hands-on-belly", HandsOnBelly},
                                             {"arms-crossed", ArmsCrossed},
                                             {"clap", Clap},
                                             {"hand-on-shoulder", HandOnShoulder},
                                             {"hands-on-hips", HandsOnHips},
                                             {"salute", Salute},
                                             {"hands-on-knees", HandsOnKnees},
                                             {"hand-to-ankle", HandToAnkle},
                                             {"walk-in-place", WalkInPlace}}};

/// Breath and the slow sway of standing, periodic over the whole motion.
Posture Alive(Posture posture, double phase, double duration) {
  const double breath = std::sin(2.0 * kPi * std::max(1.0, std::round(duration / 3.6)) * phase);
  const double sway = std::sin(2.0 * kPi * std::max(1.0, std::round(duration / 5.0)) * phase);
  posture.spine.pitch -= 0.9 * breath;
  posture.head.pitch += 0.5 * breath;
  posture.head.yaw += 1.2 * sway;
  posture.shrug[0] += 0.8 * breath;
  posture.shrug[1] += 0.8 * breath;
  posture.root += Vec3{0.006 * sway, -0.001 * (1.0 - breath), 0.0};
  return posture;
}

double Ease(double t) { return t * t * t * (10.0 - t * (15.0 - 6.0 * t)); }

CapturedMotion Play(const Stage& stage, std::string name, const Script& script) {
  CapturedMotion motion;
  motion.name = std::move(name);
  motion.performer = stage.person.body;
  motion.rate_hz = kRate;
  const double duration = script.back().time;
  const int frames = static_cast<int>(std::lround(duration * kRate));
  std::size_t key = 0;
  for (int f = 0; f < frames; ++f) {
    const double time = f / kRate;
    while (key + 2 < script.size() && time >= script[key + 1].time) ++key;
    const Key& a = script[key];
    const Key& b = script[key + 1];
    const double share = Ease(std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0));
    const double phase = time / duration;
    motion.poses.push_back(stage.solver.Solve(Alive(a.posture, phase, duration),
                                              Alive(b.posture, phase, duration), share));
  }
  motion.markers = MarkersOn(stage.person, motion);
  return motion;
}

const Stage& TheStage() {
  static const Stage stage;
  return stage;
}

}  // namespace

const Person& ScriptedPerformer() {
  static const Person performer = MakePerson(DemoCast().front());
  return performer;
}

std::vector<std::string_view> ScriptedMotionNames() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kMotions) names.push_back(entry.name);
  return names;
}

Result<CapturedMotion> ScriptedMotion(std::string_view name) {
  for (const Entry& entry : kMotions) {
    if (entry.name == name) return Play(TheStage(), std::string(name), entry.script(TheStage()));
  }
  return Error{"There is no scripted motion \"" + std::string(name) + "\"."};
}

CapturedMotion DemoMotion() {
  Script demo = {{0.0, Stand()}};
  for (const Entry& entry : kMotions) {
    const double begin = demo.back().time;
    for (const Key& key : entry.script(TheStage())) {
      if (key.time > 0.0) demo.push_back({begin + key.time, key.posture});
    }
  }
  return Play(TheStage(), "demo", demo);
}

}  // namespace ego
