// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/importance.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// How far the four points of a group are from the triangles of both crude meshes: equations 4 to 6
/// of the paper with appendix A. Everything in world space and metres.
struct MeshQuery {
  const BodyConstants& constants;
  const PosedBody& posed;
  std::size_t group = 0;
  bool own_thickness = true;   // whether the points' own thickness fills the distance
  double epsilon = 0.0;        // the distance at which importances saturate
  double gamma_epsilon = 0.0;  // the same for gamma (appendix C)
  double softness = 0.0;       // of the orthogonality
  double floor = 0.0;          // likewise
  double least_factor = 0.0;   // tau is never taken as less
};

/// Importances before normalisation, by point.
struct MeshImportances {
  Quad sum;
  Quad max;
  Quad priority;  // see ImportanceTotal
  std::array<Quad, kTriangleCount> triangle;
};

/// Relates the points to all triangles; `relations` are before normalisation too. Every point is
/// computed as it would be alone: the same bits for any `lanes`.
void RelateToMeshes(const MeshQuery& query, MeshCoordinates& relations,
                    MeshImportances& importances, LaneWidth lanes = FastestLanes());

/// Multiplies what is kept of every point by its own `share`.
void ScaleMeshCoordinates(const Quad& share, std::size_t group, MeshCoordinates& coordinates);

}  // namespace ego
