// SPDX-License-Identifier: MIT
#include <GLFW/glfw3.h>

#include "app/actions/action.h"
#include "app/studio.h"

namespace ego {

void AddCommonActions(std::vector<Action>& actions) {
  const auto add = [&](std::string_view name, std::vector<Chord> keys,
                       std::function<void(Studio&)> run) {
    actions.push_back(
        {name, "Studio", Action::Where::kEverywhere, std::move(keys), std::move(run)});
  };
  add("Calibrate avatars", {{GLFW_KEY_1, true}},
      [](Studio& s) { s.EnterWorkspace(Workspace::kCalibrate); });
  add("Perform on stage", {{GLFW_KEY_2, true}},
      [](Studio& s) { s.EnterWorkspace(Workspace::kPerform); });
  add("Search all commands", {{GLFW_KEY_P, true}, {GLFW_KEY_P, true, true}, {GLFW_KEY_K, true}},
      [](Studio& s) { s.palette().Toggle(); });
  add("Show all keys", {{GLFW_KEY_SLASH}}, [](Studio& s) { s.show_keys = !s.show_keys; });
  add("Fold all panels away", {{GLFW_KEY_TAB, true}, {GLFW_KEY_F9}},
      [](Studio& s) { s.layout().ToggleAll(); });
  add("Close the window", {{GLFW_KEY_Q, true}}, [](Studio& s) { s.AskToClose(); });
}

}  // namespace ego
