// SPDX-License-Identifier: MIT
#pragma once

#include "core/metrics/surface_gap.h"

namespace ego {

/// Whether an arm can touch a place of its body with a point `beyond_wrist` metres from the wrist,
/// in any posture at all: shoulder, trunk, head and legs where they are, the elbow bent by no more
/// than 155 degrees, the hand by no more than 90 from the forearm, and no bone of the arm deeper in
/// trunk or head than `depth` metres. The skin of arms may sink in by their thickness, so that a
/// body is not excused for thick arms. For a place on the other arm, that arm may move as well:
/// what counts is whether they can meet anywhere, not where somebody put them.
///
/// A search over directions of the hand and swivels of the elbow, independent of any method:
/// milliseconds where there is none.
bool CanTouch(const MeasuredBody& body, Limb arm, const SurfacePlace& place, double beyond_wrist,
              double depth);

/// How deep the bones of an arm that CanTouch minds, up to a point of its hand, lie in trunk or
/// head, metres; zero if nowhere.
double BoneDepth(const MeasuredBody& body, Limb arm, const Vec3& point);

}  // namespace ego
