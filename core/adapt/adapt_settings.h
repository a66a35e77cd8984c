// SPDX-License-Identifier: MIT
#pragma once

namespace ego {

/// Choices of the posture adaptation. Lengths are for a height of 1.78 m and scale with the avatar;
/// the defaults are those of "mdb".
struct AdaptSettings {
  /// Rounds of the main loop of Algorithm 1. More do not converge: planes, folding and relations
  /// are no contraction together, and the motion gets rougher. 0: no limb is adapted.
  int main_iterations = 1;
  /// maxLCount. 1: interacting limbs do not share the way to each other. Above 3: rougher.
  int limb_iterations = 3;
  /// mu of figure 14, radii by which a plane is held back at first. Below 1: planes jerk early
  /// iterations; above 4: more penetration.
  double plane_retreat = 1.5;
  /// Metres over which a violated plane takes hold. 0: kinks; larger: that much may stay violated;
  /// endless: no planes.
  double plane_ramp = 0.018;
  /// Width of the blend between straight and bent, in chord deficit 1 - cos(flexion), where the
  /// captured limb is neither. 0: elbows snap when the reach is exceeded; .05: an arm that reaches
  /// for more than its length ends 1.2 % short of it.
  double arm_reach_softness = 0.05;
  double leg_reach_softness = 0.01;
  /// Metres of a mid joint's gap to the nearest surface at which half of the swivel towards its
  /// target is used (section 6.2). Large: as published; elbows of bodies with other proportions
  /// then flutter about targets that no elbow can reach.
  double swivel_gap = 0.020;
  /// Metres added to the gaps of wrist, palm and fingertip where they are weighed against each
  /// other. 0: the arm jumps from one to the other; large: contacts are left to the last
  /// correction.
  double hand_softness = 0.050;
  /// Metres of gap at which one surface counts as much for a leg as its captured joint angles; what
  /// stands is held by `stance_height` instead. 0: off, surfaces alone count, and thick or short
  /// legs are thrown about as they pass each other; small: crossed legs lose their contact.
  double leg_gap = 0.003;
  /// Metres added to the inverse importances of the arms in gamma (appendix C). 0: as published;
  /// larger: gamma turns slower and ends between both solutions.
  double gamma_softness = 0.020;
  /// Whether every pass of the limb IK starts from the captured angles. Off: from where the last
  /// one ended; twists that are bounded one by one then add up, and near a half turn, where the way
  /// round is undecided, every pass doubles a deviation.
  bool start_from_captured = true;
  /// Whether wrists that relate to each other are solved together and limbs of a pair in one step.
  /// Off: one limb after the other, as the text has it; left and right then differ.
  bool solve_pairs = true;
  /// Whether a limb's end is put back after its base joint turned for a plane, and one pass over
  /// the positions without planes ends the adaptation. Off: planes pull hands off their contacts.
  bool restore_ends = true;
  /// Share of both radii by which legs may sink into each other in that pass. 0: thick legs are
  /// thrown about as they pass each other; 1: short legs that are crossed pass through each other.
  double leg_overlap = 0.5;
  /// Whether hands keep the performer's direction in the world before they are aligned with the
  /// surface. Off: they follow the forearm.
  bool hands_keep_direction = true;
  /// Metres of the performer's own gap at which hands of arms that are too short for their target
  /// use half of the turn towards it. 0: off, they stop short with the hand across; small: slaps
  /// jerk the hand; large: hands that touch nothing lose their direction.
  double hand_reach_gap = 0.180;
  /// Degrees of forward hip flexion where body folding begins and where it is fully allowed
  /// (section 6.4). Lower: a walk nods. Higher: short arms never reach the knees.
  double folding_begin = 15.0;
  double folding_full = 65.0;
  /// Whether the folding angle counts by the legs' share of the arms' importance. Off: as
  /// published; far legs then bend the trunk as much as near ones.
  bool folding_by_share = true;
  /// Height of the sole, metres, below which a foot begins to say how high the root must be for its
  /// leg. 0: off, the root's scale alone says; small: the root moves as the foot comes down.
  double root_height_fade = 0.15;
  /// Height of the sole, metres, below which a foot stands where the root's scale puts it, and
  /// metres above over which that fades. 0: off; large: swinging feet are held too.
  double stance_height = 0.030;
  double stance_fade = 0.090;
  /// Steps of the last correction that keeps arms out of trunk and head and hands on their
  /// contacts. 0: off. Each costs some microseconds near the body.
  int clearance_steps = 3;
  /// Steps after those that follow the hands' contacts alone. 0: what keeps the arm out of a thick
  /// body takes hands off it; large: hands of short arms snap between places.
  int contact_steps = 1;
  /// Steps that bring targets of hands out of trunk and head before the arm reaches for them. 0:
  /// arms that are short for the body reach through it.
  int target_steps = 2;
  /// Metres to which clearance that the performer has is kept. Smaller: thick bodies are cut;
  /// larger: arms are pushed where the performer passes close by.
  double clearance_margin = 0.018;
  /// Metres of the performer's own gap over which a hand's contact fades out. Smaller: contacts
  /// begin suddenly; larger: hands that merely pass are pulled along.
  double contact_fade = 0.060;

  /// The closest reading of the text that is well defined.
  static AdaptSettings Paper() {
    AdaptSettings paper;
    paper.main_iterations = 2;
    paper.plane_ramp = 0.0;
    paper.arm_reach_softness = 0.0;
    paper.leg_reach_softness = 0.0;
    paper.swivel_gap = 1e9;
    paper.hand_softness = 0.0;
    paper.leg_gap = 0.0;
    paper.gamma_softness = 0.0;
    paper.start_from_captured = false;
    paper.solve_pairs = false;
    paper.restore_ends = false;
    paper.hands_keep_direction = false;
    paper.hand_reach_gap = 0.0;
    paper.folding_begin = 0.0;
    paper.folding_full = 0.0;
    paper.folding_by_share = false;
    paper.root_height_fade = 0.0;
    paper.stance_height = 0.0;
    paper.clearance_steps = 0;
    paper.contact_steps = 0;
    paper.target_steps = 0;
    return paper;
  }
};

}  // namespace ego
