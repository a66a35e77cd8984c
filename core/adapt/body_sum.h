// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// Equation 2 over trunk and head for the points of a group: they stand still while the limbs are
/// adapted, so their part of the sum is taken once.
struct BodySum {
  QuadVectors trunk;  // sums of lambda-hat (x + v)
  QuadVectors head;
};

/// The sums for `group` on a body in place; `own_thickness` as in EgocentricForm. The same bits for
/// any `lanes`.
BodySum SumOverBody(const MeshCoordinates& mesh, const BodyConstants& constants,
                    const PosedBody& posed, std::size_t group, bool own_thickness,
                    LaneWidth lanes = FastestLanes());

/// Equation 3 over trunk and head: what they ask of the normal of a hand or foot. Likewise.
Vec3 SumOfNormals(const NormalCoordinates& normal, const PosedBody& posed,
                  LaneWidth lanes = FastestLanes());

}  // namespace ego
