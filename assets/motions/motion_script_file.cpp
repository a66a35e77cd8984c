// SPDX-License-Identifier: MIT
#include "assets/motions/motion_script_file.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/files/file_io.h"
#include "assets/files/shown_text.h"

namespace ego {
namespace {

using Json = nlohmann::json;

// Bounds on a hostile file.
constexpr std::size_t kMaxKeys = 2000;
constexpr std::size_t kLongestText = 1000;
constexpr double kMaxSeconds = 600.0;
constexpr double kMaxNumber = 1000.0;

/// What is wrong, thrown to the two public functions of this file and no further.
struct Fault {
  std::string sentence;
};

[[noreturn]] void Stop(const std::string& where, const std::string& expectation) {
  throw Fault{where + " " + expectation};
}

void OnlyFields(const Json& object, std::initializer_list<std::string_view> known,
                const std::string& where) {
  if (!object.is_object()) Stop(where, "must be an object");
  for (const auto& item : object.items()) {
    bool found = false;
    for (const std::string_view name : known) found = found || item.key() == name;
    if (!found) Stop(where, "has an unknown field " + Quoted(item.key()));
  }
}

double NumberOf(const Json& value, const std::string& where) {
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (!(std::abs(number) <= kMaxNumber)) Stop(where, "must be a number between -1000 and 1000");
  return number;
}

void Read(const Json& object, const char* field, const std::string& where, double& out) {
  const auto found = object.find(field);
  if (found != object.end()) out = NumberOf(*found, where + " \"" + field + "\"");
}

void Read(const Json& object, const char* field, const std::string& where, bool& out) {
  const auto found = object.find(field);
  if (found == object.end()) return;
  if (!found->is_boolean()) Stop(where + " \"" + field + "\"", "must be true or false");
  out = found->get<bool>();
}

void Read(const Json& object, const char* field, const std::string& where, std::string& out) {
  const auto found = object.find(field);
  if (found == object.end()) return;
  if (!found->is_string()) Stop(where + " \"" + field + "\"", "must be a text in quotes");
  out = CleanText(found->get_ref<const std::string&>());
  if (out.size() > kLongestText) {
    Stop(where + " \"" + field + "\"",
         "must have at most " + std::to_string(kLongestText) + " letters");
  }
}

bool Read(const Json& object, const char* field, const std::string& where, Vec3& out) {
  const auto found = object.find(field);
  if (found == object.end()) return false;
  const std::string what = where + " \"" + field + "\"";
  if (!found->is_array() || found->size() != 3) Stop(what, "must be three numbers");
  for (int i = 0; i < 3; ++i) out[i] = NumberOf((*found)[static_cast<std::size_t>(i)], what);
  return true;
}

void ReadDirection(const Json& object, const char* field, const std::string& where, Vec3& out) {
  if (Read(object, field, where, out) && glm::length(out) < 1e-6) {
    Stop(where + " \"" + field + "\"", "must be a direction, which three zeros are not");
  }
}

void ReadBend(const Json& object, const char* field, const std::string& where, Bend& out) {
  Vec3 angles;
  if (Read(object, field, where, angles)) out = {angles.x, angles.y, angles.z};
}

template <std::size_t N>
std::size_t OneOf(const std::array<std::string_view, N>& names, const std::string& name,
                  const std::string& where) {
  std::string all;
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == name) return i;
    all += (i == 0 ? "" : i + 1 == N ? " or " : ", ") + std::string(names[i]);
  }
  Stop(where, "must be " + all);
}

constexpr std::array<std::string_view, 8> kParts = {"trunk", "head",  "upper arm", "forearm",
                                                    "hand",  "thigh", "calf",      "foot"};
constexpr std::array<std::string_view, 7> kFaces = {"palm", "fingertips", "back",      "thumb side",
                                                    "sole", "instep",     "outer edge"};

void ReadPlace(const Json& object, const std::string& where, BodyPlace& place) {
  std::string part;
  Read(object, "on", where, part);
  if (const std::optional<SamplePoint> sample = SamplePointNamed(part)) {
    place.part = BodyPart::kSample;
    place.sample = *sample;
    return;
  }
  constexpr std::string_view kOther = "other ";
  place.other = part.starts_with(kOther);
  if (place.other) part.erase(0, kOther.size());
  place.part = static_cast<BodyPart>(OneOf(kParts, part, where + " \"on\""));
  Read(object, "along", where, place.along);
  if (place.along < -0.1 || place.along > 1.0) {
    Stop(where + " \"along\"", "must be between -0.1 and 1");
  }
  ReadDirection(object, "toward", where, place.toward);
}

