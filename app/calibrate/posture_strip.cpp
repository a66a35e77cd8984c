// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "app/calibrate/workspace.h"
#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

// A small picture with a title below it. True when clicked.
bool Card(const char* id, const GuiTexture* picture, const std::string& title, bool chosen,
          const char* tip, float side) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushFont(Gui::Current().fonts().small);
  const float width = std::max(side, ImGui::CalcTextSize(title.c_str()).x + Px(8.0f));
  const float height = side + ImGui::GetFontSize() + Px(6.0f);
  const bool pressed = ImGui::InvisibleButton(id, {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low{corner.x + 0.5f * (width - side), corner.y};
  const ImVec2 high{low.x + side, low.y + side};
  list.AddRectFilled(low, high, Packed(look::kRoom), Px(6.0f));
  if (picture && picture->id()) {
    list.AddImageRounded(picture->id(), low, high, {0, 0}, {1, 1}, IM_COL32_WHITE, Px(6.0f));
  }
  if (chosen || hovered) {
    list.AddRect(low, high, Packed(chosen ? look::kAccent : look::kOff), Px(6.0f), 0, Px(2.0f));
  }
  list.AddText(
      {corner.x + 0.5f * (width - ImGui::CalcTextSize(title.c_str()).x), high.y + Px(3.0f)},
      Packed(chosen ? look::kText : look::kQuiet), title.c_str());
  ImGui::PopFont();
  Tip(tip);
  return pressed;
}

// What the posture shown says about the points.
void ShowGap(const CalibrationSession& session) {
  if (session.shown().kind != ShownPose::Kind::kPosture) {
    Quiet("A bad point shows at once when hands and body must meet.");
    return;
  }
  if (session.shown().amount < 1.0) {
    Quiet("Half-way: nothing touches yet.");
    return;
  }
  const double gap = session.contact_gap();
  const double height = session.editor().AvatarBody().height;
  char number[32];
  std::snprintf(number, sizeof(number), "%.0f", 1000.0 * std::abs(gap));
  Fact(gap < 0.0 ? "Sinks in by" : "Largest gap", number, "mm");
  const bool good = std::abs(gap) < 0.015 * height;
  const glm::vec3 color = good ? look::kGood : look::kWarn;
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::TextColored({color.x, color.y, color.z, 1.0f}, "%s",
                     good ? "What should touch touches" : "Look at the points there");
  ImGui::PopFont();
}

}  // namespace

void ShowPostureStrip(Studio& studio) {
  if (BeginPanel("postures", studio.layout().timeline_panel, look::kPanel)) {
    CalibrateWorkspace& work = studio.calibrate();
    CalibrationSession* session = work.session();
    if (!session) {
      Quiet("Test postures try an avatar out here.");
    } else {
      using Kind = ShownPose::Kind;
      const ShownPose& shown = session->shown();
      const float side =
          std::max(Px(40.0f), ImGui::GetContentRegionAvail().y - Gui::Current().scale() * 21.0f);
      StageRenderer& renderer = studio.picture().renderer();
      if (Card("canonical", work.PoseThumbnail(studio, Kind::kCanonical, static_cast<int>(side)),
               "T-pose", shown.kind == Kind::kCanonical,
               "The canonical pose, after the alignment of the rest pose (T)", side)) {
        work.Show(studio, {});
      }
      ImGui::SameLine();
      if (Card("file", work.PoseThumbnail(studio, Kind::kAsInFile, static_cast<int>(side)),
               "As in the file", shown.kind == Kind::kAsInFile,
               "The rest pose before the alignment (T)", side)) {
        work.Show(studio, {Kind::kAsInFile});
      }
      for (std::size_t i = 0; i < kTestPostureCount; ++i) {
        const auto posture = static_cast<TestPosture>(i);
        ImGui::SameLine();
        ImGui::PushID(static_cast<int>(i));
        const bool chosen = shown.kind == Kind::kPosture && shown.posture == posture;
        const std::string title(Title(posture));
        if (Card("posture", work.reference().PictureOf(renderer, posture, static_cast<int>(side)),
                 title, chosen, "What the method makes of this posture on this avatar", side)) {
          work.Show(studio, {Kind::kPosture, posture, 1.0});
        }
        ImGui::PopID();
      }
      ImGui::SameLine(0.0f, Px(20.0f));
      if (ImGui::GetContentRegionAvail().x > Px(120.0f)) {
        ImGui::BeginGroup();
        ImGui::PushFont(Gui::Current().fonts().section);
        ImGui::TextUnformatted("Test postures");
        ImGui::PopFont();
        const float width = std::min(Px(240.0f), ImGui::GetContentRegionAvail().x);
        ImGui::BeginChild("facts", {width, 0.0f});
        ImGui::SetNextItemWidth(width);
        auto amount = static_cast<float>(100.0 * shown.amount);
        if (shown.kind == Kind::kPosture &&
            ImGui::SliderFloat("##amount", &amount, 0.0f, 100.0f, "%.0f %%",
                               ImGuiSliderFlags_AlwaysClamp)) {
          work.Show(studio, {Kind::kPosture, shown.posture, static_cast<double>(amount) / 100.0});
        }
        if (shown.kind == Kind::kPosture) Tip("How far into the posture");
        ShowGap(*session);
        ImGui::EndChild();
        ImGui::EndGroup();
      }
    }
  }
  EndPanel();
}

}  // namespace ego
