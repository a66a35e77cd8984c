// SPDX-License-Identifier: MIT
#include "assets/motions/motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/motions/keyed_curve.h"
#include "assets/motions/motion_check.h"
#include "assets/motions/motion_script_file.h"
#include "assets/motions/shipped_motions.h"
#include "core/model/mesh_bvh.h"
#include "core/skeleton/pose.h"

namespace ego {
namespace {

double Angle(const Quat& a, const Quat& b) {
  return Degrees(2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b)))));
}

/// The largest angle between the joints of two poses, degrees.
double LargestAngle(const Pose& a, const Pose& b) {
  double largest = 0.0;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    largest = std::max(largest, Angle(a.rotation_ls[j], b.rotation_ls[j]));
  }
  return largest;
}

const MotionScript& Script(std::string_view name) {
  const Result<const MotionScript*> script = FindMotion(name);
  EXPECT_TRUE(script) << script.error();
  return **script;
}

TEST(Motions, EveryShippedScriptCanBeRead) {
  EXPECT_GE(ShippedMotionTexts().size(), 20u);
  for (const ShippedMotionText& text : ShippedMotionTexts()) {
    const Result<MotionScript> script = ParseMotionScript(text.json, text.file);
    EXPECT_TRUE(script) << script.error();
  }
  EXPECT_EQ(ShippedMotions().size(), ShippedMotionTexts().size());
}

TEST(Motions, TheNineOfTheStudyComeFirst) {
  constexpr std::array<std::string_view, 9> kStudy = {"M1", "M2", "M3", "M4", "M5",
                                                      "M6", "M7", "M8", "M9"};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(ShippedMotions()[i].study, kStudy[i]);
  EXPECT_EQ(*FindMotion("m7"), &Script("thoughtful"));
  EXPECT_EQ(*FindMotion("Arms-Crossed"), &Script("arms_crossed"));
}

TEST(Motions, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  const Result<const MotionScript*> script = FindMotion("somersault");
  ASSERT_FALSE(script);
  EXPECT_NE(script.error().find("somersault"), std::string::npos);
  for (const MotionScript& known : ShippedMotions()) {
    EXPECT_NE(script.error().find(known.name), std::string::npos);
  }
}

/// Performers of other builds: what a script must hold on, too.
std::vector<PersonParameters> OtherPerformers() {
  PersonParameters slim;
  slim.name = "Slim";
  slim.height = 1.70;
  slim.arm_length = 0.53;
  slim.leg_length = 0.80;
  slim.upper_arm_radius = 0.039;
  slim.upper_leg_radius = 0.066;
  slim.lower_leg_radius = 0.045;
  slim.chest_width = 0.29;
  slim.chest_depth = 0.20;
  slim.waist_width = 0.25;
  slim.belly_thickness = 0.175;
  slim.hips_width = 0.32;
  PersonParameters heavy;
  heavy.name = "Heavy";
  heavy.upper_arm_radius = 0.056;
  heavy.upper_leg_radius = 0.084;
  heavy.waist_width = 0.34;
  heavy.belly_thickness = 0.27;
  heavy.hips_width = 0.37;
  return {slim, heavy};
}

/// Every contact of every script, measured on the skinned mesh without any use of the player's own
/// idea of the place: the face lies on the skin, whoever performs.
TEST(Motions, EveryContactHoldsOnThreeBodies) {
  constexpr double kLimit = 0.002;
  std::vector<Person> people = {ScriptedPerformer()};
  for (const PersonParameters& p : OtherPerformers()) people.push_back(MakePerson(p));
  std::size_t contacts = 0;
  for (const Person& person : people) {
    const MotionFigure figure(person);
    SkinMeasure skin(person.character);
    for (const MotionScript& script : ShippedMotions()) {
      const MotionPlayer player(figure, script);
      for (const TrueContact& contact : player.contacts()) {
        ContactGap gap;
        const int steps = contact.to_s > contact.from_s ? 3 : 0;
        for (int i = 0; i <= steps; ++i) {
          const double time =
              steps == 0 ? contact.from_s : glm::mix(contact.from_s, contact.to_s, i / 3.0);
          const Pose pose = player.At(time);
          skin.SetPose(pose);
          MeasureContact(figure, contact, time, ForwardKinematics(figure.body().skeleton, pose),
                         skin, gap);
        }
        ++contacts;
        EXPECT_LT(std::max(gap.widest, gap.deepest), kLimit)
            << person.body.name << ", " << script.name << ": " << contact.Sentence() << " from "
            << contact.from_s << " s";
      }
    }
  }
  EXPECT_GT(contacts, 100u);
}

TEST(Motions, TheTouchSequenceTouchesEverySamplePointOfACalibration) {
  const MotionPlayer player(ScriptedFigure(), Script("touch_points"));
  std::array<int, kSampleCount> touches{};
  for (const TrueContact& contact : player.contacts()) {
    ASSERT_EQ(contact.places.front().place.part, BodyPart::kSample) << contact.Sentence();
    ++touches[Index(contact.places.front().place.sample)];
  }
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    EXPECT_EQ(touches[i], 1) << Name(static_cast<SamplePoint>(i));
  }
  EXPECT_EQ(player.contacts().front().Sentence(), "right fingertips on the collar notch");
}

