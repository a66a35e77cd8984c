// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

// A border that can be dragged. Returns how far it was, at scale 1.
float Border(const char* id, const Rect& rect, bool upright, bool& shown) {
  const float grip = Px(4.0f);
  const Rect zone = upright ? Rect{rect.x - grip, rect.y, 2.0f * grip, rect.height}
                            : Rect{rect.x, rect.y - grip, rect.width, 2.0f * grip};
  ImGui::SetNextWindowPos({zone.x, zone.y});
  ImGui::SetNextWindowSize({zone.width, zone.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleVar();
  ImGui::InvisibleButton("grip", {zone.width, zone.height});
  const bool held = ImGui::IsItemActive();
  if (held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) shown = !shown;
  }
  const ImU32 color = Packed(held ? look::kAccent : look::kLine);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (upright) {
    list.AddLine({rect.x, rect.y}, {rect.x, rect.y + rect.height}, color);
  } else {
    list.AddLine({rect.x, rect.y}, {rect.x + rect.width, rect.y}, color);
  }
  ImGui::End();
  if (!held) return 0.0f;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  return (upright ? moved.x : moved.y) / Gui::Current().scale();
}

}  // namespace

void ShowSplitters(Studio& studio) {
  FrameLayout& layout = studio.layout();
  const Rect view = layout.viewport;
  layout.left += Border("left edge", {view.x, view.y, 0.0f, view.height}, true, layout.show_left);
  layout.right -= Border("right edge", {view.x + view.width, view.y, 0.0f, view.height}, true,
                         layout.show_right);
  const Rect& below = layout.timeline_panel;
  layout.timeline -=
      Border("lower edge", {0.0f, below.y, below.width, 0.0f}, false, layout.show_timeline);
}

}  // namespace ego
