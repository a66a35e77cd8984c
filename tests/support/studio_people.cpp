// SPDX-License-Identifier: MIT
#include "tests/support/studio_people.h"

namespace ego::test {

const std::vector<Person>& SomePeople() {
  static const std::vector<Person> people = [] {
    std::vector<Person> made;
    for (const PersonParameters& p : DemoCast()) {
      if (p.name != "Long arms") made.push_back(MakePerson(p));
    }
    return made;
  }();
  return people;
}

}  // namespace ego::test
