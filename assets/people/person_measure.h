// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "assets/people/person.h"

namespace ego {

/// One number of the page of measurements: its name in files and what it may be.
struct PersonMeasure {
  std::string_view key;
  double PersonParameters::*value;
  double low;
  double high;
  bool of_height;  // the range is in shares of the height (lengths), else plain
};
std::span<const PersonMeasure> PersonMeasures();

/// One colour of the page.
struct PersonColor {
  std::string_view key;
  glm::vec3 PersonParameters::*value;
};
std::span<const PersonColor> PersonColors();

/// Names of hair styles in files, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> kHairNames = {"none", "short", "crop",
                                                               "bob",  "bun",   "curls"};

}  // namespace ego
