// SPDX-License-Identifier: MIT
#include "render/png.h"

#include <cstddef>

#include <stb_image_write.h>

namespace ego {

std::vector<std::uint8_t> EncodePng(const Image& image) {
  std::vector<std::uint8_t> bytes;
  const std::size_t pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != 4u * pixels) return bytes;
  const auto append = [](void* context, void* data, int size) {
    auto* out = static_cast<std::vector<std::uint8_t>*>(context);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    out->insert(out->end(), begin, begin + size);
  };
  stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(),
                         4 * image.width);
  return bytes;
}

}  // namespace ego
