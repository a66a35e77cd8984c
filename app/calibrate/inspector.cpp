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

constexpr float kPictureHeight = 196.0f;

ImVec4 Vec(const glm::vec3& c) { return {c.x, c.y, c.z, 1.0f}; }

// A person of the studio's own cast on whom the item is marked.
void ShowReference(Studio& studio, const CalibrationSession& session) {
  ReferenceFigure& reference = studio.calibrate().reference();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = Px(kPictureHeight);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  const GuiTexture* picture =
      reference.PictureOf(studio.picture().renderer(), *session.current(), static_cast<int>(width),
                          static_cast<int>(height));
  if (!picture) {
    list.AddRectFilled(corner, end, Packed(look::kRoom), Px(6.0f));
    const char* text = "Preparing the figure";
    const ImVec2 size = ImGui::CalcTextSize(text);
    list.AddText({corner.x + 0.5f * (width - size.x), corner.y + 0.5f * (height - size.y)},
                 Packed(look::kQuiet), text);
    return;
  }
  list.AddImageRounded(picture->id(), corner, end, {0, 0}, {1, 1}, IM_COL32_WHITE, Px(6.0f));
  const Lens lens =
      reference.LensOf(*session.current(), static_cast<int>(width), static_cast<int>(height));
  list.PushClipRect(corner, end, true);
  const auto at = [&](const PickItem& item) -> std::optional<ImVec2> {
    const auto p = lens.ToWindow(reference.PositionOf(item));
    if (!p) return std::nullopt;
    return ImVec2(corner.x + static_cast<float>(p->x), corner.y + static_cast<float>(p->y));
  };
  const PickItem& item = *session.current();
  const PickItem other = Mirror(item);
  if (session.editor().Symmetric() && other != item) {
    if (const auto p = at(other))
      list.AddCircle(*p, Px(7.0f), Packed(look::kAccent, 0.7f), 24, Px(2.0f));
  }
  if (const auto p = at(item)) {
    list.AddCircleFilled(*p, Px(6.5f), Packed(look::kRoom, 0.8f), 24);
    list.AddCircleFilled(*p, Px(5.0f), Packed(look::kAccent), 24);
    list.AddCircle(*p, Px(12.0f), Packed(look::kAccent), 32, Px(2.0f));
  }
  list.PopClipRect();
}

void ShowState(const CalibrationSession& session, const PickItem& item) {
  const PickState state = StateOf(session.calibration(), item);
  char words[96];
  const double percent = 100.0 * ConfidenceOf(session.calibration(), item);
  glm::vec3 color = look::kQuiet;
  if (Settled(state)) {
    std::snprintf(words, sizeof(words), state == PickState::kPicked ? "Picked" : "Confirmed");
    color = look::kGood;
  } else if (state == PickState::kMissing) {
    std::snprintf(words, sizeof(words), "Missing: click it on the figure");
    color = look::kBad;
  } else if (state == PickState::kDoubtful) {
    std::snprintf(words, sizeof(words), "Doubtful, %.0f %% sure", percent);
    color = look::kWarn;
  } else {
    std::snprintf(words, sizeof(words), "Proposed, %.0f %% sure", percent);
  }
  ImGui::PushFont(Gui::Current().fonts().small);
  ImGui::TextColored(Vec(color), "%s", words);
  ImGui::PopFont();
  const std::string& reason = ReasonOf(session.calibration(), item);
  if (!reason.empty() && !Settled(state)) Quiet("Because " + reason + ".");
}

void ShowThickness(const CalibrationSession& session, LimbSegment segment) {
  const SegmentCalibration& limb = session.calibration().At(segment);
  char number[32];
  std::snprintf(number, sizeof(number), "%.1f", 100.0 * limb.radius);
  Fact("Radius of its capsule", number, "cm");
  Fact("Points around it", std::to_string(limb.dots.size()));
}

// Buttons that break onto the next line where the panel is narrow.
bool Small(const char* label, const char* tip, bool first = false) {
  ImGui::PushFont(Gui::Current().fonts().small);
  const float width = ImGui::CalcTextSize(label).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  if (!first) {
    ImGui::SameLine(0.0f, Px(4.0f));
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  }
  const bool pressed = ImGui::Button(label);
  ImGui::PopFont();
  Tip(tip);
  return pressed;
}