EndGoal ReadHand(const Json& object, const std::string& where) {
  EndGoal goal = StandingGoals().hand[0];
  if (object.contains("on")) {
    OnlyFields(object,
               {"on", "along", "toward", "with", "fingers", "elbow", "lift", "tilt", "lean",
                "slide", "arc", "shape"},
               where);
    goal.touches = true;
    ReadPlace(object, where, goal.place);
    std::string face = "palm";
    Read(object, "with", where, face);
    goal.face = static_cast<TouchFace>(OneOf(kFaces, face, where + " \"with\""));
    if (goal.face >= TouchFace::kSole) Stop(where + " \"with\"", "must be a side of a hand");
    Read(object, "lift", where, goal.lift);
    Read(object, "tilt", where, goal.tilt);
    Read(object, "lean", where, goal.lean);
    goal.form = goal.face == TouchFace::kPalm ? HandForm::kLaid : HandForm::kFlat;
    Read(object, "slide", where, goal.slide);
  } else {
    OnlyFields(object, {"at", "stage", "plate", "palm", "fingers", "elbow", "arc", "shape"}, where);
    Read(object, "at", where, goal.at);
    goal.on_plate = Read(object, "plate", where, goal.at);
    goal.on_stage = Read(object, "stage", where, goal.at) || goal.on_plate;
    if (goal.on_plate) goal.palm = -kUp;
    if (goal.on_stage) goal.form = HandForm::kFlat;
    ReadDirection(object, "palm", where, goal.palm);
  }
  ReadDirection(object, "fingers", where, goal.pointing);
  ReadDirection(object, "elbow", where, goal.pole);
  Read(object, "arc", where, goal.arc);
  std::string form;
  Read(object, "shape", where, form);
  if (!form.empty()) {
    goal.form = static_cast<HandForm>(OneOf(kHandForms, form, where + " \"shape\""));
  }
  return goal;
}

EndGoal ReadFoot(const Json& object, const std::string& where) {
  EndGoal goal = StandingGoals().foot[0];
  if (object.contains("on")) {
    OnlyFields(object, {"on", "along", "toward", "with", "toes", "knee", "lift", "tilt", "slide"},
               where);
    goal.touches = true;
    ReadPlace(object, where, goal.place);
    std::string face = "sole";
    Read(object, "with", where, face);
    goal.face = static_cast<TouchFace>(OneOf(kFaces, face, where + " \"with\""));
    if (goal.face < TouchFace::kSole) Stop(where + " \"with\"", "must be a side of a foot");
    ReadDirection(object, "toes", where, goal.pointing);
    Read(object, "lift", where, goal.lift);
    Read(object, "tilt", where, goal.tilt);
    Read(object, "slide", where, goal.slide);
  } else {
    OnlyFields(object, {"at", "turn", "heel", "roll", "knee"}, where);
    Read(object, "at", where, goal.at);
    Read(object, "turn", where, goal.turn);
    Read(object, "heel", where, goal.heel);
    Read(object, "roll", where, goal.roll);
  }
  Read(object, "knee", where, goal.pole);
  return goal;
}

using Named = std::map<std::string, BodyGoals>;

BodyGoals ReadPosture(const Json& object, const Named& named, BodyGoals posture,
                      const std::string& where) {
  OnlyFields(object,
             {"after", "go", "mirror", "root", "seat", "hips", "spine", "head", "leftShoulder",
              "rightShoulder", "shoulders", "leftHand", "rightHand", "hands", "leftFoot",
              "rightFoot", "feet", "off"},
             where);
  std::string name;
  Read(object, "go", where, name);
  if (!name.empty()) {
    const auto found = named.find(name);
    if (found == named.end())
      Stop(where, "goes to " + Quoted(name) + ", a posture not given before");
    posture = found->second;
  }
  if (Read(object, "root", where, posture.root)) posture.seat.reset();
  if (object.contains("seat")) posture.seat = NumberOf(object["seat"], where + " \"seat\"");
  ReadBend(object, "hips", where, posture.hips);
  ReadBend(object, "spine", where, posture.spine);
  ReadBend(object, "head", where, posture.head);
  const auto sides = [&](const char* both, const char* left, const char* right, auto read) {
    const char* fields[] = {both, both, left, right};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto found = object.find(fields[i]);
      if (found != object.end()) read(*found, i % 2, where + " \"" + fields[i] + "\"");
    }
  };
  sides("shoulders", "leftShoulder", "rightShoulder",
        [&](const Json& value, std::size_t side, const std::string& which) {
          if (!value.is_array() || value.size() != 2) {
            Stop(which, "must be two numbers: degrees up and forward");
          }
          posture.shoulder[side] = {NumberOf(value[1], which), 0.0, NumberOf(value[0], which)};
        });
  sides("hands", "leftHand", "rightHand",
        [&](const Json& value, std::size_t side, const std::string& which) {
          posture.hand[side] = ReadHand(value, which);
        });
  sides("feet", "leftFoot", "rightFoot",
        [&](const Json& value, std::size_t side, const std::string& which) {
          posture.foot[side] = ReadFoot(value, which);
        });
  if (object.contains("off")) {
    for (EndGoal& hand : posture.hand) {
      if (hand.touches) hand.lift = NumberOf(object["off"], where + " \"off\"");
    }
  }
  bool mirror = false;
  Read(object, "mirror", where, mirror);
  return mirror ? Mirrored(posture) : posture;
}

void ReadKeys(const Json& list, Named& named, const std::string& where, bool may_repeat,
              std::vector<MotionKey>& keys);

