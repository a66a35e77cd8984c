// SPDX-License-Identifier: MIT
#include "tests/support/script_laws.h"

#include <cmath>
#include <unordered_set>

#include "assets/motions/motion_figure.h"
#include "assets/motions/motion_player.h"
#include "assets/people/person_body.h"
#include "core/base/check.h"
#include "tests/support/sentence_law.h"

namespace ego::test {
namespace {

constexpr std::size_t kPlayedKeys = 5;  // more take too long to be done a million times

bool IsFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void CheckScript(const Result<MotionScript>& script, std::string_view file) {
  if (!script) return CheckSentence(script.error(), file);
  EGO_CHECK(script->keys.size() >= 2 && script->keys.front().time == 0.0);
  for (std::size_t i = 1; i < script->keys.size(); ++i) {
    EGO_CHECK(std::isfinite(script->keys[i].time));
    EGO_CHECK(script->keys[i].time >= script->keys[i - 1].time);
  }
  if (script->keys.size() > kPlayedKeys) return;

  static const Person performer = MakePerson(PersonParameters{});
  static const MotionFigure figure(performer);
  const MotionPlayer player(figure, *script);
  for (const double share : {0.0, 0.3, 0.7, 1.0}) {
    const Pose pose = player.At(share * script->Duration());
    EGO_CHECK(IsFinite(pose.root_ws));
    for (const Quat& q : pose.rotation_ls) EGO_CHECK(std::abs(glm::length(q) - 1.0) < 1e-6);
  }
}

void CheckPeople(const Result<std::vector<PersonParameters>>& people, std::string_view file) {
  if (!people) return CheckSentence(people.error(), file);
  EGO_CHECK(!people->empty());
  std::unordered_set<std::string> names;
  for (const PersonParameters& person : *people) {
    EGO_CHECK(static_cast<bool>(Validate(person)));
    EGO_CHECK(names.insert(person.name).second);
  }
}

}  // namespace ego::test
