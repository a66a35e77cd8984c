// SPDX-License-Identifier: MIT
#include "app/panels/palette.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "app/actions/action.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr std::size_t kRows = 10;
constexpr float kRow = 28.0f;

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// One found command; true when it is clicked.
bool Row(const Action& action, float width, bool chosen) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushID(&action);
  const bool pressed = ImGui::InvisibleButton("row", {width, Px(kRow)});
  ImGui::PopID();
  const ImVec2 end{corner.x + width, corner.y + Px(kRow)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (chosen || ImGui::IsItemHovered()) {
    list.AddRectFilled(corner, end, Packed(look::kLine), Px(6.0f));
  }
  const std::string name(action.name);
  const float top = corner.y + 0.5f * (Px(kRow) - ImGui::GetFontSize());
  list.AddText({corner.x + Px(8.0f), top}, Packed(look::kText), name.c_str());
  const std::string keys = KeysOf(action);
  ImGui::PushFont(Gui::Current().fonts().small);
  const float keys_width = ImGui::CalcTextSize(keys.c_str()).x;
  list.AddText({end.x - keys_width - Px(8.0f), top}, Packed(look::kQuiet), keys.c_str());
  ImGui::PopFont();
  return pressed;
}

}  // namespace

bool HasWords(std::string_view text, std::string_view wanted) {
  const std::string in = Lower(text);
  const std::string words = Lower(wanted);
  std::size_t from = 0;
  while (from < words.size()) {
    const std::size_t end = std::min(words.find(' ', from), words.size());
    if (in.find(words.substr(from, end - from)) == std::string::npos) return false;
    from = end + 1;
  }
  return true;
}

void Palette::Toggle() {
  open_ = !open_;
  wants_focus_ = open_;
  text_.fill('\0');
  chosen_ = 0;
}

void Palette::Find(const Studio& studio) {
  found_.clear();
  for (const Action& action : Actions()) {
    const std::string all = std::string(action.group) + " " + std::string(action.name);
    if (CanRun(action, studio) && HasWords(all, text_.data())) found_.push_back(&action);
  }
  chosen_ = found_.empty() ? 0 : std::min(chosen_, found_.size() - 1);
}

void Palette::Choose(Studio& studio, const Action& action) {
  open_ = false;
  action.run(studio);
}

void Palette::Show(Studio& studio) {
  if (!open_) return;
  Find(studio);
  const Rect& window = studio.layout().bar;
  const float width = std::min(Px(520.0f), window.width - Px(32.0f));
  const float rows = static_cast<float>(std::clamp(found_.size(), std::size_t{1}, kRows));
  const float height = Px(24.0f) + ImGui::GetFrameHeight() + Px(6.0f) + rows * Px(kRow);
  const Rect rect{0.5f * (window.width - width), window.height + Px(24.0f), width, height};
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, Px(6.0f));
  BeginPanel("palette", rect, look::kRaised, 12.0f, true);
  ImGui::PopStyleVar();
  if (wants_focus_) ImGui::SetKeyboardFocusHere();
  wants_focus_ = false;
  ImGui::PushStyleColor(ImGuiCol_FrameBg, Packed(look::kPanel));
  ImGui::SetNextItemWidth(width - Px(24.0f));
  if (ImGui::InputTextWithHint("##words", "Search all commands", text_.data(), text_.size())) {
    chosen_ = 0;
    Find(studio);
  }
  ImGui::PopStyleColor();

  const Action* run = nullptr;
  for (const KeyPress& press : studio.window().presses()) {
    if (press.key == GLFW_KEY_ESCAPE) open_ = false;
    if (press.key == GLFW_KEY_DOWN && chosen_ + 1 < found_.size()) ++chosen_;
    if (press.key == GLFW_KEY_UP && chosen_ > 0) --chosen_;
    const bool enter = press.key == GLFW_KEY_ENTER || press.key == GLFW_KEY_KP_ENTER;
    if (enter && chosen_ < found_.size()) run = found_[chosen_];
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
  // The chosen one stays in view.
  const std::size_t first = chosen_ < kRows ? 0 : chosen_ - kRows + 1;
  for (std::size_t i = first; i < std::min(found_.size(), first + kRows); ++i) {
    if (Row(*found_[i], width - Px(24.0f), i == chosen_)) run = found_[i];
  }
  ImGui::PopStyleVar();
  if (found_.empty()) Quiet("No command has these words.");
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
      !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) {
    open_ = false;
  }
  EndPanel();
  if (run) Choose(studio, *run);
}

}  // namespace ego
