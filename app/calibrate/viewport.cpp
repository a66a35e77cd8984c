// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/calibrate/workspace.h"
#include "app/panels/palette.h"
#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

void ShowStrip(Studio& studio, CalibrateWorkspace& work, const CalibrationSession& session,
               const Rect& view) {
  CalibrateLook& look = work.habits.look;
  const bool in_file = session.shown().kind == ShownPose::Kind::kAsInFile;
  struct Item {
    const char* label;
    const char* tip;
    bool on;
    std::function<void()> flip;
  };
  const Item items[] = {
      {"Symmetric", "A pick is mirrored to the other side, as one step (M)", work.habits.symmetric,
       [&] { work.SetSymmetric(!work.habits.symmetric); }},
      {"Loupe", "A magnified view beside the pointer (L)", work.habits.loupe,
       [&] { work.habits.loupe = !work.habits.loupe; }},
      {"Follow", "The camera turns to the point that is asked for (Shift+F)", work.habits.follow,
       [&] { work.habits.follow = !work.habits.follow; }},
      {"Crude", "The surfaces that the method works with, over the skin (C)", look.crude,
       [&] { look.crude = !look.crude; }},
      {"Limbs", "The points around all limbs (G)", look.limbs, [&] { look.limbs = !look.limbs; }},
      {"Wireframe", "The mesh's edges (W)", look.edges, [&] { look.edges = !look.edges; }},
      {"X-ray", "See-through skin, with the skeleton inside (X)", look.xray,
       [&] { look.xray = !look.xray; }},
      {"Aligned", "The rest pose aligned to the T-pose; off: as it stands in the file (T)",
       !in_file, [&] { work.ToggleAligned(studio); }},
  };
  ImGui::PushFont(Gui::Current().fonts().small);
  float width = Px(4.0f);
  for (const Item& item : items) {
    width += ImGui::CalcTextSize(item.label).x + 2.0f * ImGui::GetStyle().FramePadding.x + Px(4.0f);
  }
  ImGui::PopFont();
  ImGui::SetCursorScreenPos(
      {std::max(view.x + Px(8.0f), view.x + view.width - width - Px(8.0f)), view.y + Px(8.0f)});
  for (const Item& item : items) {
    if (Toggle(item.label, item.tip, item.on)) item.flip();
    ImGui::SameLine(0.0f, Px(4.0f));
  }
}

// What to do now, in one line at the picture's lower edge.
void ShowPrompt(const CalibrateWorkspace& work, const CalibrationSession& session,
                const Rect& view) {
  std::string text;
  if (work.list == CalibrateWorkspace::List::kJoints) {
    text = "Click a joint to choose its node";
  } else if (session.current()) {
    const PickItem& item = *session.current();
    text = (item.segment ? "Click around the middle of " : "Click ") + Title(item);
    if (session.editor().Symmetric() && Mirror(item) != item) text += ", both sides";
  } else {
    text = session.editor().Unsaved() ? "All settled. Ctrl+S saves." : "All settled and saved.";
  }
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 corner{view.x + 0.5f * (view.width - size.x),
                      view.y + view.height - size.y - Px(16.0f)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x - Px(12.0f), corner.y - Px(5.0f)},
                     {corner.x + size.x + Px(12.0f), corner.y + size.y + Px(5.0f)},
                     Packed(look::kRaised, 0.9f), Px(6.0f));
  list.AddText(corner, Packed(look::kText), text.c_str());
}

void ShowOpening(Studio& studio, const Rect& view) {
  const auto activity = studio.loader().activity();
  const float width = Px(320.0f);
  const ImVec2 corner{view.x + 0.5f * (view.width - width), view.y + 0.42f * view.height};
  ImGui::SetCursorScreenPos(corner);
  ImGui::BeginGroup();
  ImGui::TextUnformatted(activity ? activity->subject.c_str() : "Opening");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 bar = ImGui::GetCursorScreenPos();
  const float done = activity ? width * static_cast<float>(activity->fraction) : 0.0f;
  list.AddRectFilled(bar, {bar.x + width, bar.y + Px(4.0f)}, Packed(look::kLine), Px(2.0f));
  list.AddRectFilled(bar, {bar.x + done, bar.y + Px(4.0f)}, Packed(look::kAccent), Px(2.0f));
  ImGui::Dummy({width, Px(8.0f)});
  if (activity && !activity->what.empty()) Quiet(activity->what);
  if (ImGui::Button("Cancel")) studio.loader().Cancel();
  ImGui::EndGroup();
}

void ShowEmpty(Studio& studio, const Rect& view) {
  const float width = Px(340.0f);
  ImGui::SetCursorScreenPos({view.x + 0.5f * (view.width - width), view.y + 0.36f * view.height});
  ImGui::BeginChild("empty", {width, 0.4f * view.height}, false, ImGuiWindowFlags_NoBackground);
  ImGui::PushFont(Gui::Current().fonts().section);
  ImGui::TextUnformatted("Calibrate an avatar");
  ImGui::PopFont();
  Quiet("Drop a character (.glb, .gltf, .vrm) here, or choose one:");
  for (const AvatarEntry& entry : studio.avatars()) {
    ImGui::PushID(static_cast<int>(entry.id));
    if (ImGui::Button(entry.avatar.name.c_str())) studio.Calibrate(entry.id);
    ImGui::PopID();
  }
  if (studio.avatars().empty() && ImGui::Button("Open the demo's cast")) studio.OpenDemoCast();
  ShowRecentFiles(studio);
  ImGui::EndChild();
}

}  // namespace

void ShowCalibrateViewport(Studio& studio) {
  CalibrateWorkspace& work = studio.calibrate();
  const Rect view = studio.layout().viewport;
  BeginViewport(view);
  CalibrationSession* session = work.session();
  if (session) {
    ImGui::InvisibleButton("picture", {view.width, view.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    const bool asked = session->offer() || work.show_guide || work.ask_path;
    if (!asked) HandlePointer(studio, *session);
    DrawOverlay(studio, *session);
    ShowStrip(studio, work, *session, view);
    ShowPrompt(work, *session, view);
    ShowNavigationMenu(studio, view);
    ShowCards(studio, *session);
  } else if (work.avatar_id() != 0 && work.opening()) {
    ShowOpening(studio, view);
  } else {
    ShowEmpty(studio, view);
  }
  ShowError(studio, view);
  ImGui::End();
}

}  // namespace ego
