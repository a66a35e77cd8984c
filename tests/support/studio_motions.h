// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/motions/true_contact.h"
#include "core/base/result.h"
#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego::test {

/// The studio's cast and its shipped motions for tests of the layers below: bodies with their
/// exact calibration, and poses of the performer. Made once when the tests are built
/// (record_studio.cpp), because a person takes half a second to make and every test is a process of
/// its own; read in a few milliseconds. A missing recording ends the program with a sentence.

/// One touch of a motion: what assets/motions knows of it, without the place.
struct StudioTouch {
  double from_s = 0.0;
  double to_s = 0.0;
  std::size_t side = 0;  // 0: left hand or foot; 1: right
  bool foot = false;
  TouchFace face = TouchFace::kPalm;
  HumanoidJoint on = HumanoidJoint::kChest;
  bool plate = false;  // not skin but a plate is touched
};

/// A shipped motion, done by the performer.
struct StudioMotion {
  std::string name;  // "arms_crossed"
  std::vector<Pose> poses;
  std::vector<StudioTouch> touches;  // in order of time
};
inline constexpr double kStudioRate = 60.0;  // frames per second

/// Everybody of the demo's cast by name, in its order: "Performer", "Child", ... It must exist.
const Body& StudioBody(std::string_view name);
/// Whose motions these are.
const Body& StudioPerformer();
/// Other proportions: woman, child, alien, big belly, long arms. (The robot's are the performer's.)
const std::vector<Body>& StudyBodies();

const std::vector<StudioMotion>& StudioMotions();
/// It must exist.
const StudioMotion& Motion(std::string_view name);

/// The performer at one instant of a motion.
struct StudioPosture {
  std::string name;  // of the motion
  Pose pose;
};
/// One posture of every motion: in the middle of its longest touch of skin, or, when it has none,
/// half-way through. After them standing.
const std::vector<StudioPosture>& StudioPostures();
/// The one of a motion, or "standing".
const Pose& Posture(std::string_view name);

/// A performer's pose as a body of any proportions takes it at its joint angles: joints that it
/// cannot turn stay, the root is as high as its legs have it.
Pose PoseOn(const Body& body, const Pose& performer_pose);

/// Performs all of it and writes it down for the other functions.
Result<void> RecordStudio(const std::filesystem::path& path);

}  // namespace ego::test
