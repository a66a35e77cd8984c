// SPDX-License-Identifier: MIT
#include "assets/people/person_measure.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace ego {
namespace {

using P = PersonParameters;

constexpr PersonMeasure kMeasures[] = {
    {"height", &P::height, 0.5, 2.6, false},
    {"armLength", &P::arm_length, 0.2, 0.5, true},
    {"upperArmShare", &P::upper_arm_share, 0.4, 0.62, false},
    {"legLength", &P::leg_length, 0.25, 0.62, true},
    {"thighShare", &P::thigh_share, 0.4, 0.62, false},
    {"ankleHeight", &P::ankle_height, 0.03, 0.08, true},
    {"upperArmRadius", &P::upper_arm_radius, 0.012, 0.06, true},
    {"lowerArmRadius", &P::lower_arm_radius, 0.01, 0.05, true},
    {"upperLegRadius", &P::upper_leg_radius, 0.02, 0.085, true},
    {"lowerLegRadius", &P::lower_leg_radius, 0.012, 0.06, true},
    {"shoulderWidth", &P::shoulder_width, 0.12, 0.32, true},
    {"hipJointWidth", &P::hip_joint_width, 0.06, 0.18, true},
    {"chestWidth", &P::chest_width, 0.1, 0.3, true},
    {"chestDepth", &P::chest_depth, 0.07, 0.24, true},
    {"bust", &P::bust, 0.0, 0.05, true},
    {"waistWidth", &P::waist_width, 0.08, 0.34, true},
    {"bellyThickness", &P::belly_thickness, 0.06, 0.34, true},
    {"hipsWidth", &P::hips_width, 0.1, 0.34, true},
    {"hipsDepth", &P::hips_depth, 0.08, 0.24, true},
    {"neckLength", &P::neck_length, 0.01, 0.1, true},
    {"neckRadius", &P::neck_radius, 0.015, 0.055, true},
    {"headHeight", &P::head_height, 0.09, 0.27, true},
    {"headWidth", &P::head_width, 0.06, 0.24, true},
    {"headDepth", &P::head_depth, 0.07, 0.24, true},
    {"eyeSize", &P::eye_size, 0.6, 1.8, false},
    {"noseSize", &P::nose_size, 0.3, 1.6, false},
    {"earSize", &P::ear_size, 0.4, 1.6, false},
    {"jaw", &P::jaw, 0.0, 1.0, false},
    {"handLength", &P::hand_length, 0.07, 0.15, true},
    {"footLength", &P::foot_length, 0.1, 0.2, true},
    {"sleeveEnd", &P::sleeve_end, 0.15, 1.9, false},
    {"trouserEnd", &P::trouser_end, 0.2, 1.95, false},
};

constexpr PersonColor kColors[] = {
    {"skinColor", &P::skin_color}, {"shirtColor", &P::shirt_color},
    {"trimColor", &P::trim_color}, {"trouserColor", &P::trouser_color},
    {"shoeColor", &P::shoe_color}, {"soleColor", &P::sole_color},
    {"hairColor", &P::hair_color}, {"eyeColor", &P::eye_color},
};

}  // namespace

std::span<const PersonMeasure> PersonMeasures() { return kMeasures; }
std::span<const PersonColor> PersonColors() { return kColors; }

Result<void> Validate(const PersonParameters& m) {
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return std::string(text);
  };
  for (const PersonMeasure& measure : PersonMeasures()) {
    const double unit = measure.of_height ? m.height : 1.0;
    const double value = m.*measure.value;
    // Lengths may miss their range by a rounding in their last digit.
    if (std::isfinite(value) && value >= measure.low * unit - 1e-9 &&
        value <= measure.high * unit + 1e-9) {
      continue;
    }
    std::string sentence = "\"";
    sentence += measure.key;
    sentence += "\" is " + number(value) + " but must be from " + number(measure.low * unit) +
                " to " + number(measure.high * unit);
    if (measure.of_height) sentence += " metres for a height of " + number(m.height);
    return Error{std::move(sentence)};
  }
  const double trunk = m.height - m.head_height - m.neck_length - m.leg_length - m.ankle_height;
  if (trunk < 0.18 * m.height || trunk > 0.5 * m.height) {
    return Error{"legs, neck and head leave " + number(trunk) +
                 " metres of the height for the trunk, which needs from " +
                 number(0.18 * m.height) + " to " + number(0.5 * m.height)};
  }
  if (m.hip_joint_width > 0.85 * m.hips_width) {
    return Error{"\"hipJointWidth\" must be less than 0.85 of \"hipsWidth\""};
  }
  return {};
}

}  // namespace ego
