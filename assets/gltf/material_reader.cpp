// SPDX-License-Identifier: MIT
#include <cstring>

#include <tiny_gltf.h>

#include "assets/gltf/scene_reader.h"

namespace ego {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

bool InRange(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

/// Image of a texture, -1 when it has none that can be decoded.
int ImageOf(const tinygltf::Model& model, int texture, Character& character) {
  if (!InRange(texture, model.textures.size())) return -1;
  const int source = model.textures[At(texture)].source;
  if (InRange(source, character.images.size()) && character.images[At(source)].width > 0) {
    return source;
  }
  character.notes.push_back("texture " + std::to_string(texture) +
                            " is no PNG or JPEG that can be decoded (WebP and KTX are not): its "
                            "material is drawn with its base colour");
  return -1;
}

Image Converted(const tinygltf::Image& source) {
  Image image;
  if (source.width <= 0 || source.height <= 0 || source.component != 4) return image;
  const std::size_t values =
      static_cast<std::size_t>(source.width) * static_cast<std::size_t>(source.height) * 4;
  const std::size_t bytes = source.bits == 16 ? 2 : 1;
  if (source.image.size() < values * bytes) return image;
  image.width = source.width;
  image.height = source.height;
  image.rgba.resize(values);
  // Of 16-bit samples the high byte (little-endian) is enough to draw.
  for (std::size_t i = 0; i < values; ++i) image.rgba[i] = source.image[i * bytes + bytes - 1];
  return image;
}

}  // namespace

Result<void> ReadMaterials(const tinygltf::Model& model, Character& character) {
  for (const tinygltf::Image& image : model.images) character.images.push_back(Converted(image));
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
    if (texture >= 0) material.base_color_image = ImageOf(model, texture, character);
    material.double_sided = source.doubleSided;
    material.alpha_mask = source.alphaMode == "MASK";
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.blend = source.alphaMode == "BLEND";
    character.materials.push_back(std::move(material));
  }
  return {};
}

}  // namespace ego
