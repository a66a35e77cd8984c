// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/motions/hand_form.h"
#include "core/base/math.h"
#include "core/body/body_surface.h"

namespace ego {

/// A part of the body that can be touched. Limb parts of a goal are those of the goal's own side,
/// or of the other one.
enum class BodyPart : std::uint8_t {
  kTrunk,
  kHead,
  kUpperArm,
  kForearm,
  kHand,
  kThigh,
  kCalf,
  kFoot,
  kSample,  // one of the points that the calibration samples
};

/// A place on anyone's skin: where a ray from inside a body part comes out, in the canonical pose.
struct BodyPlace {
  BodyPart part = BodyPart::kTrunk;
  bool other = false;  // of the side that the goal is not on
  /// Share of the way along the part at which the ray begins. Trunk: from the hip joints up to the
  /// neck joint; head: from the chin to the crown; hand: wrist to fingertip; foot: ankle to ball;
  /// else: the bone.
  double along = 0.5;
  Vec3 toward{0.0, 0.0, 1.0};  // written for a left hand or foot: +X is its own outside

  SamplePoint sample = SamplePoint::kNavel;  // for kSample: this very point, on either side

  friend bool operator==(const BodyPlace&, const BodyPlace&) = default;
};

/// The side of a hand or foot that touches.
enum class TouchFace : std::uint8_t {
  kPalm,
  kFingertips,
  kBack,
  kThumbSide,
  kSole,
  kInstep,
  kOuterEdge
};

/// Where a hand or a foot is and how it is turned. Everything is written for the left side (+X
/// outward); the right side takes the mirror image.
struct EndGoal {
  /// Free hand: `at`, `palm`, `pointing` and `pole` are in stage space (a plate that stands there),
  /// `at` from the standing place for hip joints 0.92 m high.
  bool on_stage = false;
  bool on_plate = false;  // the same, and the palm lies on a level plate there

  // A touch: the face lies on the place, facing it, and follows the skin.
  bool touches = false;
  BodyPlace place;
  TouchFace face = TouchFace::kPalm;
  double lift = 0.0;   // metres off the skin
  double tilt = 0.0;   // degrees by which fingers or toes leave the skin
  double lean = 0.0;   // degrees by which the thumb's side leaves the skin
  bool slide = false;  // comes here along the skin from the key before, without leaving it

  /// Free hand: the palm, metres from the shoulder joint in the frame of the upper chest, for an
  /// arm of 0.55 m. Free foot: moved from where it stands, metres of a person with hip joints 0.92
  /// m above the ground; y is the height of its lowest skin.
  Vec3 at{0.0};
  /// Free hand: direction of the palm's outward normal, frame of the upper chest.
  Vec3 palm{-1.0, 0.0, 0.0};
  /// Direction of fingers or toes: frame of the chest (free hand), or carried along with the skin
  /// from the canonical pose (touch).
  Vec3 pointing{0.0, -1.0, 0.0};
  /// Free foot, degrees: turned outward; heel raised about the toes (below zero: toes about the
  /// heel); sole turned inward.
  double turn = 6.0;
  double heel = 0.0;
  double roll = 0.0;
  /// Where the elbow points, frame of the upper chest; where the knee points, world space (zero:
  /// as the foot).
  Vec3 pole{0.0};
  HandForm form = HandForm::kRelaxed;
  /// How far a hand swings around the body on its way here, share of the distance.
  double arc = 0.2;

  friend bool operator==(const EndGoal&, const EndGoal&) = default;
};

/// Angles in degrees: pitch bends forward, yaw turns to the left, roll leans to the right.
struct Bend {
  double pitch = 0.0;
  double yaw = 0.0;
  double roll = 0.0;

  friend bool operator==(const Bend&, const Bend&) = default;
};

/// Goals for a whole body.
struct BodyGoals {
  Vec3 root{0.0};              // metres from the standing place, for hip joints 0.92 m high
  std::optional<double> seat;  // seated: height of the lowest skin of the hips, replaces root.y
  Bend hips;
  Bend spine;                      // shared by spine, chest and upper chest
  Bend head;                       // shared by neck and head
  std::array<Bend, 2> shoulder{};  // clavicles: pitch forward, roll up; left, right
  std::array<EndGoal, 2> hand;     // left, right
  std::array<EndGoal, 2> foot;

  friend bool operator==(const BodyGoals&, const BodyGoals&) = default;
};

/// The relaxed stance in which every motion begins and ends.
BodyGoals StandingGoals();

/// The posture with left and right exchanged.
BodyGoals Mirrored(const BodyGoals& posture);

/// A posture at an instant.
struct MotionKey {
  double time = 0.0;  // seconds
  BodyGoals posture;
};

/// A motion written by hand: see the README of this folder for the file format.
struct MotionScript {
  std::string name;             // a word: "arms_crossed"
  std::string study;            // the paper's name, "M1" to "M9"; empty for others
  std::string title;            // for a person: "Arms crossed"
  double lead = 1.0;            // how much hips, spine and head go before the hands
  double breath = 1.0;          // how deep the performer breathes and sways
  std::vector<MotionKey> keys;  // at least two, times grow

  double Duration() const { return keys.empty() ? 0.0 : keys.back().time; }
};

}  // namespace ego
