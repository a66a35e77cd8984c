// SPDX-License-Identifier: MIT
#pragma once

#include "core/egocentric/mesh_relations.h"

namespace ego {

/// What the four points of a group have to one capsule each; see CapsuleRelation. Importances are
/// before normalisation.
struct CapsuleQuad {
  Quad importance;
  Quad axial;
  QuadVectors direction_ls;
};

/// Relates the points to the capsules of `RelatesToCapsule`: equations 4 to 6 with appendix A. Adds
/// the importances to the sum, largest and priority in `total`. The same bits for any `lanes`.
void RelateToCapsules(const GroupQuery& query, const EgocentricForm& form,
                      std::array<CapsuleQuad, kOtherCapsuleCount>& relations,
                      GroupDistances& distances, Importances& total,
                      LaneWidth lanes = FastestLanes());

/// R' inside + tau' gap for every point and capsule of a group on a body with these constants:
/// equation 5 reversed. Those of other capsules are 0.
void CapsuleReaches(const Body& body, const BodyConstants& constants, const EgocentricForm& form,
                    std::size_t group, const GroupDistances& distances,
                    std::array<Quad, kOtherCapsuleCount>& reach);

}  // namespace ego
