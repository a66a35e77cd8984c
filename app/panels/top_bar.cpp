// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "core/baselines/retarget_method.h"
#include "render/look.h"

namespace ego {
namespace {

const char* MethodTip(std::string_view name) {
  if (name == "mdb") return "Keeps contacts of the body with itself (default)";
  if (name == "paper") return "The closest reading of the published method";
  if (name == "copy") return "Joint angles alone, for comparison";
  return "";
}

}  // namespace

void ShowTopBar(Studio& studio) {
  if (BeginPanel("bar", studio.layout().bar, look::kPanel, 8.0f)) {
    ImGui::SetCursorPosX(Px(12.0f));
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(Gui::Current().fonts().section);
    ImGui::TextUnformatted("Egostudio");
    ImGui::PopFont();
    ImGui::SameLine(std::max(studio.layout().viewport.x + Px(12.0f), Px(120.0f)));
    if (const TakeEntry* take = studio.current_take()) {
      ImGui::TextUnformatted(take->take.name.c_str());
    }

    const auto names = RetargetMethodNames();
    ImGui::PushFont(Gui::Current().fonts().small);
    float width = 0.0f;
    for (const std::string_view name : names) {
      width += ImGui::CalcTextSize(name.data(), name.data() + name.size()).x +
               2.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    }
    const float label = ImGui::CalcTextSize("Method").x;
    ImGui::SameLine(ImGui::GetWindowWidth() - width - label - Px(12.0f));
    ImGui::TextColored({look::kQuiet.x, look::kQuiet.y, look::kQuiet.z, 1.0f}, "Method");
    ImGui::PopFont();
    for (const std::string_view name : names) {
      ImGui::SameLine();
      const std::string text(name);
      if (Toggle(text.c_str(), MethodTip(name), studio.method() == text)) studio.SetMethod(text);
    }
  }
  EndPanel();
}

}  // namespace ego
