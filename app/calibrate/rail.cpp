// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/calibrate/workspace.h"
#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr float kRow = 26.0f;

ImVec4 Vec(const glm::vec3& c) { return {c.x, c.y, c.z, 1.0f}; }

// The same signs as on the figure.
void StateSign(ImDrawList& list, ImVec2 c, PickState state) {
  const float r = Px(4.5f);
  if (Settled(state)) {
    list.AddCircleFilled(c, r + Px(1.0f), Packed(look::kGood), 20);
    list.AddLine({c.x - 0.5f * r, c.y}, {c.x - 0.1f * r, c.y + 0.45f * r}, Packed(look::kPanel),
                 Px(1.5f));
    list.AddLine({c.x - 0.1f * r, c.y + 0.45f * r}, {c.x + 0.6f * r, c.y - 0.45f * r},
                 Packed(look::kPanel), Px(1.5f));
  } else if (state == PickState::kDoubtful) {
    list.AddCircle(c, r, Packed(look::kWarn), 20, Px(2.0f));
    list.AddCircleFilled(c, Px(1.75f), Packed(look::kWarn), 12);
  } else if (state == PickState::kProposed) {
    list.AddCircle(c, r, Packed(look::kText), 20, Px(2.0f));
  } else {
    list.AddLine({c.x - r, c.y}, {c.x + r, c.y}, Packed(look::kBad), Px(2.0f));
  }
}

std::string StateWord(PickState state, double confidence) {
  if (state == PickState::kPicked) return "picked";
  if (state == PickState::kConfirmed) return "confirmed";
  if (state == PickState::kMissing) return "missing";
  char text[16];
  std::snprintf(text, sizeof(text), "%.0f %%", 100.0 * confidence);
  return text;
}

// A row with a sign at its left and a word at its right. True when clicked.
bool Row(const std::string& title, const std::string& word, bool chosen, bool quiet) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool pressed = ImGui::InvisibleButton("row", {width, Px(kRow)});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + Px(kRow)};
  if (chosen || ImGui::IsItemHovered()) {
    list.AddRectFilled(corner, end, Packed(look::kRaised), Px(6.0f));
  }
  if (chosen) {
    list.AddRectFilled(corner, {corner.x + Px(3.0f), end.y}, Packed(look::kAccent), Px(1.5f));
  }
  ImGui::PushFont(Gui::Current().fonts().small);
  const float top = corner.y + 0.5f * (Px(kRow) - ImGui::GetFontSize());
  const float word_left = end.x - ImGui::CalcTextSize(word.c_str()).x - Px(6.0f);
  list.AddText({word_left, top}, Packed(look::kQuiet), word.c_str());
  ImGui::PopFont();
  const ImVec4 clip{corner.x, corner.y, word_left - Px(6.0f), end.y};
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(),
               {corner.x + Px(28.0f), corner.y + 0.5f * (Px(kRow) - ImGui::GetFontSize())},
               Packed(quiet ? look::kQuiet : look::kText), title.c_str(), nullptr, 0.0f, &clip);
  return pressed;
}

void ShowAvatarChoice(Studio& studio) {
  CalibrateWorkspace& work = studio.calibrate();
  std::string name = "Choose an avatar";
  for (const AvatarEntry& entry : studio.avatars()) {
    if (entry.id == work.avatar_id()) name = entry.avatar.name;
  }
  const CalibrationSession* session = work.session();
  if (session && session->editor().Unsaved()) name.insert(0, "* ");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##avatar", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const AvatarEntry& entry : studio.avatars()) {
      ImGui::PushID(static_cast<int>(entry.id));
      if (ImGui::Selectable(entry.avatar.name.c_str(), entry.id == work.avatar_id())) {
        work.Open(studio, entry.id);
      }
      ImGui::PopID();
    }
    if (studio.avatars().empty()) Quiet("Drop a .glb, .gltf or .vrm file on the window.");
    ShowRecentFiles(studio);
    ImGui::EndCombo();
  } else if (!work.session() || !work.session()->avatar_path().empty()) {
    Tip("The avatar that is calibrated; recent files");
  } else {
    Tip("One of the studio's own cast: it has no file, so Ctrl+S asks where to save");
  }
}

void ShowProgress(Studio& studio, const CalibrationSession& session) {
  const std::size_t all = PickItems().size();
  const std::size_t settled = SettledItems(session.calibration());
  const std::string words = std::to_string(settled) + " of " + std::to_string(all) + " settled";
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::TextColored(Vec(look::kQuiet), "%s", words.c_str());
  ImGui::PopFont();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float height = Px(6.0f);
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, Packed(look::kLine), Px(3.0f));
  const float done = width * static_cast<float>(settled) / static_cast<float>(all);
  if (settled > 0) {
    list.AddRectFilled(corner, {corner.x + done, corner.y + height}, Packed(look::kGood), Px(3.0f));
  }
  ImGui::Dummy({width, height + Px(2.0f)});
  if (settled < all) {
    if (PrimaryButton("Confirm all proposals", width)) studio.calibrate().ConfirmAll(studio);
    Tip("Takes every proposed point as it is, doubtful ones too (Ctrl+Enter).\n"
        "Tab goes through the doubtful ones first, Enter confirms one.");
  } else {
    const bool unsaved = session.editor().Unsaved();
    if (ImGui::Button(unsaved ? "Save" : "Saved", {width, 0.0f}) && unsaved) {
      studio.calibrate().Save(studio);
    }
    Tip("Writes the calibration beside the avatar (Ctrl+S)");
  }
}

