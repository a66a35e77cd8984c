// SPDX-License-Identifier: MIT
// The half of the studio that the eye and the keyboard meet.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include "app/studio.h"

namespace ego {

void Studio::DrawStage() {
  const Rect& view = layout_.viewport;
  const bool staged = current_take() != nullptr && frame().scene != nullptr;
  StageView stage;
  if (staged) {
    stage.figures = picture_.Arrange(frame(), overlays_, StageLayout::Line::kSideways, selection_);
    FollowHeading();
    FrameWhenChanged();
  }
  stage.camera = camera_;
  if (staged) stage.camera.target_ws += picture_.anchor();
  stage.name_plates = overlays_.names;
  DrawTarget target;
  target.x = static_cast<int>(view.x);
  target.y = window_->height() - static_cast<int>(view.y + view.height);
  target.width = static_cast<int>(view.width);
  target.height = static_cast<int>(view.height);
  // Names must not crowd a narrow viewport.
  const float room = view.width / (1000.0f * gui_.scale());
  target.content_scale = gui_.scale() * std::clamp(room, 0.7f, 1.0f);
  picture_.renderer().Draw(stage, target);
}

void Studio::FollowHeading() {
  const double turn = picture_.heading() - heading_;
  if (turn == 0.0) return;
  // Another take faces another way: the view keeps its side of the performer.
  heading_ += turn;
  camera_.yaw += turn;
  camera_.target_ws = glm::angleAxis(turn, kUp) * camera_.target_ws;
}

void Studio::FrameWhenChanged() {
  const auto roles = picture_.roles();
  const Rect& view = layout_.viewport;
  const bool same =
      std::equal(roles.begin(), roles.end(), framed_roles_.begin(), framed_roles_.end()) &&
      view.width == framed_view_.width && view.height == framed_view_.height;
  if (same || !frame_when_ready_) return;
  framed_roles_.assign(roles.begin(), roles.end());
  framed_view_ = view;
  FrameAll();
}

void Studio::FrameAll() {
  Box3 box = picture_.Bounds();
  if (box.IsEmpty()) return;
  MakeRoomForNames(box);
  const Rect& view = layout_.viewport;
  camera_.Frame(box, {static_cast<int>(view.width), static_cast<int>(view.height)}, 0.06);
}

void Studio::FrameSelected() {
  const auto roles = picture_.roles();
  const auto found = selection_ ? std::find(roles.begin(), roles.end(), *selection_) : roles.end();
  if (found == roles.end()) {
    FrameAll();
    return;
  }
  const auto index = static_cast<std::size_t>(found - roles.begin());
  const Box3 box = picture_.Bounds(index);
  if (box.IsEmpty()) return;
  const Rect& view = layout_.viewport;
  camera_.Frame(box, {static_cast<int>(view.width), static_cast<int>(view.height)}, 0.1);
  CameraMovedByHand();
}

void Studio::LookFrom(StandardView view) {
  camera_.Look(view);
  camera_.yaw += heading_;
  FrameAll();
}

void Studio::HandleKeys() {
  if (ImGui::GetIO().WantTextInput) return;
  const auto flip = [](bool& value) { value = !value; };
  for (const KeyPress& press : window_->presses()) {
    last_change_ = std::chrono::steady_clock::now();
    if (press.control) {
      if (press.key == GLFW_KEY_Z) UndoRemove();
      if (press.key == GLFW_KEY_Q && !press.repeated) window_->Close();
      continue;
    }
    const std::ptrdiff_t step = press.shift ? 10 : 1;
    switch (press.key) {
      case GLFW_KEY_LEFT:
        Step(-step);
        continue;
      case GLFW_KEY_RIGHT:
        Step(step);
        continue;
      default:
        break;
    }
    if (press.repeated) continue;
    switch (press.key) {
      case GLFW_KEY_SPACE:
        TogglePlaying();
        break;
      case GLFW_KEY_HOME:
        stage_.Seek(0);
        break;
      case GLFW_KEY_END:
        if (current_take()) stage_.Seek(current_take()->take.motion->poses.size() - 1);
        break;
      case GLFW_KEY_L:
        SetLoop(!loop_);
        break;
      case GLFW_KEY_F:
        FrameSelected();
        break;
      case GLFW_KEY_A:
        FrameAll();
        frame_when_ready_ = true;
        break;
      case GLFW_KEY_1:
      case GLFW_KEY_KP_1:
        LookFrom(StandardView::kFront);
        break;
      case GLFW_KEY_3:
      case GLFW_KEY_KP_3:
        LookFrom(StandardView::kSide);
        break;
      case GLFW_KEY_7:
      case GLFW_KEY_KP_7:
        LookFrom(StandardView::kTop);
        break;
      case GLFW_KEY_0:
      case GLFW_KEY_KP_0:
        LookFrom(StandardView::kThreeQuarter);
        break;
      case GLFW_KEY_B:
        flip(overlays_.surface);
        break;
      case GLFW_KEY_M:
        flip(overlays_.markers);
        break;
      case GLFW_KEY_K:
        flip(overlays_.skeleton);
        break;
      case GLFW_KEY_C:
        flip(overlays_.crude);
        break;
      case GLFW_KEY_T:
        flip(overlays_.contacts);
        break;
      case GLFW_KEY_S:
        flip(overlays_.true_sizes);
        break;
      case GLFW_KEY_N:
        flip(overlays_.names);
        break;
      case GLFW_KEY_TAB:
        layout_.ToggleAll();
        break;
      case GLFW_KEY_SLASH:
        show_keys = !show_keys;
        break;
      case GLFW_KEY_ESCAPE:
        if (show_keys) {
          show_keys = false;
        } else {
          selection_.reset();
        }
        break;
      default:
        break;
    }
  }
}

}  // namespace ego
