// SPDX-License-Identifier: MIT
#include "render/look.h"

#include <array>

namespace ego::look {

glm::vec3 AvatarColor(std::size_t index) {
  static constexpr std::array<glm::vec3, 6> kColors = {Srgb(0x35C0A6), Srgb(0x9A80FF),
                                                       Srgb(0xFF7D6E), Srgb(0x5DB4F0),
                                                       Srgb(0xD77FD0), Srgb(0xB5C94C)};
  return kColors[index % kColors.size()];
}

}  // namespace ego::look
