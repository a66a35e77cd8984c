// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "core/body/body.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Triangles to draw, world space, metres.
struct TriangleSink {
  std::vector<glm::vec3>& positions;
  std::vector<glm::vec3>& normals;      // unit
  std::vector<std::uint32_t>& indices;  // counted from the first vertex of the mesh
};

/// A tapered limb, bone, ball (equal ends) as the capsule shader takes it.
struct CapsuleInstance {
  glm::vec4 end_a;  // centre, world space, and radius
  glm::vec4 end_b;
  glm::vec4 color;  // linear, with opacity
};

/// The parts of a posed body surface that are meshes: trunk and head as the method knows them,
/// with faint facets; hands and feet in the plain shape that their measured points allow.
void AppendBodyMesh(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                    TriangleSink& sink);

/// The parts that are capsules: the eight limb segments; neck and thumbs, which the method does
/// not know, so that the body looks whole.
void AppendBodyCapsules(const Body& body, const ModelPose& pose, const Vec3& offset_ws,
                        const glm::vec4& color, std::vector<CapsuleInstance>& out);

/// Joints as balls and bones as tapered capsules, with short bones that show where the head and
/// the hands point.
void AppendSkeletonCapsules(const Skeleton& skeleton, const ModelPose& pose, const Vec3& offset_ws,
                            const glm::vec4& color, std::vector<CapsuleInstance>& out);

}  // namespace ego
