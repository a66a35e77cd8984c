// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace ego {

struct Action;
class Studio;

/// The command palette: every command by name, found by typing any of its words.
class Palette {
 public:
  /// Opens it empty, or closes it.
  void Toggle();
  bool is_open() const { return open_; }
  /// Draws it, and runs what is chosen.
  void Show(Studio& studio);

 private:
  void Find(const Studio& studio);
  void Choose(Studio& studio, const Action& action);

  bool open_ = false;
  bool wants_focus_ = false;
  std::array<char, 96> text_{};
  std::vector<const Action*> found_;
  std::size_t chosen_ = 0;
};

/// Whether every word of `wanted` occurs in `text`, whatever the case.
bool HasWords(std::string_view text, std::string_view wanted);

}  // namespace ego
