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

// A tab of the window; the one that is shown is underlined. A mark tells of unsaved work.
void Tab(Studio& studio, const char* label, const char* tip, Workspace workspace, bool unsaved) {
  const bool on = studio.workspace() == workspace;
  ImGui::PushStyleColor(ImGuiCol_Text, Packed(on ? look::kText : look::kQuiet));
  ImGui::PushStyleColor(ImGuiCol_Button, Packed(on ? look::kRaised : look::kPanel));
  const std::string text = std::string(label) + (unsaved ? " *" : "") + "###" + label;
  if (ImGui::Button(text.c_str())) studio.EnterWorkspace(workspace);
  ImGui::PopStyleColor(2);
  if (on) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled(
        {low.x + Px(8.0f), high.y}, {high.x - Px(8.0f), high.y + Px(2.0f)}, Packed(look::kAccent));
  }
  Tip(tip);
}

void ShowTabs(Studio& studio) {
  const bool unsaved = !studio.calibrate().Unsaved().empty();
  ImGui::SameLine(Px(108.0f));
  Tab(studio, "Calibrate",
      unsaved ? "Where an avatar's points lie (Ctrl+1); some are not saved yet"
              : "Where an avatar's points lie (Ctrl+1)",
      Workspace::kCalibrate, unsaved);
  ImGui::SameLine(0.0f, Px(4.0f));
  Tab(studio, "Perform", "Performer and avatars on stage (Ctrl+2)", Workspace::kPerform, false);
}

// A name that may be long: cut where the room ends, whole in its tool tip.
void Name(const std::string& name, float left, float right) {
  ImGui::SameLine(left);
  ImVec2 at = ImGui::GetCursorScreenPos();
  at.y += ImGui::GetStyle().FramePadding.y;
  const float window = ImGui::GetWindowPos().x;
  const ImVec4 clip{at.x, at.y, window + right, at.y + ImGui::GetFrameHeight()};
  const float width = std::min(ImGui::CalcTextSize(name.c_str()).x, right - left);
  if (width <= 0.0f) return;
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at,
                                      Packed(look::kText), name.c_str(), nullptr, 0.0f, &clip);
  ImGui::Dummy({width, ImGui::GetTextLineHeight()});
  if (ImGui::CalcTextSize(name.c_str()).x > width) Tip(name.c_str());
}

float NameLeft(Studio& studio) {
  return std::max(studio.layout().viewport.x + Px(12.0f), Px(320.0f));
}

void ShowAvatarName(Studio& studio) {
  const CalibrationSession* session = studio.calibrate().session();
  if (!session) return;
  Name(session->name() + (session->editor().Unsaved() ? "*" : ""), NameLeft(studio),
       ImGui::GetWindowWidth() - Px(12.0f));
}

void ShowTakeAndMethod(Studio& studio) {
  const auto names = RetargetMethodNames();
  ImGui::PushFont(Gui::Current().fonts().small);
  float width = 0.0f;
  for (const std::string_view name : names) {
    width += ImGui::CalcTextSize(WordsOf(name).label.c_str()).x +
             2.0f * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x;
  }
  const float label = ImGui::CalcTextSize("Method").x;
  const float left = ImGui::GetWindowWidth() - width - label - Px(12.0f);
  ImGui::PopFont();
  if (const TakeEntry* take = studio.current_take()) {
    Name(take->take.name, NameLeft(studio), left - Px(16.0f));
  }
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::SameLine(left);
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

}  // namespace

void ShowTopBar(Studio& studio) {
  if (BeginPanel("bar", studio.layout().bar, look::kPanel, 8.0f)) {
    ImGui::SetCursorPosX(Px(12.0f));
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(Gui::Current().fonts().section);
    ImGui::TextUnformatted("Egostudio");
    ImGui::PopFont();
    ShowTabs(studio);
    if (studio.workspace() == Workspace::kPerform) {
      ShowTakeAndMethod(studio);
    } else {
      ShowAvatarName(studio);
    }
  }
  EndPanel();
}

}  // namespace ego
