// SPDX-License-Identifier: MIT
#include <vector>

#include <tiny_gltf.h>

#include "assets/gltf/image_decoder.h"
#include "assets/gltf/scene_reader.h"

namespace ego {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

bool InRange(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

/// Decodes the images that are drawn, each once.
class Textures {
 public:
  Textures(const tinygltf::Model& model, Character& character)
      : model_(model), character_(character), tried_(model.images.size(), false) {
    character_.images.resize(model.images.size());
  }

  /// Image of a texture, -1 when it has none that can be decoded.
  int ImageOf(int texture) {
    if (!InRange(texture, model_.textures.size())) return -1;
    const tinygltf::Texture& source = model_.textures[At(texture)];
    if (const auto webp = source.extensions.find("EXT_texture_webp");
        webp != source.extensions.end()) {
      const tinygltf::Value& index = webp->second.Get("source");
      if (index.IsInt() && Decode(index.GetNumberAsInt())) return index.GetNumberAsInt();
    }
    if (Decode(source.source)) return source.source;
    character_.notes.push_back("texture " + std::to_string(texture) +
                               " is no PNG, JPEG or WebP that can be decoded: its material is "
                               "drawn with its base colour");
    return -1;
  }

 private:
  /// Pixels of all images of a character together.
  static constexpr std::size_t kMaxPixels = std::size_t{1} << 27;

  bool Decode(int index) {
    if (!InRange(index, character_.images.size())) return false;
    Image& image = character_.images[At(index)];
    if (!tried_[At(index)]) {
      tried_[At(index)] = true;
      if (auto decoded = DecodeImage(model_.images[At(index)].image, left_)) {
        left_ -= decoded->rgba.size() / 4;
        image = *std::move(decoded);
      }
    }
    return image.width > 0;
  }

  const tinygltf::Model& model_;
  Character& character_;
  std::vector<bool> tried_;
  std::size_t left_ = kMaxPixels;
};

}  // namespace

Result<void> ReadMaterials(const tinygltf::Model& model, Character& character) {
  Textures textures(model, character);
  for (const tinygltf::Material& source : model.materials) {
    Material material;
    material.name = source.name;
    const std::vector<double>& color = source.pbrMetallicRoughness.baseColorFactor;
    if (color.size() == 4) material.base_color = {color[0], color[1], color[2], color[3]};
    int texture = source.pbrMetallicRoughness.baseColorTexture.index;
    // The older specular-glossiness model keeps its colour elsewhere.
    const auto glossy = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (glossy != source.extensions.end() && texture < 0) {
      const tinygltf::Value& factor = glossy->second.Get("diffuseFactor");
      for (int c = 0; c < 4 && factor.IsArray() && factor.ArrayLen() == 4; ++c) {
        if (factor.Get(c).IsNumber()) {
          material.base_color[c] = static_cast<float>(factor.Get(c).GetNumberAsDouble());
        }
      }
      const tinygltf::Value& index = glossy->second.Get("diffuseTexture").Get("index");
      if (index.IsInt()) texture = index.GetNumberAsInt();
    }
    if (texture >= 0) material.base_color_image = textures.ImageOf(texture);
    material.double_sided = source.doubleSided;
    material.alpha_mask = source.alphaMode == "MASK";
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.blend = source.alphaMode == "BLEND";
    character.materials.push_back(std::move(material));
  }
  return {};
}

}  // namespace ego
