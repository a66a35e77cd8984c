// SPDX-License-Identifier: MIT
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "app/calibrate/workspace.h"
#include "app/panels/palette.h"
#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "assets/calibration/calibration_file.h"
#include "render/look.h"

namespace ego {
namespace {

void ShowOffer(Studio& studio, CalibrationSession& session) {
  const std::size_t picked = session.offer()->picked;
  BeginCard("offer", studio.layout().viewport, 420.0f, 142.0f);
  Section("Unsaved picks were found");
  Quiet("Egostudio ended before " + std::to_string(picked) + (picked == 1 ? " pick" : " picks") +
        " on " + session.name() + " were saved.");
  ImGui::Dummy({0.0f, Px(4.0f)});
  if (PrimaryButton("Take them back")) studio.calibrate().Recover(studio);
  ImGui::SameLine();
  if (ImGui::Button("Leave them")) session.Decline();
  Tip("Deletes them and keeps the calibration as it is on disk");
  EndCard();
}

void ShowGuide(Studio& studio) {
  CalibrateWorkspace& work = studio.calibrate();
  BeginCard("guide", studio.layout().viewport, 460.0f, 250.0f);
  Section("Calibrate in three steps");
  const char* steps[] = {
      "1   The studio has proposed every point. Rings are proposals, rings with a point are "
      "doubtful, full dots are settled.",
      "2   Tab goes to the next doubtful one; click the skin where it should be, or press Enter if "
      "it is right. The picture at the right shows where it belongs.",
      "3   Confirm the rest with Ctrl+Enter, try a test posture below, save with Ctrl+S.",
  };
  for (const char* step : steps) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(step);
    ImGui::PopTextWrapPos();
  }
  Quiet("? shows all keys, Ctrl+P finds every command. Ctrl+Z takes anything back.");
  ImGui::Dummy({0.0f, Px(2.0f)});
  if (PrimaryButton("Begin")) {
    work.show_guide = false;
    work.habits.guide_seen = true;
  }
  EndCard();
}

void AskPath(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  static_assert(sizeof(work.path_text) > 256);
  if (work.path_text[0] == '\0') {
    std::filesystem::path start = session.editor().Path();
    if (start.empty()) {
      const char* home = std::getenv("HOME");
      start = std::filesystem::path(home ? home : "/tmp") / (session.name() + ".calib.json");
    }
    std::strncpy(work.path_text.data(), start.c_str(), work.path_text.size() - 1);
  }
  BeginCard("path", studio.layout().viewport, 560.0f, 150.0f);
  Section("Save the calibration as");
  ImGui::PushStyleColor(ImGuiCol_FrameBg, Packed(look::kPanel));
  ImGui::SetNextItemWidth(-1.0f);
  const bool enter = ImGui::InputText("##path", work.path_text.data(), work.path_text.size(),
                                      ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopStyleColor();
  Quiet("The avatar finds it by itself only under its own name beside it.");
  if (PrimaryButton("Save") || enter) {
    const std::filesystem::path path(work.path_text.data());
    work.path_text.fill('\0');
    work.SaveAs(studio, path);
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) {
    work.ask_path = false;
    work.path_text.fill('\0');
  }
  EndCard();
}

// Which node of the rig plays the asked joint.
void ShowJointList(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  if (std::exchange(work.open_joint_list, false)) ImGui::OpenPopup("joint");
  ImGui::SetNextWindowSize({Px(300.0f), Px(340.0f)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {Px(12.0f), Px(8.0f)});
  const bool open = ImGui::BeginPopup("joint", ImGuiWindowFlags_NoMove);
  ImGui::PopStyleVar();
  if (!open) {
    work.asked_joint.reset();
    return;
  }
  if (!work.asked_joint) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return;
  }
  const HumanoidJoint joint = *work.asked_joint;
  const Character& character = *session.editor().TheCharacter();
  Section(WordsOf(joint).c_str());
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::PushStyleColor(ImGuiCol_FrameBg, Packed(look::kPanel));
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##filter", "Search the rig's nodes", work.joint_filter.data(),
                           work.joint_filter.size());
  ImGui::PopStyleColor();
  ImGui::BeginChild("nodes");
  std::optional<std::optional<int>> chosen;
  const bool mended = session.calibration().joint_override[Index(joint)].has_value();
  // The first that is found is what Enter takes.
  bool enter = false;
  for (const KeyPress& press : studio.window().presses()) {
    enter |= press.key == GLFW_KEY_ENTER && work.joint_filter[0] != '\0';
    if (press.key == GLFW_KEY_ESCAPE) ImGui::CloseCurrentPopup();
  }
  if (mended && ImGui::Selectable("As the studio found it")) chosen = std::optional<int>();
  if (ImGui::Selectable("None: the rig has no such joint", character.map.Node(joint) < 0)) {
    chosen = -1;
  }
  for (std::size_t i = 0; i < character.nodes.joints.size(); ++i) {
    const std::string& name = character.nodes.joints[i].name;
    if (!HasWords(name, work.joint_filter.data())) continue;
    ImGui::PushID(static_cast<int>(i));
    const bool current = character.map.Node(joint) == static_cast<int>(i);
    const std::string shown = name.empty() ? "node " + std::to_string(i) : name;
    if (ImGui::Selectable(shown.c_str(), current) || std::exchange(enter, false)) {
      chosen = static_cast<int>(i);
    }
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (chosen) {
    ImGui::CloseCurrentPopup();
    work.SetJoint(studio, joint, *chosen);
  }
  ImGui::EndPopup();
}

}  // namespace

void ShowCards(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  ShowJointList(studio, session);
  if (studio.palette().is_open() || studio.show_keys) return;
  if (session.offer()) {
    ShowOffer(studio, session);
  } else if (work.show_guide) {
    ShowGuide(studio);
  } else if (work.ask_path) {
    AskPath(studio, session);
  }
}

}  // namespace ego