void ShowPoints(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  work.hovered_row.reset();
  std::string_view group;
  int id = 0;
  for (const PickItem& item : PickItems()) {
    if (GroupOf(item) != group) {
      group = GroupOf(item);
      ImGui::Dummy({0.0f, Px(2.0f)});
      ImGui::PushFont(Gui::Current().fonts().section);
      ImGui::TextUnformatted(group.data(), group.data() + group.size());
      ImGui::PopFont();
    }
    ImGui::PushID(++id);
    const PickState state = StateOf(session.calibration(), item);
    const bool chosen = session.current() == item;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const std::string word = StateWord(state, ConfidenceOf(session.calibration(), item));
    if (Row(Title(item), word, chosen, Settled(state) && !chosen)) work.Select(studio, item);
    if (ImGui::IsItemHovered()) {
      work.hovered_row = item;
      const std::string& reason = ReasonOf(session.calibration(), item);
      const std::string tip = Place(item) + (reason.empty() ? "" : "\n" + reason);
      Tip(tip.c_str());
    }
    StateSign(*ImGui::GetWindowDrawList(), {corner.x + Px(15.0f), corner.y + Px(0.5f * kRow)},
              state);
    // The current one stays in view when it changes from elsewhere.
    if (chosen && work.scrolled_to != session.current()) {
      ImGui::SetScrollHereY(0.4f);
      work.scrolled_to = session.current();
    }
    ImGui::PopID();
  }
}

std::string NodeName(const Character& character, int node) {
  const bool known = node >= 0 && static_cast<std::size_t>(node) < character.nodes.joints.size();
  return known ? character.nodes.joints[static_cast<std::size_t>(node)].name : "none";
}

void ShowJoints(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  const Character& character = *session.editor().TheCharacter();
  Quiet("Click a joint, here or on the figure, to choose another node of the rig for it.");
  bool open = false;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const HumanoidMap::Entry& entry = character.map.joint[j];
    const bool mended = session.calibration().joint_override[j].has_value();
    ImGui::PushID(static_cast<int>(j));
    const auto joint = static_cast<HumanoidJoint>(j);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (Row(WordsOf(joint), NodeName(character, entry.node), work.asked_joint == joint,
            entry.node < 0)) {
      work.asked_joint = joint;
      work.joint_filter.fill('\0');
      open = true;
    }
    if (ImGui::IsItemHovered()) {
      work.hover.joint = joint;
      char sure[48];
      std::snprintf(sure, sizeof(sure), "%.0f %% sure", 100.0 * entry.confidence);
      const std::string tip = NodeName(character, entry.node) + ", " +
                              (mended ? "chosen by hand" : sure) +
                              (entry.reason.empty() ? "" : "\n" + entry.reason);
      Tip(tip.c_str());
    }
    StateSign(*ImGui::GetWindowDrawList(), {corner.x + Px(15.0f), corner.y + Px(0.5f * kRow)},
              mended                    ? PickState::kConfirmed
              : entry.node < 0          ? PickState::kMissing
              : entry.confidence >= 0.6 ? PickState::kProposed
                                        : PickState::kDoubtful);
    ImGui::PopID();
  }
  if (open) work.open_joint_list = true;
  for (const std::string& note : character.map.notes) Quiet(note);
}

}  // namespace

void ShowCalibrateRail(Studio& studio) {
  if (BeginPanel("calibrate rail", studio.layout().left_rail, look::kPanel)) {
    CalibrateWorkspace& work = studio.calibrate();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {Px(8.0f), Px(4.0f)});
    ShowAvatarChoice(studio);
    if (CalibrationSession* session = work.session()) {
      using List = CalibrateWorkspace::List;
      if (Toggle("Points", "The points on the skin (P)", work.list == List::kPoints)) {
        work.list = List::kPoints;
      }
      ImGui::SameLine(0.0f, Px(4.0f));
      if (Toggle("Joints", "Which node of the rig plays which joint (J)",
                 work.list == List::kJoints)) {
        work.list = List::kJoints;
      }
      if (work.list == List::kPoints) ShowProgress(studio, *session);
      ImGui::BeginChild("list", {0.0f, 0.0f}, false, ImGuiWindowFlags_NoNav);
      ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {Px(8.0f), Px(1.0f)});
      if (work.list == List::kPoints) {
        ShowPoints(studio, *session);
      } else {
        ShowJoints(studio, *session);
      }
      ImGui::PopStyleVar();
      ImGui::EndChild();
    } else {
      Quiet("The points to pick are listed here once an avatar is open.");
    }
    ImGui::PopStyleVar();
  }
  EndPanel();
}

}  // namespace ego
