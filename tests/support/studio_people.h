// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "assets/people/person.h"

namespace ego::test {

/// Different enough to break what holds for one body only: performer, child, alien, woman, big
/// belly and robot. Made once in a program.
const std::vector<Person>& SomePeople();

}  // namespace ego::test