/// What is wrong with each shipped motion on the scripted performer, looked at 24 times a second,
/// the long and unhurried ones 12 times.
const MotionCheck& CheckOf(const MotionScript& script) {
  static std::map<std::string, MotionCheck> checks;
  const auto [found, is_new] = checks.try_emplace(script.name);
  if (is_new) {
    const double rate_hz = script.Duration() > 12.0 ? 12.0 : 24.0;
    found->second = CheckMotion(ScriptedFigure(), script, 1.0 / rate_hz);
  }
  return found->second;
}

class EveryMotion : public testing::TestWithParam<std::size_t> {
 protected:
  const MotionScript& script() const { return ShippedMotions()[GetParam()]; }
};

/// Skin in skin on the finished mesh, every limb against the body without it.
TEST_P(EveryMotion, SinksIntoItselfByNoMoreThanFiveMillimetres) {
  constexpr double kLimit = 0.005;
  const MotionCheck& check = CheckOf(script());
  EXPECT_LE(check.sinking.depth, kLimit)
      << script().name << ": " << Name(check.sinking.of) << " in " << Name(check.sinking.in)
      << " at " << check.sinking_at_s << " s";
  // The studio's own bars: nothing unhurried turns a joint faster than this; slaps and the draw of
  // a gun are meant to be quick.
  constexpr double kUsual = 1000.0;
  constexpr double kQuick = 1300.0;
  const bool quick = script().name == "haka" || script().name == "gun";
  EXPECT_LE(check.largest_speed, quick ? kQuick : kUsual)
      << script().name << " at " << check.largest_speed_at_s << " s";
  // A wrist bends by some 80 degrees, and a little to the side at the same time.
  EXPECT_LE(check.largest_wrist, 95.0) << script().name << " at " << check.largest_wrist_at_s;
}

INSTANTIATE_TEST_SUITE_P(Motions, EveryMotion,
                         testing::Range<std::size_t>(0, ShippedMotionTexts().size()),
                         [](const testing::TestParamInfo<std::size_t>& which) {
                           return ShippedMotions()[which.param].name;
                         });

TEST(Motions, BeginAndEndInTheSameStanceAtRest) {
  const Pose stand = MotionPlayer(ScriptedFigure(), Script("wave")).At(0.0);
  for (const MotionScript& script : ShippedMotions()) {
    const MotionPlayer player(ScriptedFigure(), script);
    for (const double time : {0.0, script.Duration()}) {
      const Pose pose = player.At(time);
      EXPECT_LT(LargestAngle(pose, stand), 1e-4) << script.name << " at " << time;
      EXPECT_LT(glm::distance(pose.root_ws, stand.root_ws), 1e-9) << script.name;
    }
  }
}

TEST(Motions, AreRepeatedBitForBit) {
  for (const char* name : {"M1", "arms_crossed"}) {
    const ScriptedTake a = Perform(ScriptedFigure(), Script(name));
    const ScriptedTake b = Perform(MotionFigure(ScriptedPerformer()), Script(name));
    ASSERT_EQ(a.motion.poses.size(), b.motion.poses.size());
    for (std::size_t f = 0; f < a.motion.poses.size(); ++f) {
      EXPECT_EQ(a.motion.poses[f].root_ws, b.motion.poses[f].root_ws);
      EXPECT_EQ(a.motion.poses[f].rotation_ls, b.motion.poses[f].rotation_ls);
    }
  }
}

/// No foot sinks into the floor, and feet that stand do not slide.
TEST(Motions, FeetStandOnTheFloor) {
  for (const MotionScript& script : ShippedMotions()) {
    const ScriptedTake take = Perform(ScriptedFigure(), script);
    const Body& body = take.motion.performer;
    const std::array<Vec3, kJointCount> canonical = CanonicalPositions(body.skeleton);
    for (const Pose& pose : take.motion.poses) {
      const ModelPose model = ForwardKinematics(body.skeleton, pose);
      for (std::size_t side = 0; side < 2; ++side) {
        const HumanoidJoint joint =
            side == 0 ? HumanoidJoint::kLeftFoot : HumanoidJoint::kRightFoot;
        for (const Vec3& p : {body.surface.foot[side].heel_ms, body.surface.foot[side].ball_ms}) {
          EXPECT_GT(PosePoint(canonical, model, joint, p).y, -0.004) << script.name;
        }
      }
    }
  }
}

TEST(Motions, TheDemoShowsManyAndLoops) {
  const MotionScript demo = DemoScript();
  EXPECT_GE(demo.Duration(), 30.0);
  EXPECT_LE(demo.Duration(), 70.0);
  const MotionPlayer player(ScriptedFigure(), demo);
  EXPECT_LT(LargestAngle(player.At(0.0), player.At(demo.Duration())), 1e-4);
  EXPECT_GT(player.contacts().size(), 15u);
}

