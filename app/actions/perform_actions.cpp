// SPDX-License-Identifier: MIT
#include <GLFW/glfw3.h>

#include <utility>

#include "app/actions/action.h"
#include "app/studio.h"

namespace ego {
namespace {

using Run = std::function<void(Studio&)>;

Run Flips(bool Overlays::*overlay) {
  return [overlay](Studio& s) { s.overlays().*overlay = !(s.overlays().*overlay); };
}

bool HasTake(const Studio& studio) { return studio.current_take() != nullptr; }

void AddPlaying(std::vector<Action>& actions) {
  const auto add = [&](std::string_view name, std::vector<Chord> keys, Run run,
                       bool repeats = false) {
    actions.push_back({name, "Playing", Action::Where::kPerform, std::move(keys), std::move(run),
                       HasTake, repeats});
  };
  add("Play or pause", {{GLFW_KEY_SPACE}}, [](Studio& s) { s.TogglePlaying(); });
  add(
      "One frame back", {{GLFW_KEY_LEFT}}, [](Studio& s) { s.Step(-1); }, true);
  add(
      "One frame on", {{GLFW_KEY_RIGHT}}, [](Studio& s) { s.Step(1); }, true);
  add(
      "Ten frames back", {{GLFW_KEY_LEFT, false, true}}, [](Studio& s) { s.Step(-10); }, true);
  add(
      "Ten frames on", {{GLFW_KEY_RIGHT, false, true}}, [](Studio& s) { s.Step(10); }, true);
  add("First frame", {{GLFW_KEY_HOME}}, [](Studio& s) { s.stage().Seek(0); });
  add("Last frame", {{GLFW_KEY_END}},
      [](Studio& s) { s.stage().Seek(s.current_take()->take.motion->poses.size() - 1); });
  add("Play in a loop", {{GLFW_KEY_L}}, [](Studio& s) { s.SetLoop(!s.loop()); });
}

void AddSeeing(std::vector<Action>& actions) {
  const auto add = [&](std::string_view name, std::vector<Chord> keys, Run run) {
    actions.push_back({name, "View", Action::Where::kPerform, std::move(keys), std::move(run)});
  };
  add("Frame what is selected", {{GLFW_KEY_F}}, [](Studio& s) { s.FrameSelected(); });
  add("Frame everyone", {{GLFW_KEY_A}}, [](Studio& s) { s.FrameEveryone(); });
  add("From the front", {{GLFW_KEY_1}}, [](Studio& s) { s.LookFrom(StandardView::kFront); });
  add("From the side", {{GLFW_KEY_3}}, [](Studio& s) { s.LookFrom(StandardView::kSide); });
  add("From above", {{GLFW_KEY_7}}, [](Studio& s) { s.LookFrom(StandardView::kTop); });
  add("Three-quarter view", {{GLFW_KEY_0}},
      [](Studio& s) { s.LookFrom(StandardView::kThreeQuarter); });
  add("Body surface of the performer", {{GLFW_KEY_B}}, Flips(&Overlays::surface));
  add("Captured skeleton", {{GLFW_KEY_K}}, Flips(&Overlays::skeleton));
  add("Markers", {{GLFW_KEY_M}}, Flips(&Overlays::markers));
  add("Crude surfaces over avatars", {{GLFW_KEY_C}}, Flips(&Overlays::crude));
  add("Spots where hands touch", {{GLFW_KEY_T}}, Flips(&Overlays::contacts));
  add("Names", {{GLFW_KEY_N}}, Flips(&Overlays::names));
  add("True sizes", {{GLFW_KEY_S}}, Flips(&Overlays::true_sizes));
}

}  // namespace

void AddPerformActions(std::vector<Action>& actions) {
  AddPlaying(actions);
  AddSeeing(actions);
  const auto add = [&](std::string_view name, std::vector<Chord> keys, Run run,
                       std::function<bool(const Studio&)> possible = {}) {
    actions.push_back({name, "Stage", Action::Where::kPerform, std::move(keys), std::move(run),
                       std::move(possible)});
  };
  add(
      "Bring back what was removed", {{GLFW_KEY_Z, true}}, [](Studio& s) { s.UndoRemove(); },
      [](const Studio& s) { return s.can_undo(); });
  add(
      "Calibrate the selected avatar", {{GLFW_KEY_E}},
      [](Studio& s) { s.Calibrate(s.selected_avatar()->id); },
      [](const Studio& s) { return s.selected_avatar() != nullptr; });
  add("Fold panels away", {{GLFW_KEY_TAB}}, [](Studio& s) { s.layout().ToggleAll(); });
  add("Drop the selection", {{GLFW_KEY_ESCAPE}}, [](Studio& s) {
    if (!std::exchange(s.show_keys, false)) s.selection().reset();
  });
}

}  // namespace ego
