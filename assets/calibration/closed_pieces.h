// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/character.h"
#include "core/model/mesh_point.h"

namespace ego {

/// How each triangle, by part and number, belongs to a watertight piece of the mesh: 1 when it
/// does and its winding faces out of the piece, -1 when it faces in, 0 when the piece is open (a
/// cape, a skirt, a card of hair). Vertices at one position are one vertex, across parts too.
std::vector<std::vector<std::int8_t>> ClosedPieces(const Character& character,
                                                   const PosedMesh& mesh);

}  // namespace ego