/// Keys that are said several times: a number of times, or once for each of some postures, which
/// they then call "it".
void ReadLoop(const Json& loop, Named& named, const std::string& where, bool may_repeat,
              std::vector<MotionKey>& keys) {
  const bool repeats = loop.contains("repeat");
  const char* kind = repeats ? "repeat" : "for";
  OnlyFields(loop, {kind, "keys"}, where);
  if (!may_repeat) Stop(where + " \"" + kind + "\"", "must not stand within another one");
  if (!loop.contains("keys")) Stop(where, "needs the \"keys\" that it repeats");
  if (repeats) {
    const double times = NumberOf(loop["repeat"], where + " \"repeat\"");
    if (times < 1.0 || times > 100.0 || times != std::floor(times)) {
      Stop(where + " \"repeat\"", "must be a whole number from 1 to 100");
    }
    for (int n = 0; n < static_cast<int>(times); ++n) {
      ReadKeys(loop["keys"], named, where, false, keys);
    }
    return;
  }
  if (!loop["for"].is_array() || loop["for"].size() > 100) {
    Stop(where + " \"for\"", "must be a list of at most 100 postures' names");
  }
  for (const Json& name : loop["for"]) {
    const auto found = name.is_string() ? named.find(name.get<std::string>()) : named.end();
    if (found == named.end()) Stop(where + " \"for\"", "names a posture not given before");
    named["it"] = found->second;
    ReadKeys(loop["keys"], named, where, false, keys);
  }
  named.erase("it");
}

void ReadKeys(const Json& list, Named& named, const std::string& where, bool may_repeat,
              std::vector<MotionKey>& keys) {
  if (!list.is_array() || list.empty()) Stop(where + ": \"keys\"", "must be a list of keys");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& item = list[i];
    const std::string which = where + ": key " + std::to_string(i + 1);
    if (item.is_object() && (item.contains("repeat") || item.contains("for"))) {
      ReadLoop(item, named, which, may_repeat, keys);
      continue;
    }
    if (keys.size() >= kMaxKeys) Stop(where, "has more than 2000 keys");
    const BodyGoals before = keys.empty() ? StandingGoals() : keys.back().posture;
    MotionKey key;
    key.posture = ReadPosture(item, named, before, which);
    double after = keys.empty() ? 0.0 : NAN;
    Read(item, "after", which, after);
    if (keys.empty() ? after != 0.0 : !(after >= 0.01)) {
      Stop(which, keys.empty() ? "is the first and begins at 0, without \"after\""
                               : "needs \"after\", at least 0.01 seconds since the key before");
    }
    key.time = keys.empty() ? 0.0 : keys.back().time + after;
    if (key.time > kMaxSeconds) Stop(which, "lies more than ten minutes after the beginning");
    keys.push_back(std::move(key));
  }
}

MotionScript ReadScript(const Json& root, const std::string& file) {
  OnlyFields(root, {"name", "study", "title", "about", "lead", "breath", "postures", "keys"},
             file + ":");
  MotionScript script;
  Read(root, "name", file + ":", script.name);
  if (script.name.empty()) Stop(file + ":", "needs a \"name\", one word");
  script.title = script.name;
  Read(root, "title", file + ":", script.title);
  Read(root, "study", file + ":", script.study);
  Read(root, "lead", file + ":", script.lead);
  Read(root, "breath", file + ":", script.breath);
  if (script.lead < 0.0 || script.lead > 3.0 || script.breath < 0.0 || script.breath > 5.0) {
    Stop(file + ":", "needs \"lead\" from 0 to 3 and \"breath\" from 0 to 5");
  }
  Named named = {{"stand", StandingGoals()}};
  if (const auto postures = root.find("postures"); postures != root.end()) {
    if (!postures->is_array() || postures->size() > kMaxKeys) {
      Stop(file + ": \"postures\"", "must be a list of postures");
    }
    for (const Json& item : *postures) {
      std::string name;
      if (item.is_object()) Read(item, "name", file + ": a posture's", name);
      if (name.empty()) Stop(file + ": \"postures\"", "must each have a \"name\"");
      Json fields = item;
      fields.erase("name");
      named[name] = ReadPosture(fields, named, StandingGoals(), file + ": posture " + Quoted(name));
    }
  }
  if (!root.contains("keys")) Stop(file + ":", "needs \"keys\"");
  ReadKeys(root["keys"], named, file, true, script.keys);
  if (script.keys.size() < 2) Stop(file + ":", "needs at least two keys");
  if (script.keys.back().time < 0.1) Stop(file + ":", "must last at least 0.1 seconds");
  return script;
}

}  // namespace

Result<MotionScript> ParseMotionScript(std::string_view json, std::string_view file) {
  const Json root = Json::parse(json, nullptr, false, true);
  if (root.is_discarded()) return Error{std::string(file) + ": not valid JSON"};
  try {
    return ReadScript(root, std::string(file));
  } catch (const Fault& fault) {
    return Error{fault.sentence};
  } catch (const Json::exception& error) {
    return Error{std::string(file) + ": cannot be read as a motion script: " + error.what()};
  }
}

Result<MotionScript> ReadMotionScript(const std::filesystem::path& path) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParseMotionScript(*text, path.filename().string());
}

}  // namespace ego
