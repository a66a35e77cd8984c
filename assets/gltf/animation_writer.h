// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "assets/gltf/gltf_document.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/character.h"
#include "core/skeleton/pose.h"

namespace ego {

/// Poses at times 0, 1 / rate_hz, ...
struct PoseAnimation {
  std::string_view name;
  std::span<const Pose> poses;
  double rate_hz = 0.0;
};

/// Replaces the animations of a document by one that plays on the character. `node_of`
/// gives the document's node of each node of the character; nodes of skinned meshes keep their
/// transform (it has no meaning).
///
/// Nodes stand as in the first pose. What lies above the hips and moves nothing stays where it is
/// in the canonical pose; it carries the change of axes and unit. Only nodes whose driver differs
/// from their parent's turn against it, so only they (and the hips) get channels.
Result<void> PutAnimation(GltfDocument& document, std::span<const int> node_of,
                          const Character& character, const PoseAnimation& animation,
                          const Progress& progress);

}  // namespace ego
