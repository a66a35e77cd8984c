// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/result.h"
#include "core/body/body.h"
#include "core/model/character.h"

namespace ego {

/// How the surface of a person is made.
enum class PersonStyle {
  kSoft,   // one closed skin that bends
  kRobot,  // closed parts, each rigid on one joint
};

enum class Hair { kNone, kShort, kCrop, kBob, kBun, kCurls };

/// The page of measurements a person is made from. Lengths in metres; the defaults are the
/// performer's. Limb radii are means over the middle of the segment, clothes included.
struct PersonParameters {
  std::string name = "Performer";
  PersonStyle style = PersonStyle::kSoft;

  double height = 1.78;            // ground to crown, hair included
  double arm_length = 0.55;        // shoulder joint to wrist joint
  double upper_arm_share = 0.527;  // of the arm's length
  double leg_length = 0.84;        // hip joint to ankle joint
  double thigh_share = 0.512;      // of the leg's length
  double ankle_height = 0.08;
  double upper_arm_radius = 0.048;
  double lower_arm_radius = 0.037;
  double upper_leg_radius = 0.076;
  double lower_leg_radius = 0.052;

  double shoulder_width = 0.35;   // between the shoulder joints
  double hip_joint_width = 0.19;  // between the hip joints
  double chest_width = 0.33;      // outer breadth of the rib cage
  double chest_depth = 0.235;
  double bust = 0.0;  // how far the breasts stand out
  double waist_width = 0.29;
  double belly_thickness = 0.215;  // front to back at the navel
  double hips_width = 0.345;       // outer breadth of the pelvis
  double hips_depth = 0.235;

  double neck_length = 0.05;  // from the neck joint to the height of the chin
  double neck_radius = 0.053;
  double head_height = 0.24;  // chin to crown
  double head_width = 0.165;
  double head_depth = 0.205;
  double eye_size = 1.0;   // relative to the head
  double nose_size = 1.0;  // relative to the head
  double ear_size = 1.0;   // relative to the head
  double jaw = 0.5;        // from a soft oval (0) to square corners (1)

  double hand_length = 0.185;  // wrist joint to the tip of the middle finger
  double foot_length = 0.27;

  Hair hair = Hair::kShort;
  double sleeve_end = 0.62;   // share of the upper arm that the sleeve covers; above 1: forearm
  double trouser_end = 1.94;  // 1: down to the knee, 2: down to the ankle
  // sRGB in [0, 1]
  glm::vec3 skin_color{0.80f, 0.58f, 0.45f};
  glm::vec3 shirt_color{0.914f, 0.635f, 0.231f};
  glm::vec3 trim_color{0.45f, 0.27f, 0.10f};  // collar and cuffs
  glm::vec3 trouser_color{0.20f, 0.25f, 0.33f};
  glm::vec3 shoe_color{0.86f, 0.86f, 0.84f};
  glm::vec3 sole_color{0.30f, 0.31f, 0.33f};
  glm::vec3 hair_color{0.29f, 0.19f, 0.13f};
  glm::vec3 eye_color{0.36f, 0.24f, 0.15f};  // of the iris
};

/// A generated character together with its calibration, known exactly.
struct Person {
  Character character;
  /// Sample points lie on the character's mesh in the canonical pose; attachments are the mesh's
  /// own skin weights there; limb radii, hands and feet are measured on the mesh.
  Body body;
};

/// Makes the mesh, skin, rig and calibration of a person in the T-pose. Deterministic: equal
/// parameters give bit-equal results. Takes up to about a second.
///
/// The mesh is closed; its parts (skin, shirt, ...) meet in vertices of equal position and weights.
/// Nodes: the 22 joints (VRM 1.0 names), fingertips and toe tips; all world-aligned.
Person MakePerson(const PersonParameters& parameters);

/// Whether a person can be made of these measurements: each within its range, and together such
/// that a trunk is left between legs and head. The sentence names the measurement and its range.
Result<void> Validate(const PersonParameters& parameters);

/// The whole cast. The performer comes first, then those of DemoCast, then the performer's slimmer,
/// heavier and taller variants.
std::vector<PersonParameters> StudioCast();

/// The cast of the demo, the performer first, then six avatars of different proportions: child,
/// alien and woman with the measurements of the paper's appendix E, a short-armed one with a big
/// belly, a long-armed thin one, a robot. Shirts follow the colours that avatars have in every
/// view, in this order.
std::vector<PersonParameters> DemoCast();

}  // namespace ego
