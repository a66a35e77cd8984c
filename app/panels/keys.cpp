// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

struct Line {
  const char* keys;
  const char* what;
};
constexpr Line kLines[] = {
    {"Space", "play, pause"},
    {"Left, Right", "one frame; with Shift ten"},
    {"Home, End", "first, last frame"},
    {"L", "loop"},
    {"F", "frame what is selected"},
    {"A", "frame everyone"},
    {"1, 3, 7", "from the front, the side, above"},
    {"0", "three-quarter view"},
    {"B", "body surface of the performer"},
    {"K", "captured skeleton"},
    {"M", "markers"},
    {"C", "crude surfaces over avatars"},
    {"T", "spots where hands touch"},
    {"N", "names"},
    {"S", "true sizes"},
    {"Tab", "fold all panels away"},
    {"Drag", "turn; with Shift or the right button move"},
    {"Wheel", "closer, farther"},
    {"Ctrl+Z", "bring back what was removed"},
    {"Ctrl+Q", "close the window"},
    {"Esc", "close this, drop the selection"},
};

}  // namespace

void ShowKeys(Studio& studio) {
  if (!studio.show_keys) return;
  const Rect& view = studio.layout().viewport;
  const float width = Px(400.0f);
  const float height = Px(18.0f) + Px(22.0f) * static_cast<float>(std::size(kLines));
  const Rect rect{view.x + 0.5f * (view.width - width), 0.5f * (studio.layout().status.y - height),
                  width, height};
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, Px(6.0f));
  BeginPanel("keys", rect, look::kRaised, 12.0f, true);
  ImGui::PopStyleVar();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      {Px(8.0f), Px(22.0f) - ImGui::GetTextLineHeight()});
  for (const Line& line : kLines) {
    ImGui::TextUnformatted(line.keys);
    ImGui::SameLine(Px(124.0f));
    ImGui::TextColored({look::kQuiet.x, look::kQuiet.y, look::kQuiet.z, 1.0f}, "%s", line.what);
  }
  ImGui::PopStyleVar();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered()) {
    studio.show_keys = false;
  }
  EndPanel();
}

}  // namespace ego
