// SPDX-License-Identifier: MIT
#include <GLFW/glfw3.h>

#include <utility>

#include "app/actions/action.h"
#include "app/studio.h"

namespace ego {
namespace {

using Run = std::function<void(Studio&)>;
using Possible = std::function<bool(const Studio&)>;

// A session that is not waiting for an answer.
bool Works(const Studio& studio) {
  const CalibrateWorkspace& work = studio.calibrate();
  return work.session() && !work.session()->offer() && !work.show_guide && !work.ask_path;
}

bool HasPoint(const Studio& studio) {
  return Works(studio) && studio.calibrate().session()->current() &&
         studio.calibrate().list == CalibrateWorkspace::List::kPoints;
}

Run Flips(bool CalibrateLook::*look) {
  return [look](Studio& s) {
    bool& on = s.calibrate().habits.look.*look;
    on = !on;
  };
}

class Adder {
 public:
  Adder(std::vector<Action>& actions, std::string_view group, Possible possible)
      : actions_(actions), group_(group), possible_(std::move(possible)) {}
  void operator()(std::string_view name, std::vector<Chord> keys, Run run, bool repeats = false) {
    actions_.push_back({name, group_, Action::Where::kCalibrate, std::move(keys), std::move(run),
                        possible_, repeats});
  }

