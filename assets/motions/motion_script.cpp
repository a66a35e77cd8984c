// SPDX-License-Identifier: MIT
#include "assets/motions/motion_script.h"

#include <utility>

namespace ego {

BodyGoals StandingGoals() {
  BodyGoals posture;
  posture.root.y = -0.006;
  posture.spine.pitch = 1.0;
  posture.head.pitch = -1.0;
  for (EndGoal& hand : posture.hand) {
    hand.at = {0.075, -0.615, 0.035};
    hand.palm = {-1.0, 0.0, -0.25};
    hand.pointing = {-0.05, -1.0, 0.12};
    hand.pole = {0.25, 0.0, -1.0};
  }
  for (EndGoal& foot : posture.foot) foot.pointing = {0.0, 0.0, 1.0};
  return posture;
}

BodyGoals Mirrored(const BodyGoals& posture) {
  BodyGoals mirrored = posture;
  mirrored.root.x = -posture.root.x;
  for (Bend* bend : {&mirrored.hips, &mirrored.spine, &mirrored.head}) {
    bend->yaw = -bend->yaw;
    bend->roll = -bend->roll;
  }
  std::swap(mirrored.shoulder[0], mirrored.shoulder[1]);
  std::swap(mirrored.hand[0], mirrored.hand[1]);
  std::swap(mirrored.foot[0], mirrored.foot[1]);
  return mirrored;
}

}  // namespace ego
