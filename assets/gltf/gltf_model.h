// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "assets/gltf/gltf_document.h"
#include "core/base/result.h"

namespace tinygltf {
class Model;
}

namespace ego {

struct DeleteModel {
  void operator()(tinygltf::Model* model) const;
};
using ModelPtr = std::unique_ptr<tinygltf::Model, DeleteModel>;

/// Parses a document with tinygltf. Touches no file. Images hold the bytes of their file, not
/// decoded. Error: the sentence of the parser, with the file's name.
Result<ModelPtr> ParseModel(const GltfDocument& document);

}  // namespace ego
