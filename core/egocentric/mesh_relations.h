// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/importance.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// The four points of a group on a body in place: what equations 4 to 6 of the paper with appendix
/// A are asked about. Everything in world space and metres.
struct GroupQuery {
  const BodyConstants& constants;
  const PosedBody& posed;
  const BoneDirections& bone_direction;
  std::size_t group = 0;
  bool own_thickness = true;   // whether the points' own thickness fills the distance
  double epsilon = 0.0;        // the distance at which importances saturate
  double gamma_epsilon = 0.0;  // the same for gamma (appendix C)
  double softness = 0.0;       // of the orthogonality
  double floor = 0.0;          // likewise
  double least_factor = 0.0;   // tau is never taken as less
};

/// Importances before normalisation, by point; see ImportanceTotal.
struct Importances {
  Quad sum{};
  Quad max{};
  Quad priority{};
};
using TriangleImportances = std::array<Quad, kTriangleCount>;

/// Relates the points to all triangles and sets `total`; `relations` are before normalisation too.
/// Every point is computed as it would be alone: the same bits for any `lanes`.
void RelateToMeshes(const GroupQuery& query, MeshCoordinates& relations, Importances& total,
                    TriangleImportances& triangle, LaneWidth lanes = FastestLanes());

/// Multiplies what is kept of every point by its own `share`.
void ScaleMeshCoordinates(const Quad& share, std::size_t group, MeshCoordinates& coordinates);

}  // namespace ego
