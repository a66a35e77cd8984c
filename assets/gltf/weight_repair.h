// SPDX-License-Identifier: MIT
#pragma once

#include "assets/gltf/gltf_document.h"

namespace ego {

/// Scales skin weights (float accessors) so that each vertex's sum is one, as glTF 2.0 demands and
/// some files do not keep. Weights that are right already keep their bits. Accessors that are
/// malformed, sparse or integer are left alone.
void NormalizeWeights(GltfDocument& document);

}  // namespace ego
