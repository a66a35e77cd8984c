// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cstdio>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "assets/motions/motions.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr float kRow = 28.0f;

// A row that can be chosen, with a colour mark; `tail` is kept free for buttons at its end.
bool Row(const char* id, const std::string& text, const glm::vec3& mark, bool chosen, bool dim,
         float tail) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::SetItemAllowOverlap();
  const bool pressed = ImGui::InvisibleButton(id, {width - Px(tail), Px(kRow)});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + Px(kRow)};
  if (chosen || ImGui::IsItemHovered()) {
    list.AddRectFilled(corner, end, Packed(look::kRaised), Px(6.0f));
  }
  if (chosen) {
    list.AddRectFilled(corner, {corner.x + Px(3.0f), end.y}, Packed(look::kAccent), Px(1.5f));
  }
  list.AddCircleFilled({corner.x + Px(16.0f), corner.y + Px(0.5f * kRow)}, Px(5.0f),
                       Packed(mark, dim ? 0.35f : 1.0f), 16);
  const float left = corner.x + Px(30.0f);
  const float top = corner.y + 0.5f * (Px(kRow) - ImGui::GetFontSize());
  const ImVec4 clip{left, corner.y, end.x - Px(tail) - Px(4.0f), end.y};
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {left, top},
               Packed(dim ? look::kOff : look::kText), text.c_str(), nullptr, 0.0f, &clip);
  return pressed;
}

// The motions of the studio's own performer, to open one.
void ShowMotionMenu(Studio& studio) {
  if (ImGui::Button("Performer's motions...")) ImGui::OpenPopup("motions");
  if (!ImGui::BeginPopup("motions")) return;
  if (ImGui::Selectable("Demo: several in a row")) studio.OpenMotion();
  ImGui::Separator();
  for (const MotionScript& script : ShippedMotions()) {
    const std::string label =
        script.study.empty() ? script.title : script.study + "  " + script.title;
    if (ImGui::Selectable(label.c_str())) studio.OpenMotion(script.name);
  }
  ImGui::EndPopup();
}

void ShowTakes(Studio& studio) {
  Section("Takes");
  if (studio.takes().empty()) {
    Quiet("Drop a .c3d, .trc or .bvh file on the window, or");
    if (ImGui::Button("Open the demo's take")) studio.OpenMotion();
    return;
  }
  std::uint64_t removed = 0;
  for (const TakeEntry& entry : studio.takes()) {
    ImGui::PushID(static_cast<int>(entry.id));
    const bool current = studio.current_take() && studio.current_take()->id == entry.id;
    if (Row("row", entry.take.name, look::kPerformer, current, false, 28.0f)) {
      studio.SelectTake(entry.id);
      studio.selection() = FigureRole{FigureRole::Kind::kPerformer, 0};
    }
    if (ImGui::IsItemHovered()) {
      const CapturedMotion& motion = *entry.take.motion;
      char tip[160];
      std::snprintf(tip, sizeof(tip), "%zu frames at %g Hz", motion.poses.size(), motion.rate_hz);
      Tip(tip);
    }
    ImGui::SameLine(0.0f, 0.0f);
    if (SignButton("x", Sign::kCross, "Remove (Ctrl+Z brings it back)")) removed = entry.id;
    ImGui::PopID();
  }
  if (removed) studio.RemoveTake(removed);
  ShowMotionMenu(studio);
}

void ShowAvatars(Studio& studio) {
  Section("Avatars");
  if (studio.avatars().empty()) {
    Quiet("Drop a .glb, .gltf or .vrm file on the window, or");
    if (ImGui::Button("Open the demo's cast")) studio.OpenDemoCast();
    return;
  }
  std::uint64_t removed = 0;
  for (const AvatarEntry& entry : studio.avatars()) {
    ImGui::PushID(static_cast<int>(entry.id));
    const FigureRole role{FigureRole::Kind::kAvatar, entry.id};
    if (Row("row", entry.avatar.name, entry.color, studio.selection() == role, !entry.visible,
            56.0f)) {
      studio.selection() = role;
    }
    ImGui::SameLine(0.0f, 0.0f);
    if (SignButton("eye", entry.visible ? Sign::kEye : Sign::kEyeOff,
                   entry.visible ? "Hide" : "Show")) {
      studio.SetVisible(entry.id, !entry.visible);
    }
    ImGui::SameLine(0.0f, 0.0f);
    if (SignButton("x", Sign::kCross, "Remove (Ctrl+Z brings it back)")) removed = entry.id;
    ImGui::PopID();
  }
  if (removed) studio.RemoveAvatar(removed);
}

}  // namespace

void ShowLeftRail(Studio& studio) {
  if (BeginPanel("left", studio.layout().left_rail, look::kPanel)) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {Px(8.0f), Px(4.0f)});
    ShowTakes(studio);
    ImGui::Dummy({0.0f, Px(8.0f)});
    ShowAvatars(studio);
    ImGui::Dummy({0.0f, Px(8.0f)});
    Quiet("Drop files on the window to add more.");
    ImGui::PopStyleVar();
  }
  EndPanel();
}

}  // namespace ego
