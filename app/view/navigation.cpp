// SPDX-License-Identifier: MIT
#include "app/view/navigation.h"

namespace ego {

std::string_view Name(Navigation navigation) {
  switch (navigation) {
    case Navigation::kStudio:
      return "Studio";
    case Navigation::kBlender:
      return "Blender";
    case Navigation::kMaya:
      return "Maya";
    case Navigation::kUnreal:
      break;
  }
  return "Unreal";
}

std::optional<Navigation> NavigationNamed(std::string_view name) {
  for (const Navigation navigation : kNavigations) {
    if (Name(navigation) == name) return navigation;
  }
  return std::nullopt;
}

NavigationHelp HelpOf(Navigation navigation) {
  switch (navigation) {
    case Navigation::kStudio:
      return {"Drag, or middle drag", "Shift+drag, or right drag", "Wheel"};
    case Navigation::kBlender:
      return {"Middle drag", "Shift+middle drag", "Wheel, or Ctrl+middle drag"};
    case Navigation::kMaya:
      return {"Alt+drag", "Alt+middle drag", "Wheel, or Alt+right drag"};
    case Navigation::kUnreal:
      break;
  }
  return {"Alt+drag, or right drag", "Middle drag", "Wheel, or Alt+right drag"};
}

CameraMove MoveOf(Navigation navigation, const Held& held) {
  using M = CameraMove;
  switch (navigation) {
    case Navigation::kStudio:
      if (held.right || ((held.left || held.middle) && held.shift)) return M::kMove;
      return held.left || held.middle ? M::kTurn : M::kNone;
    case Navigation::kBlender:
      if (!held.middle) return M::kNone;
      return held.shift ? M::kMove : held.control ? M::kZoom : M::kTurn;
    case Navigation::kMaya:
      if (!held.alt) return M::kNone;
      return held.left ? M::kTurn : held.middle ? M::kMove : held.right ? M::kZoom : M::kNone;
    case Navigation::kUnreal:
      break;
  }
  if (held.middle) return M::kMove;
  if (held.right) return held.alt ? M::kZoom : M::kTurn;
  return held.left && held.alt ? M::kTurn : M::kNone;
}

void Apply(CameraMove move, const Vec2& drag, const Vec2& pointer, ViewportSize size,
           Camera& camera) {
  constexpr double kPixelsPerStep = 24.0;
  switch (move) {
    case CameraMove::kNone:
      return;
    case CameraMove::kTurn:
      camera.Orbit(drag, size);
      return;
    case CameraMove::kMove:
      camera.Pan(drag, size);
      return;
    case CameraMove::kZoom:
      camera.Zoom((drag.x - drag.y) / kPixelsPerStep, pointer, size);
      return;
  }
}

}  // namespace ego
