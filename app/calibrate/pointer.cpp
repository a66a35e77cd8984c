// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>

#include "app/calibrate/workspace.h"
#include "app/panels/widgets.h"
#include "app/studio.h"

namespace ego {
namespace {

constexpr float kClickSlack = 4.0f;        // a drag shorter than this is a click
constexpr double kCursorRadius = 14.0;     // within which a vertex is snapped to
constexpr double kDotRadius = 7.0;         // within which a dot is taken
constexpr double kMirrorTolerance = 0.02;  // of the body's height

Vec2 PointerAt() {
  const ImVec2 at = ImGui::GetIO().MousePos;
  return {at.x, at.y};
}

std::optional<HumanoidJoint> JointAt(const CalibrationSession& session, const Lens& lens,
                                     const Vec2& pixel) {
  std::optional<HumanoidJoint> found;
  double nearest = 12.0 * static_cast<double>(Gui::Current().scale());
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto at = lens.ToWindow(session.pose().position_ws[j]);
    if (!at || glm::length(*at - pixel) >= nearest) continue;
    nearest = glm::length(*at - pixel);
    found = static_cast<HumanoidJoint>(j);
  }
  return found;
}

std::optional<VertexPick> VertexAt(const CalibrationSession& session, const Lens& lens,
                                   const Vec2& pixel) {
  const double radius = kCursorRadius * static_cast<double>(Gui::Current().scale());
  return session.picker().NearestVertex(lens.ConeAt(pixel, radius));
}

void FindHover(CalibrateWorkspace& work, const CalibrationSession& session, const Lens& lens) {
  const Vec2 pixel = PointerAt();
  Hover& hover = work.hover;
  hover = {};
  if (work.list == CalibrateWorkspace::List::kJoints) {
    hover.joint = JointAt(session, lens, pixel);
    return;
  }
  hover.item = ItemAt(work, session, lens, pixel);
  if (hover.item && hover.item == session.current()) hover.item.reset();
  hover.vertex = VertexAt(session, lens, pixel);
  if (hover.item || !hover.vertex || !session.current()) return;
  const PickItem& item = *session.current();
  const SurfaceMesh& surface = session.editor().Surface();
  if (item.segment) {
    hover.ring =
        surface.Ring(*item.segment, session.ShareAlong(*item.segment, hover.vertex->place));
    return;
  }
  if (!session.editor().Symmetric() || Mirror(item) == item) return;
  const double tolerance = kMirrorTolerance * session.editor().AvatarBody().height;
  hover.mirror = surface.MirrorOf(hover.vertex->place, tolerance);
  hover.no_mirror = !hover.mirror;
}

void DragPoint(Studio& studio, CalibrationSession& session, const Lens& lens) {
  CalibrateWorkspace& work = studio.calibrate();
  const std::optional<VertexPick> vertex = VertexAt(session, lens, PointerAt());
  if (!vertex) return;
  work.hover = {};
  work.hover.vertex = vertex;
  const CalibrationPoint* point = Find(session.calibration(), work.dragged->point);
  if (point && point->place == vertex->place && Settled(point->state)) return;
  const Result<void> done = session.editor().Pick(work.dragged->point, vertex->place);
  if (!done) work.Note(studio, done.error(), true);
}

void EndDrag(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  if (!work.dragged) return;
  session.editor().EndGroup();
  if (!session.editor().Note().empty()) work.Note(studio, session.editor().Note(), false);
  work.dragged.reset();
}

void Click(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  if (work.list == CalibrateWorkspace::List::kJoints) {
    if (work.hover.joint) {
      work.asked_joint = work.hover.joint;
      work.joint_filter.fill('\0');
      work.open_joint_list = true;
    }
    return;
  }
  if (work.hover.item) {
    work.Select(studio, *work.hover.item);
  } else if (work.hover.vertex) {
    const bool dot = ImGui::GetIO().KeyShift && session.current() && session.current()->segment;
    work.Pick(studio, work.hover.vertex->place, dot);
  }
}

Held HeldNow() {
  const ImGuiIO& io = ImGui::GetIO();
  return {io.MouseDown[ImGuiMouseButton_Left],
          io.MouseDown[ImGuiMouseButton_Right],
          io.MouseDown[ImGuiMouseButton_Middle],
          io.KeyShift,
          io.KeyCtrl,
          io.KeyAlt};
}

}  // namespace

std::optional<PickItem> ItemAt(const CalibrateWorkspace& work, const CalibrationSession& session,
                               const Lens& lens, const Vec2& pixel) {
  std::optional<PickItem> found;
  double nearest = kDotRadius * static_cast<double>(Gui::Current().scale());
  const Vec3 eye = lens.camera.Position();
  for (const PickItem& item : PickItems()) {
    if (item.segment) continue;
    const std::optional<Vec3> at = session.PositionOf(item);
    const auto window = at ? lens.ToWindow(*at) : std::nullopt;
    if (!window || glm::length(*window - pixel) >= nearest) continue;
    if (!work.habits.look.xray && !session.picker().Visible(eye, *at)) continue;
    nearest = glm::length(*window - pixel);
    found = item;
  }
  return found;
}

void HandlePointer(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  const ImGuiIO& io = ImGui::GetIO();
  const Lens lens = work.LensOf(studio);
  const bool hovered = ImGui::IsItemHovered();
  const bool active = ImGui::IsItemActive();
  const Vec2 pointer = PointerAt() - Vec2(lens.rect.x, lens.rect.y);
  Camera& camera = work.view().camera;

  if (hovered && io.MouseWheel != 0.0f) {
    work.view().StopGlide();
    camera.Zoom(static_cast<double>(io.MouseWheel), pointer, lens.size());
  }
  if (ImGui::IsItemActivated()) {
    const bool takes = io.MouseDown[ImGuiMouseButton_Left] && !io.KeyAlt &&
                       work.list == CalibrateWorkspace::List::kPoints;
    work.pressed = takes ? ItemAt(work, session, lens, PointerAt()) : std::nullopt;
  }
  const float slack = Px(kClickSlack) * Px(kClickSlack);
  const auto dragged_far = [&](ImGuiMouseButton button) {
    return io.MouseDragMaxDistanceSqr[button] >= slack;
  };
  if (active && work.pressed && !work.dragged && dragged_far(ImGuiMouseButton_Left)) {
    work.dragged = work.pressed;
    session.Select(*work.dragged);
    session.editor().BeginGroup("Move " + Title(*work.dragged));
  }
  bool moving = false;
  if (active && work.dragged) {
    DragPoint(studio, session, lens);
  } else if (active && !work.pressed) {
    const CameraMove move = MoveOf(studio.navigation(), HeldNow());
    const bool far = dragged_far(ImGuiMouseButton_Left) || dragged_far(ImGuiMouseButton_Right) ||
                     dragged_far(ImGuiMouseButton_Middle);
    moving = move != CameraMove::kNone && far;
    if (moving && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
      work.view().StopGlide();
      Apply(move, {io.MouseDelta.x, io.MouseDelta.y}, pointer, lens.size(), camera);
    }
  }
  if (work.dragged) {
    if (!active) EndDrag(studio, session);
    return;
  }
  if (!hovered || moving) {
    work.hover = {};
  } else {
    FindHover(work, session, lens);
  }
  const bool clicked = ImGui::IsItemDeactivated() && io.MouseReleased[ImGuiMouseButton_Left] &&
                       !dragged_far(ImGuiMouseButton_Left) && !io.KeyAlt;
  if (clicked && hovered) Click(studio, session);
  if (!active) work.pressed.reset();
}

}  // namespace ego
