// SPDX-License-Identifier: MIT
#include "app/panels/frame_layout.h"

#include <algorithm>
#include <cmath>

namespace ego {
namespace {

constexpr float kBar = 44.0f;
constexpr float kStatus = 28.0f;
constexpr float kNarrowest = 200.0f;
constexpr float kWidest = 520.0f;
constexpr float kLowest = 96.0f;
constexpr float kHighest = 360.0f;

}  // namespace

void FrameLayout::Divide(float window_width, float window_height, float scale) {
  left = std::clamp(left, kNarrowest, kWidest);
  right = std::clamp(right, kNarrowest, kWidest);
  timeline = std::clamp(timeline, kLowest, kHighest);
  const auto px = [scale](float size) { return std::round(size * scale); };
  const float w_left = show_left ? std::min(px(left), 0.3f * window_width) : 0.0f;
  const float w_right = show_right ? std::min(px(right), 0.3f * window_width) : 0.0f;
  const float h_bar = px(kBar);
  const float h_status = px(kStatus);
  const float h_timeline = show_timeline ? std::min(px(timeline), 0.35f * window_height) : 0.0f;
  const float middle = std::max(1.0f, window_height - h_bar - h_status - h_timeline);

  bar = {0.0f, 0.0f, window_width, h_bar};
  left_rail = {0.0f, h_bar, std::floor(w_left), middle};
  inspector = {window_width - std::floor(w_right), h_bar, std::floor(w_right), middle};
  viewport = {left_rail.width, h_bar,
              std::max(1.0f, window_width - left_rail.width - inspector.width), middle};
  timeline_panel = {0.0f, h_bar + middle, window_width, h_timeline};
  status = {0.0f, window_height - h_status, window_width, h_status};
}

void FrameLayout::ToggleAll() {
  const bool show = !(show_left && show_right && show_timeline);
  show_left = show_right = show_timeline = show;
}

}  // namespace ego
