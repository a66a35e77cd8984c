// SPDX-License-Identifier: MIT
#include "app/panels/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/window/gui.h"
#include "render/look.h"

namespace ego {
namespace {

ImVec4 Vec(const glm::vec3& c, float alpha = 1.0f) { return {c.x, c.y, c.z, alpha}; }

// Strokes of a sign within a square of side `s` whose middle is `c`.
void DrawSign(ImDrawList& list, Sign sign, ImVec2 c, float s, ImU32 color) {
  const float h = 0.5f * s;
  const float stroke = std::max(1.5f, s * 0.1f);
  const auto at = [&](float x, float y) { return ImVec2(c.x + x * h, c.y + y * h); };
  const auto triangle = [&](float from, float to) {
    list.AddTriangleFilled(at(from, -0.8f), at(to, 0.0f), at(from, 0.8f), color);
  };
  const auto bar = [&](float x) {
    list.AddRectFilled(at(x - 0.14f, -0.8f), at(x + 0.14f, 0.8f), color);
  };
  switch (sign) {
    case Sign::kPlay:
      triangle(-0.6f, 0.85f);
      return;
    case Sign::kPause:
      list.AddRectFilled(at(-0.65f, -0.8f), at(-0.2f, 0.8f), color);
      list.AddRectFilled(at(0.2f, -0.8f), at(0.65f, 0.8f), color);
      return;
    case Sign::kFirst:
      bar(-0.66f);
      triangle(0.75f, -0.45f);
      return;
    case Sign::kLast:
      bar(0.66f);
      triangle(-0.75f, 0.45f);
      return;
    case Sign::kBack:
      bar(0.55f);
      triangle(0.25f, -0.8f);
      return;
    case Sign::kForward:
      bar(-0.55f);
      triangle(-0.25f, 0.8f);
      return;
    case Sign::kLoop:
      list.PathArcTo(c, 0.72f * h, -0.9f, 4.1f, 24);
      list.PathStroke(color, 0, stroke);
      list.AddTriangleFilled(at(0.1f, -0.75f), at(0.72f, -0.95f), at(0.72f, -0.2f), color);
      return;
    case Sign::kEye:
    case Sign::kEyeOff:
      list.PathArcTo(at(0.0f, 0.85f), 1.28f * h, -2.42f, -0.72f, 16);
      list.PathStroke(color, 0, stroke);
      list.PathArcTo(at(0.0f, -0.85f), 1.28f * h, 0.72f, 2.42f, 16);
      list.PathStroke(color, 0, stroke);
      list.AddCircleFilled(c, 0.3f * h, color, 16);
      if (sign == Sign::kEyeOff) list.AddLine(at(-0.8f, 0.8f), at(0.8f, -0.8f), color, stroke);
      return;
    case Sign::kCross:
      list.AddLine(at(-0.55f, -0.55f), at(0.55f, 0.55f), color, stroke);
      list.AddLine(at(-0.55f, 0.55f), at(0.55f, -0.55f), color, stroke);
      return;
  }
}

}  // namespace

float Px(float size) { return std::round(size * Gui::Current().scale()); }

unsigned Packed(const glm::vec3& srgb, float alpha) {
  return ImGui::ColorConvertFloat4ToU32(Vec(srgb, alpha));
}

bool BeginPanel(const char* name, const Rect& rect, const glm::vec3& ground, float padding,
                bool above_others) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({std::max(rect.width, 1.0f), std::max(rect.height, 1.0f)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, Vec(ground));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {Px(padding), Px(padding)});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   (above_others ? 0 : ImGuiWindowFlags_NoBringToFrontOnFocus) |
                   ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return rect.width >= 2.0f && rect.height >= 2.0f;
}

void BeginViewport(const Rect& rect) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.width, rect.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  ImGui::Begin("viewport", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
}

