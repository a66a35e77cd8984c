// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assets/people/person.h"
#include "core/base/result.h"
#include "core/model/character.h"

namespace ego {

/// What a sheet of people can show: "turn" (standing, turned about), "tpose", "face", "hands",
/// "bends" (deeply bent limbs).
std::vector<std::string> PeopleSheetNames();

/// One column for each person, one row for each side that they are seen from. `cell_height` in
/// pixels. Fails where this machine cannot draw.
Result<Image> DrawPeopleSheet(const std::vector<Person>& people, std::string_view what,
                              int cell_height);

}  // namespace ego
