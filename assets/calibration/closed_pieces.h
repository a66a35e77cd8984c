// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/character.h"
#include "core/model/mesh_point.h"

namespace ego {

/// To which watertight piece of the mesh each triangle, by part and number, belongs: the piece's
/// number (from 1), negative when its triangles are wound to face inward, 0 when the piece is open
/// (a cape, a skirt, a card of hair). Vertices at one position are one vertex, across parts too.
std::vector<std::vector<std::int32_t>> ClosedPieces(const Character& character,
                                                    const PosedMesh& mesh);

}  // namespace ego
