// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"

namespace ego {
namespace {

// A long name with its end, which tells versions apart.
std::string Shortened(const std::string& name) {
  constexpr std::size_t kLongest = 44;
  constexpr std::size_t kEnd = 16;
  if (name.size() <= kLongest) return name;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(name[i]) & 0xC0u) == 0x80u;  // UTF-8
  };
  std::size_t head = kLongest - kEnd;
  std::size_t tail = name.size() - kEnd;
  while (head > 0 && continues(head)) --head;
  while (tail < name.size() && continues(tail)) ++tail;
  return name.substr(0, head) + "\u2026" + name.substr(tail);
}

void AskAboutUnsaved(Studio& studio, const Rect& within) {
  const auto unsaved = studio.calibrate().Unsaved();
  std::string names;
  for (const CalibrationSession* session : unsaved) {
    names += (names.empty() ? "" : ", ") + session->name();
  }
  BeginCard("unsaved", within, 480.0f, 136.0f);
  Section("Save before closing?");
  Quiet("Not saved yet: the calibration of " + names + ".");
  ImGui::Dummy({0.0f, Px(4.0f)});
  if (PrimaryButton("Save and close")) studio.SaveAndClose();
  ImGui::SameLine();
  if (ImGui::Button("Close without saving")) studio.CloseWithoutSaving();
  ImGui::SameLine();
  if (ImGui::Button("Keep working")) studio.asks_to_close = false;
  EndCard();
}

void OfferLeftBehind(Studio& studio, const Rect& within) {
  const auto& left = studio.left_behind();
  BeginCard("left behind", within, 480.0f, 108.0f + 32.0f * static_cast<float>(left.size()));
  Section("Unsaved picks were found");
  Quiet("Egostudio ended before these calibrations were saved.");
  std::filesystem::path chosen;
  for (const Recovery& recovery : left) {
    const std::string label = std::to_string(recovery.picked) +
                              (recovery.picked == 1 ? " pick on " : " picks on ") +
                              Shortened(recovery.avatar.filename().string());
    if (ImGui::Button(label.c_str())) chosen = recovery.avatar;
    Tip(recovery.avatar.c_str());
  }
  if (ImGui::Button("Not now")) studio.ForgetLeftBehind();
  Tip("They are offered again when the avatar is calibrated");
  EndCard();
  if (chosen.empty()) return;
  studio.ForgetLeftBehind();
  studio.CalibrateFile(chosen);
}

}  // namespace

void ShowQuestions(Studio& studio) {
  const FrameLayout& layout = studio.layout();
  const Rect window{0.0f, 0.0f, layout.bar.width, layout.status.y};
  if (studio.asks_to_close) {
    AskAboutUnsaved(studio, window);
  } else if (!studio.left_behind().empty() && studio.workspace() == Workspace::kPerform &&
             !studio.palette().is_open() && !studio.show_keys) {
    OfferLeftBehind(studio, window);
  }
}

}  // namespace ego
