// SPDX-License-Identifier: MIT
#pragma once

#include "core/body/body.h"
#include "core/skeleton/pose.h"
#include "render/triangle_sink.h"

namespace ego {

/// How the crude trunk and head meshes look.
enum class CrudeLook {
  kFacets,   // exactly as the method knows them
  kRounded,  // curved between the same corners, as a body is
};

/// A posed body surface: trunk and head, the limbs' capsules, hands and feet in the plain shape
/// that their measured points allow; neck and thumbs, which the method does not know, so that the
/// body looks whole.
void AppendBody(const Body& body, const ModelPose& pose, const Vec3& offset_ws, CrudeLook look,
                TriangleSink& sink);

/// Joints as balls and bones as tapered capsules, with short bones that show where the head and
/// the hands point. Virtual joints (bones without length) are left out.
void AppendSkeleton(const Skeleton& skeleton, const ModelPose& pose, const Vec3& offset_ws,
                    TriangleSink& sink);

}  // namespace ego
