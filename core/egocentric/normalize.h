// SPDX-License-Identifier: MIT
#pragma once

#include "core/body/body.h"
#include "core/egocentric/egocentric_pose.h"

namespace ego {

/// Choices of the normalisation. Lengths are for a height of 1.78 m and scale with the performer.
struct NormalizeSettings {
  EgocentricForm form;

  /// Metres below which the importance of a surface no longer grows. Smaller: contacts are held
  /// harder by the mean itself, and marker noise of that size shakes the limb. Larger: contacts are
  /// left to the last correction (AdaptSettings::clearance_steps).
  double surface_epsilon = 0.020;
  /// The same for the ground. Feet stand still only when it is small.
  double ground_epsilon = 0.0004;
  /// The same for gamma of appendix C. Smaller: the elbow jumps when a wrist leaves a contact.
  /// Larger: elbows that touch something give way to wrists that do not.
  double gamma_epsilon = 0.010;
  /// Metres over which the orthogonality is softened. 0: it jumps when a point passes through a
  /// face. Larger: faces seen from the side gain weight.
  double orthogonality_softness = 0.005;
  /// Least orthogonality. 0: the far side of the trunk has no say; .1: it pulls noticeably.
  double orthogonality_floor = 0.02;

  /// The closest reading of the text that is well defined.
  static NormalizeSettings Paper();
};

/// The egocentric normalisation of a posture (section 5): reads the performer alone.
///
/// Continuous in the pose but where a closest point jumps (its importance is then shared with what
/// it jumps to). Singular cases: a point on a triangle has the triangle's normal as direction; a
/// point on a capsule's axis, and axes that cross, the frame's second axis; both are multiplied by
/// a distance of zero (points) or relaxed away by the slack (planes).
void Normalize(const Body& performer, const Pose& pose, const NormalizeSettings& settings,
               EgocentricPose& out);

}  // namespace ego
