// SPDX-License-Identifier: MIT
#include "assets/people/person.h"

#include <utility>

namespace ego {
namespace {

constexpr glm::vec3 Srgb(unsigned hex) {
  return {static_cast<float>(hex >> 16 & 0xffu) / 255.0f,
          static_cast<float>(hex >> 8 & 0xffu) / 255.0f, static_cast<float>(hex & 0xffu) / 255.0f};
}

PersonParameters Child() {
  PersonParameters m;
  m.name = "Child";
  m.height = 1.20;
  m.arm_length = 0.38;
  m.leg_length = 0.48;
  m.ankle_height = 0.062;
  m.upper_arm_radius = 0.05;
  m.lower_arm_radius = 0.04;
  m.upper_leg_radius = 0.06;
  m.lower_leg_radius = 0.05;
  m.shoulder_width = 0.25;
  m.hip_joint_width = 0.145;
  m.chest_width = 0.25;
  m.chest_depth = 0.165;
  m.waist_width = 0.235;
  m.belly_thickness = 0.17;
  m.hips_width = 0.255;
  m.hips_depth = 0.17;
  m.neck_length = 0.035;
  m.neck_radius = 0.045;
  m.head_height = 0.225;
  m.head_width = 0.165;
  m.head_depth = 0.19;
  m.eye_size = 1.25;
  m.nose_size = 0.8;
  m.hand_length = 0.135;
  m.foot_length = 0.19;
  m.hair = Hair::kShort;
  m.trouser_end = 0.72;
  m.sleeve_end = 0.55;
  m.skin_color = Srgb(0xE8B896);
  m.shirt_color = Srgb(0x35C0A6);
  m.trouser_color = Srgb(0x39506B);
  m.shoe_color = Srgb(0xE7E3DA);
  m.hair_color = Srgb(0xB07A3C);
  m.trim_color = Srgb(0xF3F1E6);
  m.sole_color = Srgb(0xE2574C);
  m.eye_color = Srgb(0x3E6E9E);
  m.jaw = 0.0;
  return m;
}

PersonParameters Alien() {
  PersonParameters m;
  m.name = "Alien";
  m.height = 1.52;
  m.arm_length = 0.42;
  m.leg_length = 0.66;
  m.ankle_height = 0.06;
  m.upper_arm_radius = 0.03;
  m.lower_arm_radius = 0.02;
  m.upper_leg_radius = 0.05;
  m.lower_leg_radius = 0.02;
  m.shoulder_width = 0.24;
  m.hip_joint_width = 0.15;
  m.chest_width = 0.22;
  m.chest_depth = 0.17;
  m.waist_width = 0.29;
  m.belly_thickness = 0.27;
  m.hips_width = 0.25;
  m.hips_depth = 0.20;
  m.neck_length = 0.06;
  m.neck_radius = 0.034;
  m.head_height = 0.34;
  m.head_width = 0.285;
  m.head_depth = 0.28;
  m.eye_size = 1.7;
  m.nose_size = 0.55;
  m.ear_size = 0.8;
  m.hand_length = 0.18;
  m.foot_length = 0.22;
  m.hair = Hair::kNone;
  m.sleeve_end = 1.75;
  m.trouser_end = 1.82;
  m.skin_color = Srgb(0x9CC8A4);
  m.shirt_color = Srgb(0x9A80FF);
  m.trouser_color = Srgb(0x5B4AA6);
  m.shoe_color = Srgb(0x35304A);
  m.trim_color = Srgb(0x6A54C8);
  m.sole_color = Srgb(0x9A80FF);
  m.eye_color = Srgb(0xD98A1E);
  m.jaw = 0.0;
  return m;
}

PersonParameters Woman() {
  PersonParameters m;
  m.name = "Woman";
  m.height = 1.68;
  m.arm_length = 0.51;
  m.leg_length = 0.80;
  m.ankle_height = 0.075;
  m.upper_arm_radius = 0.05;
  m.lower_arm_radius = 0.04;
  m.upper_leg_radius = 0.08;
  m.lower_leg_radius = 0.04;
  m.shoulder_width = 0.31;
  m.hip_joint_width = 0.185;
  m.chest_width = 0.275;
  m.chest_depth = 0.19;
  m.bust = 0.038;
  m.waist_width = 0.235;
  m.belly_thickness = 0.16;
  m.hips_width = 0.345;
  m.hips_depth = 0.225;
  m.neck_length = 0.075;
  m.neck_radius = 0.044;
  m.head_height = 0.215;
  m.head_width = 0.145;
  m.head_depth = 0.185;
  m.eye_size = 1.1;
  m.nose_size = 0.85;
  m.hand_length = 0.17;
  m.foot_length = 0.24;
  m.hair = Hair::kBun;
  m.sleeve_end = 0.40;
  m.trouser_end = 1.70;
  m.skin_color = Srgb(0xC98F6B);
  m.shirt_color = Srgb(0xFF7D6E);
  m.trouser_color = Srgb(0x37323F);
  m.shoe_color = Srgb(0x4F6D8F);
  m.hair_color = Srgb(0x3A2620);
  m.trim_color = Srgb(0xD65A50);
  m.sole_color = Srgb(0xF4F1EC);
  m.eye_color = Srgb(0x5B7A3A);
  m.jaw = 0.1;
  return m;
}

PersonParameters BigBelly() {
  PersonParameters m;
  m.name = "Big belly";
  m.height = 1.66;
  m.arm_length = 0.46;
  m.leg_length = 0.72;
  m.ankle_height = 0.08;
  m.upper_arm_radius = 0.062;
  m.lower_arm_radius = 0.048;
  m.upper_leg_radius = 0.094;
  m.lower_leg_radius = 0.062;
  m.shoulder_width = 0.37;
  m.hip_joint_width = 0.225;
  m.chest_width = 0.38;
  m.chest_depth = 0.29;
  m.bust = 0.02;
  m.waist_width = 0.47;
  m.belly_thickness = 0.45;
  m.hips_width = 0.43;
  m.hips_depth = 0.30;
  m.neck_length = 0.045;
  m.neck_radius = 0.067;
  m.head_height = 0.225;
  m.head_width = 0.175;
  m.head_depth = 0.20;
  m.nose_size = 1.2;
  m.hand_length = 0.165;
  m.foot_length = 0.25;
  m.hair = Hair::kNone;
  m.sleeve_end = 0.70;
  m.skin_color = Srgb(0xE3AE8E);
  m.shirt_color = Srgb(0x5DB4F0);
  m.trouser_color = Srgb(0x4A4438);
  m.shoe_color = Srgb(0x2B2622);
  m.trim_color = Srgb(0x2F6FA8);
  m.sole_color = Srgb(0x6B625A);
  m.eye_color = Srgb(0x4C7FA6);
  m.jaw = 0.5;
  return m;
}

PersonParameters Thin() {
  PersonParameters m;
  m.name = "Long arms";
  m.height = 1.90;
  m.arm_length = 0.73;
  m.leg_length = 0.93;
  m.ankle_height = 0.08;
  m.upper_arm_radius = 0.034;
  m.lower_arm_radius = 0.027;
  m.upper_leg_radius = 0.056;
  m.lower_leg_radius = 0.038;
  m.shoulder_width = 0.33;
  m.hip_joint_width = 0.165;
  m.chest_width = 0.28;
  m.chest_depth = 0.18;
  m.waist_width = 0.215;
  m.belly_thickness = 0.145;
  m.hips_width = 0.275;
  m.hips_depth = 0.18;
  m.neck_length = 0.10;
  m.neck_radius = 0.043;
  m.head_height = 0.225;
  m.head_width = 0.14;
  m.head_depth = 0.185;
  m.hand_length = 0.205;
  m.foot_length = 0.285;
  m.hair = Hair::kBob;
  m.sleeve_end = 1.80;
  m.skin_color = Srgb(0x8A5A3E);
  m.shirt_color = Srgb(0xD77FD0);
  m.trouser_color = Srgb(0x2F3A4A);
  m.shoe_color = Srgb(0xEDE6DB);
  m.hair_color = Srgb(0x2C2422);
  m.trim_color = Srgb(0x9A4F97);
  m.sole_color = Srgb(0x8C6FA8);
  m.eye_color = Srgb(0x3B2A20);
  m.jaw = 0.2;
  return m;
}

PersonParameters Robot() {
  PersonParameters m;
  m.name = "Robot";
  m.style = PersonStyle::kRobot;
  m.height = 1.60;
  m.arm_length = 0.50;
  m.leg_length = 0.70;
  m.ankle_height = 0.085;
  m.upper_arm_radius = 0.042;
  m.lower_arm_radius = 0.044;
  m.upper_leg_radius = 0.062;
  m.lower_leg_radius = 0.058;
  m.shoulder_width = 0.40;
  m.hip_joint_width = 0.19;
  m.chest_width = 0.34;
  m.chest_depth = 0.25;
  m.waist_width = 0.24;
  m.belly_thickness = 0.20;
  m.hips_width = 0.30;
  m.hips_depth = 0.24;
  m.neck_length = 0.06;
  m.neck_radius = 0.045;
  m.head_height = 0.27;
  m.head_width = 0.29;
  m.head_depth = 0.26;
  m.hand_length = 0.19;
  m.foot_length = 0.27;
  m.skin_color = Srgb(0xD5D9DC);
  m.shirt_color = Srgb(0xB5C94C);
  m.trouser_color = Srgb(0x4A5058);
  m.shoe_color = Srgb(0x3A3F46);
  m.hair_color = Srgb(0x15191F);
  return m;
}

/// The performer's clothes and face on a body of other girth or height.
PersonParameters Slimmer() {
  PersonParameters m;
  m.name = "Performer, slimmer";
  m.upper_arm_radius = 0.039;
  m.lower_arm_radius = 0.032;
  m.upper_leg_radius = 0.064;
  m.lower_leg_radius = 0.045;
  m.shoulder_width = 0.335;
  m.chest_width = 0.295;
  m.chest_depth = 0.20;
  m.waist_width = 0.245;
  m.belly_thickness = 0.17;
  m.hips_width = 0.31;
  m.hips_depth = 0.205;
  m.neck_radius = 0.046;
  m.head_width = 0.158;
  m.hair = Hair::kCurls;
  m.skin_color = Srgb(0x9A6A4A);
  m.hair_color = Srgb(0x2A1F1A);
  m.shirt_color = Srgb(0xD9A441);
  m.trim_color = Srgb(0x7A5A20);
  m.jaw = 0.35;
  return m;
}

PersonParameters Heavier() {
  PersonParameters m;
  m.name = "Performer, heavier";
  m.upper_arm_radius = 0.060;
  m.lower_arm_radius = 0.046;
  m.upper_leg_radius = 0.092;
  m.lower_leg_radius = 0.061;
  m.shoulder_width = 0.375;
  m.hip_joint_width = 0.205;
  m.chest_width = 0.385;
  m.chest_depth = 0.285;
  m.waist_width = 0.385;
  m.belly_thickness = 0.315;
  m.hips_width = 0.40;
  m.hips_depth = 0.275;
  m.neck_radius = 0.064;
  m.head_width = 0.178;
  m.hair = Hair::kCrop;
  m.skin_color = Srgb(0xE0B090);
  m.hair_color = Srgb(0x6B4A2E);
  m.shirt_color = Srgb(0xC98A2E);
  m.trim_color = Srgb(0x6E4714);
  m.jaw = 0.7;
  return m;
}

PersonParameters Taller() {
  PersonParameters m;
  m.name = "Performer, taller";
  m.height = 1.96;
  m.arm_length = 0.615;
  m.leg_length = 0.95;
  m.ankle_height = 0.086;
  m.upper_arm_radius = 0.050;
  m.lower_arm_radius = 0.039;
  m.upper_leg_radius = 0.080;
  m.lower_leg_radius = 0.055;
  m.shoulder_width = 0.39;
  m.chest_width = 0.355;
  m.chest_depth = 0.245;
  m.waist_width = 0.305;
  m.belly_thickness = 0.22;
  m.hips_width = 0.36;
  m.neck_length = 0.062;
  m.head_height = 0.25;
  m.hand_length = 0.205;
  m.foot_length = 0.295;
  m.hair = Hair::kShort;
  m.skin_color = Srgb(0x6F4630);
  m.hair_color = Srgb(0x1E1714);
  m.shirt_color = Srgb(0xE9B45C);
  m.trim_color = Srgb(0x7A5520);
  return m;
}

}  // namespace

std::vector<PersonParameters> DemoCast() {
  return {PersonParameters{}, Child(), Alien(), Woman(), BigBelly(), Thin(), Robot()};
}

std::vector<PersonParameters> StudioCast() {
  std::vector<PersonParameters> cast = DemoCast();
  for (PersonParameters variant : {Slimmer(), Heavier(), Taller()}) {
    cast.push_back(std::move(variant));
  }
  return cast;
}

}  // namespace ego
