// SPDX-License-Identifier: MIT
// The half of the studio that the eye and the keyboard meet.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include "app/actions/action.h"
#include "app/studio.h"

namespace ego {
namespace {

constexpr double kRaisedHands = 0.2;  // of the figures' height: hands above the head stay in view

}  // namespace

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
  box.max.y += kRaisedHands * (box.max.y - box.min.y);
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

void Studio::FrameEveryone() {
  FrameAll();
  frame_when_ready_ = true;
}

void Studio::HandleKeys() {
  for (const KeyPress& press : window_->presses()) {
    last_change_ = std::chrono::steady_clock::now();
    // What is written into a field, or into the palette, means nothing else.
    if (ImGui::GetIO().WantTextInput || palette_.is_open()) return;
    if (asks_to_close) {
      if (press.key == GLFW_KEY_ESCAPE) asks_to_close = false;
      if (press.key == GLFW_KEY_ENTER) SaveAndClose();
      continue;
    }
    RunPressed(press, *this);
  }
}

}  // namespace ego
