// SPDX-License-Identifier: MIT
// Pieces that both workspaces show.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {

// Errors stand where the eye is until they are read.
void ShowError(Studio& studio, const Rect& view) {
  if (studio.errors().empty()) return;
  std::string text;
  for (const std::string& error : studio.errors()) text += (text.empty() ? "" : "\n") + error;
  const float width = std::min(Px(560.0f), view.width - Px(32.0f));
  const float wrap = width - Px(64.0f);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const float height = size.y + Px(24.0f);
  const ImVec2 corner{view.x + 0.5f * (view.width - width),
                      view.y + view.height - height - Px(52.0f)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  list.AddRectFilled(corner, end, Packed(look::kRaised), Px(6.0f));
  list.AddRectFilled(corner, {corner.x + Px(4.0f), end.y}, Packed(look::kBad), Px(2.0f));
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {corner.x + Px(16.0f), corner.y + Px(12.0f)},
               Packed(look::kText), text.c_str(), nullptr, wrap);
  ImGui::SetCursorScreenPos({end.x - Px(36.0f), corner.y + Px(8.0f)});
  if (SignButton("dismiss", Sign::kCross, "Dismiss")) studio.DismissErrors();
}

void ShowNavigationMenu(Studio& studio, const Rect& view) {
  ImGui::PushFont(Gui::Current().fonts().small);
  const std::string label = "Mouse: " + std::string(Name(studio.navigation()));
  ImGui::SetCursorScreenPos(
      {view.x + Px(8.0f), view.y + view.height - ImGui::GetFrameHeight() - Px(8.0f)});
  if (ImGui::Button(label.c_str())) ImGui::OpenPopup("navigation");
  ImGui::PopFont();
  const NavigationHelp now = HelpOf(studio.navigation());
  const std::string tip =
      std::string("Turn: ") + now.turn + "\nMove: " + now.move + "\nCloser, farther: " + now.zoom;
  Tip(tip.c_str());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {Px(8.0f), Px(8.0f)});
  if (ImGui::BeginPopup("navigation")) {
    for (const Navigation navigation : kNavigations) {
      const std::string name(Name(navigation));
      const NavigationHelp help = HelpOf(navigation);
      if (ImGui::Selectable(name.c_str(), navigation == studio.navigation(), 0,
                            {Px(260.0f), 0.0f})) {
        studio.navigation() = navigation;
      }
      const std::string line = std::string(help.turn) + " turns, " + help.move + " moves";
      Quiet(line);
    }
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
}

void ShowRecentFiles(Studio& studio) {
  if (studio.recent().empty()) return;
  Quiet("Recent files");
  int id = 0;
  for (const std::filesystem::path& path : studio.recent()) {
    ImGui::PushID(--id);
    const bool chosen = ImGui::Selectable(path.filename().c_str());
    Tip(path.c_str());
    ImGui::PopID();
    if (!chosen) continue;
    studio.CalibrateFile(path);
    return;
  }
}

}  // namespace ego