TEST(MotionScriptFile, SaysInOneSentenceWhatIsWrong) {
  const struct {
    const char* text;
    const char* names;
  } kCases[] = {
      {"[", "not valid JSON"},
      {"[]", "must be an object"},
      {R"({"keys": [{}, {"after": 1}]})", "\"name\""},
      {R"({"name": "a"})", "\"keys\""},
      {R"({"name": "a", "keys": [{}]})", "two keys"},
      {R"({"name": "a", "keys": [{}, {"after": -1}]})", "key 2"},
      {R"({"name": "a", "keys": [{}, {}]})", "\"after\""},
      {R"({"name": "a", "keys": [{}, {"after": 1, "colour": 3}]})", "\"colour\""},
      {R"({"name": "a", "keys": [{}, {"after": 1, "go": "away"}]})", "\"away\""},
      {R"({"name": "a", "keys": [{}, {"after": 1, "root": [1, 2]}]})", "three numbers"},
      {R"({"name": "a", "keys": [{}, {"after": 1, "root": [1, 2, 1e9]}]})", "\"root\""},
      {R"({"name": "a", "keys": [{}, {"after": 1, "leftHand": {"on": "nose"}}]})", "trunk"},
      {R"({"name": "a", "keys": [{}, {"after": 1, "leftHand": {"on": "head", "with": "sole"}}]})",
       "side of a hand"},
      {R"({"name": "a", "keys": [{}, {"after": 1, "leftHand": {"palm": [0, 0, 0]}}]})",
       "three zeros"},
      {R"({"name": "a", "keys": [{}, {"repeat": 1e9, "keys": [{"after": 1}]}]})", "\"repeat\""},
      {R"({"name": "a", "keys": [{}, {"repeat": 100, "keys": [{"after": 9}]}]})", "ten minutes"},
  };
  for (const auto& c : kCases) {
    const Result<MotionScript> script = ParseMotionScript(c.text, "mine.json");
    ASSERT_FALSE(script) << c.text;
    EXPECT_NE(script.error().find("mine.json"), std::string::npos) << script.error();
    EXPECT_NE(script.error().find(c.names), std::string::npos) << script.error();
    EXPECT_EQ(script.error().find('\n'), std::string::npos);
  }
}

TEST(MotionScriptFile, RepeatsAndMirrorsAndKeepsWhatAKeyDoesNotName) {
  const Result<MotionScript> script = ParseMotionScript(
      R"({"name": "a", "keys": [{}, {"repeat": 2, "keys": [
           {"after": 0.5, "spine": [10, 5, 2], "leftHand": {"on": "other forearm"}},
           {"after": 0.25, "mirror": true}]}]})",
      "a.json");
  ASSERT_TRUE(script) << script.error();
  ASSERT_EQ(script->keys.size(), 5u);
  EXPECT_DOUBLE_EQ(script->Duration(), 1.5);
  const BodyGoals& mirrored = script->keys[2].posture;
  EXPECT_DOUBLE_EQ(mirrored.spine.pitch, 10.0);
  EXPECT_DOUBLE_EQ(mirrored.spine.yaw, -5.0);
  EXPECT_FALSE(mirrored.hand[0].touches);
  EXPECT_TRUE(mirrored.hand[1].touches);
  EXPECT_TRUE(mirrored.hand[1].place.other);
}

TEST(KeyedCurve, PassesThroughKeysSmoothlyAndHoldsExactly) {
  const std::array<double, 7> time = {0.0, 0.5, 0.9, 1.5, 2.0, 2.2, 3.0};
  const std::array<double, 7> value = {0.0, 1.0, 4.0, 4.0, 2.0, 2.5, 0.0};
  const auto at = [&](double t) {
    std::size_t k = 0;
    while (k + 2 < time.size() && t >= time[k + 1]) ++k;
    KeyedCurve curve;
    std::array<double, 4> v;
    for (int i = 0; i < 4; ++i) {
      const auto index = static_cast<std::size_t>(
          std::clamp(static_cast<int>(k) + i - 1, 0, static_cast<int>(time.size()) - 1));
      curve.time[static_cast<std::size_t>(i)] = time[index];
      v[static_cast<std::size_t>(i)] = value[index];
    }
    curve.now = t;
    return curve.At(v);
  };
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(at(time[i]), value[i], 1e-12);
  for (double t = 0.9; t <= 1.5; t += 0.05) EXPECT_DOUBLE_EQ(at(t), 4.0);
  // Speed has no jumps: its change between close instants stays small.
  constexpr double kStep = 1e-4;
  double last = 0.0;
  for (double t = 0.0; t + kStep <= 3.0; t += kStep) {
    const double speed = (at(t + kStep) - at(t)) / kStep;
    EXPECT_LT(std::abs(speed - last), 0.05) << t;
    EXPECT_GE(at(t), -1e-9);
    EXPECT_LE(at(t), 4.0 + 1e-9);
    last = speed;
  }
}

}  // namespace
}  // namespace ego
