// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

std::string Clock(double seconds) {
  char text[32];
  const int minutes = static_cast<int>(seconds / 60.0);
  std::snprintf(text, sizeof(text), "%02d:%05.2f", minutes, seconds - 60.0 * minutes);
  return text;
}

void ShowTransport(Studio& studio, const CapturedMotion& motion) {
  StageThread& stage = studio.stage();
  const StageFrame& frame = studio.frame();
  const std::size_t last = motion.poses.size() - 1;
  if (SignButton("first", Sign::kFirst, "First frame (Home)")) stage.Seek(0);
  ImGui::SameLine(0.0f, 0.0f);
  if (SignButton("back", Sign::kBack, "One frame back (Left)")) studio.Step(-1);
  ImGui::SameLine(0.0f, 0.0f);
  if (SignButton("play", frame.playing ? Sign::kPause : Sign::kPlay,
                 frame.playing ? "Pause (Space)" : "Play (Space)", true)) {
    studio.TogglePlaying();
  }
  ImGui::SameLine(0.0f, 0.0f);
  if (SignButton("forward", Sign::kForward, "One frame on (Right)")) studio.Step(1);
  ImGui::SameLine(0.0f, 0.0f);
  if (SignButton("last", Sign::kLast, "Last frame (End)")) stage.Seek(last);
  ImGui::SameLine(0.0f, Px(8.0f));
  if (SignButton("loop", Sign::kLoop, "Play in a loop (L)", studio.loop())) {
    studio.SetLoop(!studio.loop());
  }
  ImGui::SameLine(0.0f, Px(12.0f));
  ImGui::SetNextItemWidth(Px(150.0f));
  auto speed = static_cast<float>(studio.speed());
  ImGui::PushFont(Gui::Current().fonts().mono);
  if (ImGui::SliderFloat("##speed", &speed, static_cast<float>(Playhead::kSlowest),
                         static_cast<float>(Playhead::kFastest), "",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput)) {
    studio.SetSpeed(std::abs(speed - 1.0f) < 0.06f ? 1.0 : static_cast<double>(speed));
  }
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) studio.SetSpeed(1.0);
  Tip("Speed; right click for 1");
  char text[16];
  std::snprintf(text, sizeof(text), "%.2f x", studio.speed());
  ImGui::SameLine(0.0f, Px(8.0f));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::PopFont();

  const double length = static_cast<double>(motion.poses.size()) / motion.rate_hz;
  const std::string place = "frame " + std::to_string(frame.frame) + " / " + std::to_string(last) +
                            "    " + Clock(frame.time_s) + " / " + Clock(length);
  ImGui::PushFont(Gui::Current().fonts().mono);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(place.c_str()).x);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(place.c_str());
  ImGui::PopFont();
}

// A distance between ticks, seconds, that leaves room for their labels.
double TickStep(double length_s, float width) {
  const double wanted =
      length_s * static_cast<double>(Px(90.0f)) / std::max(1.0, static_cast<double>(width));
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0, 300.0}) {
    if (step >= wanted) return step;
  }
  return 600.0;
}

void ShowScrubber(Studio& studio, const CapturedMotion& motion) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float height = std::max(room.y, Px(24.0f));
  ImGui::InvisibleButton("scrub", {std::max(room.x, 1.0f), height});
  const auto count = motion.poses.size();
  const double last = static_cast<double>(count - 1);
  if (ImGui::IsItemActive() && last > 0.0) {
    const float share = std::clamp((ImGui::GetIO().MousePos.x - corner.x) / room.x, 0.0f, 1.0f);
    const auto wanted = static_cast<std::size_t>(std::lround(static_cast<double>(share) * last));
    if (wanted != studio.frame().frame) studio.stage().Seek(wanted);
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + room.x, corner.y + height};
  list.AddRectFilled(corner, end, Packed(look::kRaised), Px(6.0f));

  const double length = last / motion.rate_hz;
  const double step = TickStep(length, room.x);
  ImGui::PushFont(Gui::Current().fonts().mono);
  for (double t = 0.0; t <= length + 1e-9; t += step) {
    const float x = corner.x + room.x * static_cast<float>(length > 0.0 ? t / length : 0.0);
    list.AddLine({x, corner.y + Px(4.0f)}, {x, end.y - Px(4.0f)}, Packed(look::kLine));
    char label[24];
    std::snprintf(label, sizeof(label), "%g s", t);
    if (x + ImGui::CalcTextSize(label).x + Px(6.0f) < end.x) {
      list.AddText({x + Px(5.0f), corner.y + Px(4.0f)}, Packed(look::kQuiet), label);
    }
  }
  ImGui::PopFont();
  const float share =
      last > 0.0 ? static_cast<float>(static_cast<double>(studio.frame().frame) / last) : 0.0f;
  const float x = corner.x + share * room.x;
  list.AddRectFilled({x - Px(1.0f), corner.y}, {x + Px(1.0f), end.y}, Packed(look::kAccent));
  list.AddTriangleFilled({x - Px(6.0f), end.y}, {x + Px(6.0f), end.y}, {x, end.y - Px(8.0f)},
                         Packed(look::kAccent));
}

}  // namespace

void ShowTimeline(Studio& studio) {
  if (BeginPanel("timeline", studio.layout().timeline_panel, look::kPanel)) {
    const TakeEntry* take = studio.current_take();
    if (take && studio.frame().scene) {
      ShowTransport(studio, *take->take.motion);
      ShowScrubber(studio, *take->take.motion);
    } else {
      Quiet("The take that plays is shown here.");
    }
  }
  EndPanel();
}

}  // namespace ego