void BeginCard(const char* name, const Rect& within, float width, float height) {
  const float w = std::min(Px(width), within.width - Px(16.0f));
  const float h = std::min(Px(height), within.height - Px(16.0f));
  const Rect rect{std::floor(within.x + 0.5f * (within.width - w)),
                  std::floor(within.y + 0.45f * (within.height - h)), w, h};
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, Px(8.0f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, Px(1.0f));
  BeginPanel(name, rect, look::kRaised, 16.0f, true);
  ImGui::PopStyleVar(2);
  ImGui::PushStyleColor(ImGuiCol_Button, Packed(look::kLine));
}

bool PrimaryButton(const char* label, float width) {
  ImGui::PushStyleColor(ImGuiCol_Button, Packed(look::kAccent));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, Packed(look::kAccent, 0.85f));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, Packed(look::kAccent, 0.7f));
  ImGui::PushStyleColor(ImGuiCol_Text, Packed(look::kRoom));
  const bool pressed = ImGui::Button(label, {width, 0.0f});
  ImGui::PopStyleColor(4);
  return pressed;
}

void EndPanel() { ImGui::End(); }

void EndCard() {
  ImGui::PopStyleColor();
  ImGui::End();
}

void Section(const char* title) {
  ImGui::Dummy({0.0f, Px(2.0f)});
  ImGui::PushFont(Gui::Current().fonts().section);
  ImGui::TextUnformatted(title);
  ImGui::PopFont();
}

void Quiet(std::string_view text) {
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::PushStyleColor(ImGuiCol_Text, Vec(look::kQuiet));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void Fact(const char* name, std::string_view value, const char* unit) {
  const GuiFonts& fonts = Gui::Current().fonts();
  const std::string text(value);
  ImGui::PushFont(fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, Vec(look::kQuiet));
  ImGui::TextUnformatted(name);
  const float unit_width = *unit ? ImGui::CalcTextSize(unit).x + Px(4.0f) : 0.0f;
  ImGui::PopStyleColor();
  ImGui::PopFont();
  ImGui::PushFont(fonts.mono);
  const float right = ImGui::GetWindowContentRegionMax().x;
  const float name_end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + Px(8.0f);
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SameLine(std::max(name_end, right - unit_width - width));
  ImGui::TextUnformatted(text.c_str());
  if (ImGui::IsItemHovered() && right - unit_width - width < name_end) {
    ImGui::SetTooltip("%s", text.c_str());
  }
  ImGui::PopFont();
  if (*unit) {
    ImGui::PushFont(fonts.small);
    ImGui::SameLine(0.0f, Px(4.0f));
    ImGui::TextColored(Vec(look::kQuiet), "%s", unit);
    ImGui::PopFont();
  }
}

bool SignButton(const char* id, Sign sign, const char* tip, bool lit, float size) {
  const ImVec2 side{Px(size), Px(size)};
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(id, side);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + side.x, corner.y + side.y};
  if (hovered) list.AddRectFilled(corner, end, Packed(look::kLine), Px(6.0f));
  const ImVec2 middle{corner.x + 0.5f * side.x, corner.y + 0.5f * side.y};
  const glm::vec3 color = lit ? look::kAccent : hovered ? look::kText : look::kQuiet;
  DrawSign(list, sign, middle, 0.48f * side.x, Packed(color));
  Tip(tip);
  return pressed;
}

bool Toggle(const char* label, const char* tip, bool on) {
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::PushStyleColor(ImGuiCol_Text, Vec(on ? look::kText : look::kOff));
  ImGui::PushStyleColor(ImGuiCol_Button, Vec(on ? look::kLine : look::kRaised));
  const bool pressed = ImGui::Button(label);
  ImGui::PopStyleColor(2);
  ImGui::PopFont();
  Tip(tip);
  return pressed;
}

void Tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {Px(8.0f), Px(6.0f)});
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::SetTooltip("%s", text);
  ImGui::PopFont();
  ImGui::PopStyleVar();
}

}  // namespace ego
