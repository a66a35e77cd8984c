// SPDX-License-Identifier: MIT
#include "app/actions/action.h"

#include <GLFW/glfw3.h>

#include <algorithm>

#include "app/studio.h"

namespace ego {
namespace {

// The digits of the number pad mean what the others mean.
int Plain(int key) {
  return key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9 ? key - GLFW_KEY_KP_0 + GLFW_KEY_0
         : key == GLFW_KEY_KP_ENTER                   ? GLFW_KEY_ENTER
                                                      : key;
}

std::string NameOf(int key) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return "Space";
    case GLFW_KEY_LEFT:
      return "Left";
    case GLFW_KEY_RIGHT:
      return "Right";
    case GLFW_KEY_UP:
      return "Up";
    case GLFW_KEY_DOWN:
      return "Down";
    case GLFW_KEY_HOME:
      return "Home";
    case GLFW_KEY_END:
      return "End";
    case GLFW_KEY_TAB:
      return "Tab";
    case GLFW_KEY_ENTER:
      return "Enter";
    case GLFW_KEY_DELETE:
      return "Delete";
    case GLFW_KEY_BACKSPACE:
      return "Backspace";
    case GLFW_KEY_ESCAPE:
      return "Esc";
    case GLFW_KEY_SLASH:
      return "?";
    default:
      break;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    std::string name("F");
    name += std::to_string(key - GLFW_KEY_F1 + 1);
    return name;
  }
  return key > 0 && key < 128 ? std::string(1, static_cast<char>(key)) : std::string();
}

bool Matches(const Chord& chord, const KeyPress& press) {
  // "?" is made with or without Shift, by the layout of the keyboard.
  const bool shift = chord.key == GLFW_KEY_SLASH ? chord.shift : press.shift;
  return chord.key == Plain(press.key) && chord.control == press.control && chord.shift == shift &&
         !press.alt;
}

}  // namespace

std::span<const Action> Actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> actions;
    AddCommonActions(actions);
    AddPerformActions(actions);
    AddCalibrateActions(actions);
    return actions;
  }();
  return all;
}

bool CanRun(const Action& action, const Studio& studio) {
  const bool performs = studio.workspace() == Workspace::kPerform;
  if (action.where == Action::Where::kPerform && !performs) return false;
  if (action.where == Action::Where::kCalibrate && performs) return false;
  return !action.possible || action.possible(studio);
}

std::string KeysOf(const Action& action) {
  if (action.keys.empty()) return {};
  const Chord& chord = action.keys.front();
  std::string keys(chord.control ? "Ctrl+" : "");
  keys += chord.shift ? "Shift+" : "";
  keys += NameOf(chord.key);
  return keys;
}

bool RunPressed(const KeyPress& press, Studio& studio) {
  for (const Action& action : Actions()) {
    const bool meant = std::any_of(action.keys.begin(), action.keys.end(),
                                   [&](const Chord& chord) { return Matches(chord, press); });
    if (!meant || !CanRun(action, studio)) continue;
    if (!press.repeated || action.repeats) action.run(studio);
    return true;
  }
  return false;
}

}  // namespace ego
