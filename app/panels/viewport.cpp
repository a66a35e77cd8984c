// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr float kClickSlack = 4.0f;  // a drag shorter than this is a click

// The figure under the pointer: the nearest whose upright axis passes close to it.
std::optional<FigureRole> FigureAt(Studio& studio, const Vec2& pixel, ViewportSize size) {
  StagePicture& picture = studio.picture();
  Camera camera = studio.camera();
  camera.target_ws += picture.anchor();
  const StageFrame& frame = studio.frame();
  std::optional<FigureRole> found;
  double nearest = 1e300;
  const auto test = [&](const FigureRole& role, const Vec3& offset, const ModelPose& pose,
                        double height) {
    Vec2 low(1e300);
    Vec2 high(-1e300);
    double depth = 0.0;
    for (const Vec3& joint : pose.position_ws) {
      const auto projected = camera.Project(joint + offset, size);
      if (!projected) return;
      low = glm::min(low, Vec2(*projected));
      high = glm::max(high, Vec2(*projected));
      depth = projected->z;
    }
    const double margin = 0.08 * height / std::max(1e-6, camera.MetresPerPixel(size));
    const bool inside = pixel.x > low.x - margin && pixel.x < high.x + margin &&
                        pixel.y > low.y - margin && pixel.y < high.y + margin;
    if (inside && depth < nearest) {
      nearest = depth;
      found = role;
    }
  };
  for (std::size_t i = 0; i < picture.roles().size(); ++i) {
    const FigureRole& role = picture.roles()[i];
    const Vec3 offset = picture.offsets()[i];
    if (role.kind != FigureRole::Kind::kAvatar) {
      test(role, offset, frame.performer, frame.scene->motion->performer.height);
      continue;
    }
    for (std::size_t k = 0; k < frame.avatars.size(); ++k) {
      const StageScene::Avatar& avatar = frame.scene->avatars[k];
      if (avatar.id == role.avatar_id) {
        test(role, offset, frame.avatars[k].model, avatar.body->height);
      }
    }
  }
  return found;
}

void MoveCamera(Studio& studio, const Rect& rect, ViewportSize size) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 pointer(io.MousePos.x - rect.x, io.MousePos.y - rect.y);
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
    studio.camera().Zoom(static_cast<double>(io.MouseWheel), pointer, size);
    studio.CameraMovedByHand();
  }
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const Held held{io.MouseDown[ImGuiMouseButton_Left],
                    io.MouseDown[ImGuiMouseButton_Right],
                    io.MouseDown[ImGuiMouseButton_Middle],
                    io.KeyShift,
                    io.KeyCtrl,
                    io.KeyAlt};
    const CameraMove move = MoveOf(studio.navigation(), held);
    Apply(move, {io.MouseDelta.x, io.MouseDelta.y}, pointer, size, studio.camera());
    if (move != CameraMove::kNone) studio.CameraMovedByHand();
  }
  const bool clicked =
      ImGui::IsItemDeactivated() && io.MouseReleased[ImGuiMouseButton_Left] &&
      io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < Px(kClickSlack) * Px(kClickSlack);
  if (clicked && studio.frame().scene) studio.selection() = FigureAt(studio, pointer, size);
}

void ShowOverlayStrip(Studio& studio, const Rect& view) {
  Overlays& on = studio.overlays();
  struct Item {
    const char* label;
    const char* tip;
    bool* value;
  };
  const Item items[] = {
      {"Surface", "Body surface of the performer (B)", &on.surface},
      {"Markers", "Markers of the take (M)", &on.markers},
      {"Skeleton", "Captured skeleton (K)", &on.skeleton},
      {"Crude", "The surfaces that the method works with, over the avatars (C)", &on.crude},
      {"Contacts", "Spots that glow where hands touch the body (T)", &on.contacts},
      {"Names", "Names at their feet (N)", &on.names},
      {"True sizes",
       "Everyone at their own size (S); else giants and dwarfs are shown at one that compares,\n"
       "and the name at their feet tells how much of their size is shown",
       &on.true_sizes},
  };
  ImGui::PushFont(Gui::Current().fonts().small);
  float width = 0.0f;
  for (const Item& item : items) {
    width += ImGui::CalcTextSize(item.label).x + 2.0f * ImGui::GetStyle().FramePadding.x + Px(4.0f);
  }
  ImGui::PopFont();
  ImGui::SetCursorScreenPos({view.x + view.width - width - Px(8.0f), view.y + Px(8.0f)});
  for (const Item& item : items) {
    if (Toggle(item.label, item.tip, *item.value)) *item.value = !*item.value;
    ImGui::SameLine(0.0f, Px(4.0f));
  }
}

void ShowEmptyState(Studio& studio, const Rect& view) {
  const char* text =
      studio.loader().activity() ? "Preparing the stage" : "Drop takes and avatars here";
  const ImVec2 size = ImGui::CalcTextSize(text);
  ImGui::SetCursorScreenPos({view.x + 0.5f * (view.width - size.x), view.y + 0.45f * view.height});
  ImGui::TextColored({look::kQuiet.x, look::kQuiet.y, look::kQuiet.z, 1.0f}, "%s", text);
  if (studio.loader().activity()) return;
  ImGui::SetCursorScreenPos(
      {view.x + 0.5f * (view.width - Px(140.0f)), view.y + 0.45f * view.height + Px(28.0f)});
  if (ImGui::Button("Open the demo", {Px(140.0f), 0.0f})) {
    studio.OpenMotion();
    if (studio.avatars().empty()) studio.OpenDemoCast();
  }
}

}  // namespace

void ShowViewport(Studio& studio) {
  const Rect view = studio.layout().viewport;
  BeginViewport(view);
  const ViewportSize size{static_cast<int>(view.width), static_cast<int>(view.height)};
  ImGui::InvisibleButton("stage", {view.width, view.height},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  MoveCamera(studio, view, size);
  ShowOverlayStrip(studio, view);
  if (!studio.current_take() || !studio.frame().scene) ShowEmptyState(studio, view);
  ShowNavigationMenu(studio, view);
  ShowError(studio, view);
  ImGui::End();
}

}  // namespace ego
