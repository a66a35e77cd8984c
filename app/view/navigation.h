// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "render/camera.h"

namespace ego {

/// Whose mouse habits the camera follows.
enum class Navigation { kStudio, kBlender, kMaya, kUnreal };
inline constexpr std::array<Navigation, 4> kNavigations = {
    Navigation::kStudio, Navigation::kBlender, Navigation::kMaya, Navigation::kUnreal};

/// "Blender"; also how it is remembered.
std::string_view Name(Navigation navigation);
std::optional<Navigation> NavigationNamed(std::string_view name);
/// One line each: what turns, moves and zooms.
struct NavigationHelp {
  const char* turn;
  const char* move;
  const char* zoom;
};
NavigationHelp HelpOf(Navigation navigation);

/// What is held down.
struct Held {
  bool left = false;
  bool right = false;
  bool middle = false;
  bool shift = false;
  bool control = false;
  bool alt = false;
};

enum class CameraMove { kNone, kTurn, kMove, kZoom };
/// What a drag with these held does to the camera. With a preset of another program a plain left
/// drag is left to the tools.
CameraMove MoveOf(Navigation navigation, const Held& held);
/// Carries it out for a drag in pixels.
void Apply(CameraMove move, const Vec2& drag, const Vec2& pointer, ViewportSize size,
           Camera& camera);

}  // namespace ego
