// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/body/body_surface.h"
#include "core/model/character.h"

namespace ego {

/// A place on a character's skin that stays there whatever the pose: a triangle of one of its
/// parts and the weights of its three corners.
struct MeshPoint {
  int part = -1;                    // into Character::parts; -1: nowhere
  std::uint32_t triangle = 0;       // of that part
  Vec3 barycentric{1.0, 0.0, 0.0};  // not negative, sums to one; a vertex has one weight of 1

  friend bool operator==(const MeshPoint&, const MeshPoint&) = default;
};

/// Whether the point names a triangle of this character and its weights are proper.
bool IsOn(const Character& character, const MeshPoint& point);

/// The point at one corner (0 to 2) of a triangle: what clicking a vertex picks.
MeshPoint AtCorner(int part, std::uint32_t triangle, int corner);

/// Skinned vertex positions of a whole character, world space, metres: one list for each part.
struct PosedMesh {
  std::vector<std::vector<Vec3>> position_ws;
};

/// Linear blend skinning of every vertex. `node_global` as PoseNodes writes it.
PosedMesh PoseMesh(const Character& character, std::span<const Mat4> node_global);

/// The mesh in the canonical pose: stage space, metres, soles on the ground.
PosedMesh CanonicalMesh(const Character& character);

/// One matrix for each palette entry: from bind space to world space.
std::vector<Mat4> SkinMatrices(const Character& character, std::span<const Mat4> node_global);

/// Linear blend skinning of one vertex, and of one point of the skin (IsOn); world space, metres.
Vec3 SkinVertex(const MeshPart& part, std::span<const Mat4> skin_matrices, std::size_t vertex);
Vec3 PosePoint(const Character& character, std::span<const Mat4> skin_matrices,
               const MeshPoint& point);

/// Where a point of the skin is on a posed mesh. The point must be on the character (IsOn).
Vec3 Position(const Character& character, const PosedMesh& mesh, const MeshPoint& point);

/// How much of a vertex each humanoid joint carries: its skin weights, every node counted for the
/// joint that drives it. Sums to one.
std::array<double, kJointCount> JointShares(const Character& character, const MeshPart& part,
                                            std::size_t vertex);

/// The four joints that carry a point of the skin most, their shares made to sum to one. With at
/// most four humanoid joints at the triangle a point attached so follows the skin exactly.
Attachment AttachmentAt(const Character& character, const MeshPoint& point);

/// A number that changes with the positions, the triangles or the number of parts: tells a
/// calibration made for this mesh from one made for another. FNV-1a, 64 bits.
std::uint64_t MeshHash(const Character& character);

}  // namespace ego
