// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "core/egocentric/egocentric_pose.h"
#include "core/egocentric/importance.h"
#include "core/egocentric/posed_body.h"

namespace ego {

/// How far a limb point is from the triangles of one crude mesh: equations 4 to 6 of the paper with
/// appendix A. Everything in world space and metres.
struct MeshQuery {
  const BodyConstants& constants;
  const PosedBody& posed;
  const MeshPaths& paths;  // from the mesh to the point
  Vec3 point{0.0};
  double thickness = 0.0;     // the point's own
  double softness = 0.0;      // of the orthogonality
  double floor = 0.0;         // likewise
  double least_factor = 0.0;  // tau is never taken as less
};

/// Relates the point to the triangle pairs from `first` up to `end`. Adds the importances, before
/// normalisation, to `total`, those of the triangles to `triangle`, and their share of every sample
/// to `sample`. The same bits for any `lanes`.
MeshRelations RelateToMesh(const MeshQuery& query, std::size_t first, std::size_t end,
                           ImportanceTotal& total, std::array<Lanes, kTrianglePairCount>& triangle,
                           std::array<double, kSampleCount>& sample,
                           LaneWidth lanes = FastestLanes());

}  // namespace ego
