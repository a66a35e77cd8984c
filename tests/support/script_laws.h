// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "assets/motions/motion_script.h"
#include "assets/people/person.h"
#include "core/base/result.h"

namespace ego::test {

/// What holds for every motion script that the reader returns, whatever the text said; and that a
/// short one can be done by the performer, who stays in one piece. Ends the program where it does
/// not hold.
void CheckScript(const Result<MotionScript>& script, std::string_view file);

/// What holds for all people that the reader returns: they can be made, and no two share a name.
void CheckPeople(const Result<std::vector<PersonParameters>>& people, std::string_view file);

}  // namespace ego::test
