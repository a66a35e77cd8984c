// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

namespace ego::look {

/// The colours of every view, sRGB in [0, 1]. They live here and nowhere else.
constexpr glm::vec3 Srgb(unsigned hex) {
  return {static_cast<float>((hex >> 16) & 0xffu) / 255.0f,
          static_cast<float>((hex >> 8) & 0xffu) / 255.0f,
          static_cast<float>(hex & 0xffu) / 255.0f};
}

inline constexpr glm::vec3 kRoom = Srgb(0x14161A);
inline constexpr glm::vec3 kPanel = Srgb(0x1C1F24);
inline constexpr glm::vec3 kRaised = Srgb(0x262A31);
inline constexpr glm::vec3 kLine = Srgb(0x353B45);
inline constexpr glm::vec3 kText = Srgb(0xE8EAED);
inline constexpr glm::vec3 kQuiet = Srgb(0xA4ABB6);
inline constexpr glm::vec3 kOff = Srgb(0x6B727D);
inline constexpr glm::vec3 kAccent = Srgb(0x4DA3FF);
inline constexpr glm::vec3 kGood = Srgb(0x46C77A);
inline constexpr glm::vec3 kWarn = Srgb(0xF2B035);
inline constexpr glm::vec3 kBad = Srgb(0xF0565B);
inline constexpr glm::vec3 kPerformer = Srgb(0xE9A23B);
inline constexpr glm::vec3 kSkeleton = Srgb(0xF1F1EE);
inline constexpr glm::vec3 kContact = Srgb(0xFFD84A);
inline constexpr glm::vec3 kPenetration = Srgb(0xFF2E55);

/// The floor in the middle of the stage's light, and the lines of its grid.
inline constexpr glm::vec3 kFloor = Srgb(0x464B54);
inline constexpr glm::vec3 kGrid = Srgb(0x6E7683);

/// The colour that an avatar keeps in every view, by its place in the project.
glm::vec3 AvatarColor(std::size_t index);

}  // namespace ego::look
