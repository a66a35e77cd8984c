// SPDX-License-Identifier: MIT
#include "assets/gltf/image_decoder.h"

#include <climits>
#include <memory>

#include <stb/stb_image.h>
#include <webp/decode.h>

namespace ego {
namespace {

struct FreeDecoded {
  void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

bool Fits(int width, int height, std::size_t max_pixels) {
  return width > 0 && height > 0 &&
         static_cast<std::size_t>(width) <= max_pixels / static_cast<std::size_t>(height);
}

Image Blank(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return image;
}

bool IsPngOrJpeg(std::span<const std::uint8_t> bytes) {
  return bytes.size() > 8 &&
         ((bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G') ||
          (bytes[0] == 0xFF && bytes[1] == 0xD8));
}

}  // namespace

std::optional<Image> DecodeImage(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  int width = 0;
  int height = 0;
  if (WebPGetInfo(bytes.data(), bytes.size(), &width, &height) != 0) {
    if (!Fits(width, height, max_pixels)) return {};
    Image image = Blank(width, height);
    if (WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.rgba.data(), image.rgba.size(),
                           4 * width) == nullptr) {
      return {};
    }
    return image;
  }
  // stb_image tries many more formats; glTF knows only these two.
  if (!IsPngOrJpeg(bytes) || bytes.size() > INT_MAX) return {};
  const int size = static_cast<int>(bytes.size());
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 ||
      !Fits(width, height, max_pixels)) {
    return {};
  }
  const std::unique_ptr<unsigned char, FreeDecoded> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4));
  if (!pixels || !Fits(width, height, max_pixels)) return {};
  Image image = Blank(width, height);
  image.rgba.assign(pixels.get(), pixels.get() + image.rgba.size());
  return image;
}

}  // namespace ego
