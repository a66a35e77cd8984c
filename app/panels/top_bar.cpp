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

struct MethodWords {
  std::string label;
  std::string tip;
};

// Plain words; the tool tip names the method as the command line does.
MethodWords WordsOf(std::string_view name) {
  const std::string id = "\n--method " + std::string(name);
  if (name == "mdb") {
    return {"Keep contacts", "Hands that touch the body in the take touch it on the avatars" + id};
  }
  if (name == "paper") {
    return {"As in the paper", "The closest reading of the published method" + id};
  }
  if (name == "copy") {
    return {"Joint angles only", "Copies the angles of the joints, for comparison" + id};
  }
  return {std::string(name), std::string(name)};
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
      width += ImGui::CalcTextSize(WordsOf(name).label.c_str()).x +
               2.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
    }
    const float label = ImGui::CalcTextSize("Method").x;
    ImGui::SameLine(ImGui::GetWindowWidth() - width - label - Px(12.0f));
    ImGui::TextColored({look::kQuiet.x, look::kQuiet.y, look::kQuiet.z, 1.0f}, "Method");
    ImGui::PopFont();
    for (const std::string_view name : names) {
      ImGui::SameLine();
      const MethodWords words = WordsOf(name);
      if (Toggle(words.label.c_str(), words.tip.c_str(), studio.method() == name)) {
        studio.SetMethod(std::string(name));
      }
    }
  }
  EndPanel();
}

}  // namespace ego
