// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

ImVec4 Vec(const glm::vec3& c) { return {c.x, c.y, c.z, 1.0f}; }

std::string Times(const Studio& studio) {
  const StageTimings& t = studio.frame().timings;
  char text[160];
  std::snprintf(text, sizeof(text), "%3.0f fps   read %3.0f \xC2\xB5s   adapt %4.0f \xC2\xB5s",
                studio.draw_hz(), t.normalize.p50_us, t.adapt.p50_us);
  return text;
}

void ShowActivity(Studio& studio, const BackgroundLoader::Activity& activity) {
  std::string text = activity.subject;
  if (!activity.what.empty()) text += ": " + activity.what;
  if (activity.waiting > 0) text += " (" + std::to_string(activity.waiting) + " more)";
  ImGui::TextUnformatted(text.c_str());
  ImGui::SameLine(0.0f, Px(12.0f));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = Px(140.0f);
  const float y = corner.y + 0.5f * ImGui::GetTextLineHeight();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x, y - Px(2.0f)}, {corner.x + width, y + Px(2.0f)},
                     Packed(look::kLine), Px(2.0f));
  const float done = width * static_cast<float>(activity.fraction);
  list.AddRectFilled({corner.x, y - Px(2.0f)}, {corner.x + done, y + Px(2.0f)},
                     Packed(look::kAccent), Px(2.0f));
  ImGui::Dummy({width, ImGui::GetTextLineHeight()});
  ImGui::SameLine(0.0f, Px(12.0f));
  if (ImGui::SmallButton("Cancel")) studio.loader().Cancel();
}

}  // namespace

void ShowStatusBar(Studio& studio) {
  if (BeginPanel("status", studio.layout().status, look::kRaised, 0.0f)) {
    ImGui::PushFont(Gui::Current().fonts().small);
    ImGui::SetCursorPos(
        {Px(12.0f), 0.5f * (ImGui::GetWindowHeight() - ImGui::GetTextLineHeight())});
    const float row = ImGui::GetCursorPosY();
    if (const auto activity = studio.loader().activity()) {
      ShowActivity(studio, *activity);
    } else if (studio.info()) {
      ImGui::TextColored(Vec(look::kQuiet), "%s", studio.info()->text.c_str());
    } else {
      ImGui::TextColored(Vec(look::kOff), "Ready.  ? shows all keys.");
    }
    ImGui::PopFont();
    ImGui::PushFont(Gui::Current().fonts().mono);
    const std::string times = Times(studio);
    const float left = ImGui::GetWindowWidth() - ImGui::CalcTextSize(times.c_str()).x - Px(12.0f);
    // What is said at the left may be long: the times stay readable over it.
    ImGui::GetWindowDrawList()->AddRectFilled(
        {ImGui::GetWindowPos().x + left - Px(12.0f), ImGui::GetWindowPos().y},
        {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
         ImGui::GetWindowPos().y + ImGui::GetWindowHeight()},
        Packed(look::kRaised));
    ImGui::SetCursorPos({left, row});
    ImGui::TextColored(Vec(look::kQuiet), "%s", times.c_str());
    if (ImGui::IsItemHovered()) {
      const StageTimings& t = studio.frame().timings;
      char tip[400];
      std::snprintf(tip, sizeof(tip),
                    "Pictures drawn per second, and the work per frame of the take:\n"
                    "median / slowest of a hundred\n"
                    "read the performer's posture %.0f / %.0f \xC2\xB5s\n"
                    "adapt it to all avatars %.0f / %.0f \xC2\xB5s\n"
                    "everything %.0f / %.0f \xC2\xB5s\n"
                    "frames of the take left out: %llu",
                    t.normalize.p50_us, t.normalize.p99_us, t.adapt.p50_us, t.adapt.p99_us,
                    t.frame.p50_us, t.frame.p99_us,
                    static_cast<unsigned long long>(studio.frame().frames_missed));
      Tip(tip);
    }
    ImGui::PopFont();
  }
  EndPanel();
}

}  // namespace ego
