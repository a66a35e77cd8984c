// SPDX-License-Identifier: MIT
#include "app/window/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstring>
#include <vector>

#include "app/view/fonts.h"
#include "app/window/window.h"
#include "render/look.h"

namespace ego {
namespace {

ImVec4 Color(const glm::vec3& c, float alpha = 1.0f) { return {c.x, c.y, c.z, alpha}; }

// Latin, Greek and Cyrillic names, and the signs that the panels use.
constexpr ImWchar kGlyphs[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x0400, 0x04FF, 0x2010,
                               0x2027, 0x2190, 0x2193, 0x2212, 0x2212, 0};

ImFont* AddFace(const std::vector<std::uint8_t>& face, float pixels) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (face.empty()) {
    ImFontConfig config;
    config.SizePixels = pixels;
    return atlas.AddFontDefault(&config);
  }
  // The atlas frees what it is given.
  void* copy = ImGui::MemAlloc(face.size());
  std::memcpy(copy, face.data(), face.size());
  return atlas.AddFontFromMemoryTTF(copy, static_cast<int>(face.size()), pixels, nullptr, kGlyphs);
}

void SetColors(ImGuiStyle& style) {
  ImVec4* c = style.Colors;
  for (int i = 0; i < ImGuiCol_COUNT; ++i) c[i] = Color(look::kRaised);
  c[ImGuiCol_Text] = Color(look::kText);
  c[ImGuiCol_TextDisabled] = Color(look::kOff);
  c[ImGuiCol_WindowBg] = Color(look::kPanel);
  c[ImGuiCol_ChildBg] = Color(look::kPanel, 0.0f);
  c[ImGuiCol_PopupBg] = Color(look::kRaised);
  c[ImGuiCol_Border] = Color(look::kLine);
  c[ImGuiCol_BorderShadow] = Color(look::kLine, 0.0f);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_FrameBgActive] = Color(look::kLine);
  c[ImGuiCol_ButtonHovered] = c[ImGuiCol_ButtonActive] = Color(look::kLine);
  c[ImGuiCol_HeaderHovered] = c[ImGuiCol_HeaderActive] = Color(look::kLine);
  c[ImGuiCol_Separator] = Color(look::kLine);
  c[ImGuiCol_ScrollbarBg] = Color(look::kPanel, 0.0f);
  c[ImGuiCol_ScrollbarGrab] = Color(look::kLine);
  c[ImGuiCol_ScrollbarGrabHovered] = c[ImGuiCol_ScrollbarGrabActive] = Color(look::kOff);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrab] = Color(look::kAccent);
  c[ImGuiCol_SliderGrabActive] = c[ImGuiCol_NavHighlight] = Color(look::kAccent);
  c[ImGuiCol_PlotHistogram] = Color(look::kAccent);
  c[ImGuiCol_TextSelectedBg] = Color(look::kAccent, 0.35f);
}

}  // namespace

Gui::Gui(Window& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.UserData = this;
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), false);  // the window installs the callbacks
  ImGui_ImplOpenGL3_Init("#version 330 core");
  Rebuild(window.content_scale());
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

const Gui& Gui::Current() { return *static_cast<const Gui*>(ImGui::GetIO().UserData); }

void Gui::Rebuild(float scale) {
  scale_ = scale;
  ImGui::GetIO().Fonts->Clear();
  const std::vector<std::uint8_t> text = ReadFace(Face::kText);
  const std::vector<std::uint8_t> strong = ReadFace(Face::kTextStrong);
  fonts_.body = AddFace(text, 15.0f * scale);
  fonts_.small = AddFace(text, 13.0f * scale);
  fonts_.section = AddFace(strong, 15.0f * scale);
  fonts_.mono = AddFace(ReadFace(Face::kMono), 13.0f * scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();

  ImGuiStyle style;
  SetColors(style);
  style.WindowPadding = {12.0f, 12.0f};
  style.FramePadding = {8.0f, 5.0f};
  style.ItemSpacing = {8.0f, 6.0f};
  style.ItemInnerSpacing = {8.0f, 4.0f};
  style.WindowRounding = 0.0f;
  style.WindowBorderSize = 0.0f;
  style.ChildBorderSize = 0.0f;
  style.FrameRounding = 6.0f;
  style.PopupRounding = 6.0f;
  style.GrabRounding = 6.0f;
  style.GrabMinSize = 12.0f;
  style.ScrollbarSize = 10.0f;
  style.ScrollbarRounding = 5.0f;
  style.WindowMinSize = {1.0f, 1.0f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

void Gui::Begin() {
  if (window_.content_scale() != scale_) Rebuild(window_.content_scale());
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  // As of the last poll, not as of now: a click counts where it was made.
  const Pointer& pointer = window_.pointer();
  const bool held = std::any_of(pointer.down.begin(), pointer.down.end(), [](bool d) { return d; });
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = pointer.inside || held ? ImVec2(pointer.x, pointer.y) : ImVec2(-FLT_MAX, -FLT_MAX);
  std::copy(pointer.down.begin(), pointer.down.end(), io.MouseDown);
  ImGui::NewFrame();
  ImGui::PushFont(fonts_.body);
}

void Gui::End() {
  ImGui::PopFont();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace ego