void ShowItem(Studio& studio, CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  if (!session.current()) {
    Section("Everything is settled");
    Quiet(session.editor().Unsaved() ? "Ctrl+S saves the calibration beside the avatar."
                                     : "The calibration is saved. Try the test postures below.");
    if (session.editor().Unsaved() && ImGui::Button("Save")) work.Save(studio);
    return;
  }
  const PickItem item = *session.current();
  ShowReference(studio, session);
  Section(Title(item).c_str());
  Quiet(Place(item));
  ShowState(session, item);
  if (item.segment) ShowThickness(session, *item.segment);
  const PickState state = StateOf(session.calibration(), item);
  const bool can_confirm = !Settled(state) && state != PickState::kMissing;
  if (can_confirm && Small("Confirm", "It is right as it is (Enter)", true)) work.Confirm(studio);
  if (Small("Next doubtful", "Goes to the next that should be looked at (Tab)", !can_confirm)) {
    work.GoToDoubtful(studio, true);
  }
  if (!item.segment && Mirror(item) != item &&
      Small("Mirror over",
            "Puts the other side's point where this one's mirror image is (Ctrl+M)")) {
    work.MirrorOver(studio);
  }
  if (Small("Proposal", "Back to what the studio proposed (Backspace)")) work.Reset(studio);
  if (state != PickState::kMissing && Small("Delete", "Forgets it (Delete)")) work.Delete(studio);
}

// One finding: a mark by severity and the sentence; true when clicked.
bool FindingRow(const CalibrationFinding& finding, bool chosen) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushFont(Gui::Current().fonts().small);
  const float wrap = width - Px(30.0f);
  const ImVec2 size = ImGui::CalcTextSize(finding.sentence.c_str(), nullptr, false, wrap);
  const float height = size.y + Px(10.0f);
  const bool pressed = ImGui::InvisibleButton("finding", {width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  if (chosen || ImGui::IsItemHovered()) {
    list.AddRectFilled(corner, end, Packed(look::kRaised), Px(6.0f));
  }
  const ImVec2 c{corner.x + Px(12.0f), corner.y + Px(5.0f) + 0.5f * ImGui::GetFontSize()};
  const float r = Px(5.0f);
  switch (finding.severity) {
    case Severity::kError:
      list.AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, Packed(look::kBad), Px(1.5f));
      break;
    case Severity::kWarning:
      list.AddTriangleFilled({c.x, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r},
                             Packed(look::kWarn));
      break;
    case Severity::kNote:
      list.AddCircle(c, 0.7f * r, Packed(look::kQuiet), 16, Px(1.5f));
      break;
  }
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {corner.x + Px(26.0f), corner.y + Px(5.0f)},
               Packed(look::kText), finding.sentence.c_str(), nullptr, wrap);
  ImGui::PopFont();
  return pressed;
}

void ShowFindings(Studio& studio, const CalibrationSession& session) {
  CalibrateWorkspace& work = studio.calibrate();
  const auto& findings = session.editor().Findings();
  Section("Checks");
  if (findings.empty()) {
    Quiet("Nothing looks wrong.");
    return;
  }
  int id = 0;
  std::optional<CalibrationFinding> clicked;
  for (const CalibrationFinding& finding : findings) {
    ImGui::PushID(++id);
    const bool chosen = work.shown_finding && work.shown_finding->sentence == finding.sentence;
    if (FindingRow(finding, chosen)) clicked = finding;
    ImGui::PopID();
  }
  if (clicked) work.ShowFinding(studio, *clicked);
}

}  // namespace

void ShowCalibrateInspector(Studio& studio) {
  if (BeginPanel("calibrate inspector", studio.layout().inspector, look::kPanel)) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {Px(8.0f), Px(4.0f)});
    if (CalibrationSession* session = studio.calibrate().session()) {
      ShowItem(studio, *session);
      ShowFindings(studio, *session);
      for (const std::string& warning : session->warnings()) Quiet(warning);
    } else {
      Section("Nothing open");
      Quiet("The point that is asked for is described here.");
    }
    ImGui::PopStyleVar();
  }
  EndPanel();
}

}  // namespace ego
