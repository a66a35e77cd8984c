// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/actions/action.h"
#include "app/panels/panels.h"
#include "app/panels/widgets.h"
#include "app/studio.h"
#include "render/look.h"

namespace ego {
namespace {

constexpr float kRow = 21.0f;
constexpr float kColumn = 330.0f;

struct Line {
  std::string keys;  // empty: `what` is a heading
  std::string what;
};

// What the keys do in this workspace, group by group, whether or not it is possible just now.
std::vector<std::vector<Line>> Groups(const Studio& studio) {
  const bool performs = studio.workspace() == Workspace::kPerform;
  const auto other = performs ? Action::Where::kCalibrate : Action::Where::kPerform;
  std::vector<std::vector<Line>> groups;
  for (const Action& action : Actions()) {
    if (action.where == other || action.keys.empty()) continue;
    const std::string heading(action.group);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& g) { return g.front().what == heading; });
    if (group == groups.end()) group = groups.insert(groups.end(), {Line{"", heading}});
    group->push_back({KeysOf(action), std::string(action.name)});
  }
  groups.push_back({{"", "Mouse"}});
  for (const auto& [keys, what] : studio.MouseHelp()) groups.back().push_back({keys, what});
  return groups;
}

// Into two columns that are about equally long, groups whole.
std::array<std::vector<Line>, 2> Columns(const Studio& studio) {
  const auto groups = Groups(studio);
  std::size_t all = 0;
  for (const auto& group : groups) all += group.size();
  std::array<std::vector<Line>, 2> columns;
  for (const auto& group : groups) {
    const bool full = columns[0].size() + group.size() / 2 > all / 2;
    std::vector<Line>& to = columns[full ? 1 : 0];
    to.insert(to.end(), group.begin(), group.end());
  }
  return columns;
}

}  // namespace

void ShowKeys(Studio& studio) {
  if (!studio.show_keys) return;
  const auto columns = Columns(studio);
  const auto rows = static_cast<float>(std::max(columns[0].size(), columns[1].size()));
  const Rect& status = studio.layout().status;
  const float width = Px(2.0f * kColumn + 24.0f);
  const float height = Px(20.0f) + rows * Px(kRow);
  const Rect rect{0.5f * (status.width - width), std::max(0.0f, 0.5f * (status.y - height)), width,
                  height};
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, Px(6.0f));
  BeginPanel("keys", rect, look::kRaised, 12.0f, true);
  ImGui::PopStyleVar();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t r = 0; r < columns[c].size(); ++r) {
      const Line& line = columns[c][r];
      const float x = corner.x + static_cast<float>(c) * Px(kColumn);
      ImGui::SetCursorScreenPos({x, corner.y + static_cast<float>(r) * Px(kRow)});
      if (line.keys.empty()) {
        ImGui::PushFont(Gui::Current().fonts().section);
        ImGui::TextUnformatted(line.what.c_str());
        ImGui::PopFont();
        continue;
      }
      ImGui::PushFont(Gui::Current().fonts().small);
      ImGui::TextUnformatted(line.keys.c_str());
      ImGui::SetCursorScreenPos({x + Px(104.0f), corner.y + static_cast<float>(r) * Px(kRow)});
      ImGui::TextColored({look::kQuiet.x, look::kQuiet.y, look::kQuiet.z, 1.0f}, "%s",
                         line.what.c_str());
      ImGui::PopFont();
    }
  }
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered()) {
    studio.show_keys = false;
  }
  EndPanel();
}

}  // namespace ego
