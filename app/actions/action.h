// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/window/window.h"

namespace ego {

class Studio;

/// Keys that are pressed together.
struct Chord {
  int key = 0;  // GLFW_KEY_...
  bool control = false;
  bool shift = false;
};

/// One thing that the studio can be told to do: by its keys, or by its name from the palette. The
/// list of keys is made of these as well.
struct Action {
  enum class Where { kEverywhere, kPerform, kCalibrate };

  std::string_view name;   // sentence case, a verb first where there is one
  std::string_view group;  // heading in the list of keys
  Where where = Where::kEverywhere;
  std::vector<Chord> keys;  // any of them; the first is shown
  std::function<void(Studio&)> run;
  std::function<bool(const Studio&)> possible = {};  // empty: always
  bool repeats = false;                              // while its key is held
};

/// All of them, in the order in which they are listed.
std::span<const Action> Actions();

/// What makes up the list, one function for each workspace.
void AddCommonActions(std::vector<Action>& actions);
void AddPerformActions(std::vector<Action>& actions);
void AddCalibrateActions(std::vector<Action>& actions);

/// Whether it can be done now: in this workspace, and possible.
bool CanRun(const Action& action, const Studio& studio);
/// "Ctrl+Shift+Z"; empty for an action without keys.
std::string KeysOf(const Action& action);
/// Does what the pressed keys mean here. False when they mean nothing.
bool RunPressed(const KeyPress& press, Studio& studio);

}  // namespace ego