 private:
  std::vector<Action>& actions_;
  std::string_view group_;
  Possible possible_;
};

void AddPoints(std::vector<Action>& actions) {
  Adder add(actions, "Points", HasPoint);
  add("Confirm, and go to the next doubtful", {{GLFW_KEY_ENTER}},
      [](Studio& s) { s.calibrate().Confirm(s); });
  add(
      "Move along the mesh: left", {{GLFW_KEY_LEFT}},
      [](Studio& s) { s.calibrate().Step(s, -1, 0); }, true);
  add(
      "Move along the mesh: right", {{GLFW_KEY_RIGHT}},
      [](Studio& s) { s.calibrate().Step(s, 1, 0); }, true);
  add(
      "Move along the mesh: up", {{GLFW_KEY_UP}}, [](Studio& s) { s.calibrate().Step(s, 0, 1); },
      true);
  add(
      "Move along the mesh: down", {{GLFW_KEY_DOWN}},
      [](Studio& s) { s.calibrate().Step(s, 0, -1); }, true);
  add("Mirror over to the other side", {{GLFW_KEY_M, true}},
      [](Studio& s) { s.calibrate().MirrorOver(s); });
  add("Back to the proposal", {{GLFW_KEY_BACKSPACE}}, [](Studio& s) { s.calibrate().Reset(s); });
  add("Delete the point", {{GLFW_KEY_DELETE}}, [](Studio& s) { s.calibrate().Delete(s); });
  Adder any(actions, "Points", Works);
  any("Next doubtful point", {{GLFW_KEY_TAB}},
      [](Studio& s) { s.calibrate().GoToDoubtful(s, true); });
  any("Previous doubtful point", {{GLFW_KEY_TAB, false, true}},
      [](Studio& s) { s.calibrate().GoToDoubtful(s, false); });
  any("Confirm all proposals", {{GLFW_KEY_ENTER, true}},
      [](Studio& s) { s.calibrate().ConfirmAll(s); });
  any("Symmetric picking", {{GLFW_KEY_M}},
      [](Studio& s) { s.calibrate().SetSymmetric(!s.calibrate().habits.symmetric); });
  any("Back to all proposals", {}, [](Studio& s) {
    s.calibrate().session()->editor().ResetAllToProposal();
    s.Say(Message::Kind::kInfo, "Back to all proposals. Ctrl+Z brings the picks back.");
  });
}

void AddEditing(std::vector<Action>& actions) {
  Adder add(actions, "Edit", Works);
  add(
      "Undo", {{GLFW_KEY_Z, true}}, [](Studio& s) { s.calibrate().Undo(s); }, true);
  add(
      "Redo", {{GLFW_KEY_Z, true, true}, {GLFW_KEY_Y, true}},
      [](Studio& s) { s.calibrate().Redo(s); }, true);
  add("Save", {{GLFW_KEY_S, true}}, [](Studio& s) { s.calibrate().Save(s); });
  add("Save as", {{GLFW_KEY_S, true, true}}, [](Studio& s) { s.calibrate().ask_path = true; });
}

void AddSeeing(std::vector<Action>& actions) {
  Adder add(actions, "View", Works);
  add("Frame the point", {{GLFW_KEY_F}}, [](Studio& s) { s.calibrate().FrameCurrent(s); });
  add("Frame the whole character", {{GLFW_KEY_A}}, [](Studio& s) { s.calibrate().FrameAll(s); });
  const auto look = [&](std::string_view name, int key, StandardView view) {
    add(name, {{key}}, [view](Studio& s) { s.calibrate().LookFrom(view, false); });
  };
  const auto other = [&](std::string_view name, int key, StandardView view) {
    add(name, {{key, false, true}}, [view](Studio& s) { s.calibrate().LookFrom(view, true); });
  };
  look("From the front", GLFW_KEY_1, StandardView::kFront);
  other("From behind", GLFW_KEY_1, StandardView::kFront);
  look("From the side", GLFW_KEY_3, StandardView::kSide);
  other("From the other side", GLFW_KEY_3, StandardView::kSide);
  look("From above", GLFW_KEY_7, StandardView::kTop);
  other("From below", GLFW_KEY_7, StandardView::kTop);
  add("Wireframe", {{GLFW_KEY_W}}, Flips(&CalibrateLook::edges));
  add("X-ray", {{GLFW_KEY_X}}, Flips(&CalibrateLook::xray));
  add("Crude surfaces", {{GLFW_KEY_C}}, Flips(&CalibrateLook::crude));
  add("Points around limbs", {{GLFW_KEY_G}}, Flips(&CalibrateLook::limbs));
  add("Loupe", {{GLFW_KEY_L}}, [](Studio& s) {
    bool& on = s.calibrate().habits.loupe;
    on = !on;
  });
  add("Camera follows the points", {{GLFW_KEY_F, false, true}}, [](Studio& s) {
    bool& on = s.calibrate().habits.follow;
    on = !on;
  });
  add("Rest pose before and after alignment", {{GLFW_KEY_T}},
      [](Studio& s) { s.calibrate().ToggleAligned(s); });
  add("List of points", {{GLFW_KEY_P}},
      [](Studio& s) { s.calibrate().list = CalibrateWorkspace::List::kPoints; });
  add("List of joints", {{GLFW_KEY_J}},
      [](Studio& s) { s.calibrate().list = CalibrateWorkspace::List::kJoints; });
  add("Show the guide", {}, [](Studio& s) { s.calibrate().show_guide = true; });
}

}  // namespace

void AddCalibrateActions(std::vector<Action>& actions) {
  // Cards that wait for an answer take Enter first.
  Adder offer(actions, "Edit", [](const Studio& s) {
    return s.calibrate().session() && s.calibrate().session()->offer();
  });
  offer("Take unsaved picks back", {{GLFW_KEY_ENTER}}, [](Studio& s) { s.calibrate().Recover(s); });
  Adder guide(actions, "View", [](const Studio& s) {
    return s.calibrate().session() && !s.calibrate().session()->offer() && s.calibrate().show_guide;
  });
  guide("Close the guide", {{GLFW_KEY_ENTER}}, [](Studio& s) { s.calibrate().Escape(s); });
  AddPoints(actions);
  AddEditing(actions);
  AddSeeing(actions);
  actions.push_back({"Close what is open",
                     "Studio",
                     Action::Where::kCalibrate,
                     {{GLFW_KEY_ESCAPE}},
                     [](Studio& s) { s.calibrate().Escape(s); }});
}

}  // namespace ego
