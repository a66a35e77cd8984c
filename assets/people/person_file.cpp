// SPDX-License-Identifier: MIT
#include "assets/people/person_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "assets/files/file_io.h"
#include "assets/files/shown_text.h"
#include "assets/people/person_measure.h"

namespace ego {
namespace {

using Json = nlohmann::json;

/// More than any stage holds; bounds the work on a hostile file.
constexpr std::size_t kMostPeople = 100;
constexpr std::size_t kLongestName = 100;

std::optional<glm::vec3> ColorFrom(const Json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    int byte = 0;
    for (const char digit : text.substr(static_cast<std::size_t>(1 + 2 * c), 2)) {
      const std::string_view digits = "0123456789abcdef";
      const char lower = digit >= 'A' && digit <= 'F' ? static_cast<char>(digit + 32) : digit;
      const std::size_t place = digits.find(lower);
      if (place == std::string_view::npos) return std::nullopt;
      byte = 16 * byte + static_cast<int>(place);
    }
    color[c] = static_cast<float>(byte) / 255.0f;
  }
  return color;
}

std::string Hex(const glm::vec3& color) {
  char text[8];
  const auto byte = [](float c) { return static_cast<unsigned>(std::lround(255.0f * c)) & 0xffu; };
  std::snprintf(text, sizeof text, "#%02X%02X%02X", byte(color.r), byte(color.g), byte(color.b));
  return text;
}

/// The member of the cast that a person starts from.
Result<PersonParameters> BaseOf(const Json& object, const std::string& where) {
  const auto base = object.find("base");
  if (base == object.end()) return PersonParameters{};
  std::string known;
  for (PersonParameters& member : StudioCast()) {
    if (base->is_string() && base->get_ref<const std::string&>() == member.name) {
      return std::move(member);
    }
    known += (known.empty() ? "\"" : ", \"") + member.name + "\"";
  }
  return Error{where + ": \"base\" must be one of " + known};
}

Result<void> Set(PersonParameters& person, const std::string& key, const Json& value,
                 const std::string& where) {
  const std::string quoted = where + ": " + Quoted(key) + " must be ";
  for (const PersonMeasure& measure : PersonMeasures()) {
    if (key != measure.key) continue;
    if (!value.is_number()) return Error{quoted + "a number"};
    person.*measure.value = value.get<double>();
    return {};
  }
  for (const PersonColor& color : PersonColors()) {
    if (key != color.key) continue;
    const std::optional<glm::vec3> read = ColorFrom(value);
    if (!read) return Error{quoted + "a colour such as \"#C98F6B\""};
    person.*color.value = *read;
    return {};
  }
  if (key == "hair") {
    const auto name = std::find_if(kHairNames.begin(), kHairNames.end(),
                                   [&](std::string_view n) { return value == std::string(n); });
    if (name == kHairNames.end()) return Error{quoted + "none, short, crop, bob, bun or curls"};
    person.hair = static_cast<Hair>(name - kHairNames.begin());
    return {};
  }
  if (key == "style") {
    if (value != "soft" && value != "robot") return Error{quoted + "soft or robot"};
    person.style = value == "robot" ? PersonStyle::kRobot : PersonStyle::kSoft;
    return {};
  }
  return Error{where + ": there is no measurement " + Quoted(key)};
}

Result<PersonParameters> PersonFrom(const Json& object, std::string where) {
  if (!object.is_object()) return Error{where + " must be an object"};
  const auto name = object.find("name");
  if (name == object.end() || !name->is_string() || name->get_ref<const std::string&>().empty()) {
    return Error{where + " needs a \"name\" string"};
  }
  where += " " + Quoted(name->get_ref<const std::string&>());
  Result<PersonParameters> person = BaseOf(object, where);
  if (!person) return person;
  person->name = CleanText(name->get_ref<const std::string&>());
  if (person->name.empty() || person->name.size() > kLongestName) {
    return Error{where + ": \"name\" must have 1 to " + std::to_string(kLongestName) + " letters"};
  }
  for (const auto& [key, value] : object.items()) {
    if (key == "name" || key == "base") continue;
    if (const Result<void> set = Set(*person, key, value, where); !set) return Error{set.error()};
  }
  if (const Result<void> valid = Validate(*person); !valid) {
    return Error{where + ": " + valid.error()};
  }
  return person;
}

}  // namespace

Result<std::vector<PersonParameters>> ParsePeople(std::string_view json, std::string_view name) {
  const std::string file(name);
  const Json root = Json::parse(json, nullptr, false);
  if (root.is_discarded()) return Error{file + ": not valid JSON"};
  const auto list = root.is_object() ? root.find("people") : root.end();
  if (!root.is_object() || list == root.end() || !list->is_array() || list->empty() ||
      list->size() > kMostPeople) {
    return Error{file + ": must be an object whose \"people\" is a list of 1 to " +
                 std::to_string(kMostPeople) + " people"};
  }
  std::vector<PersonParameters> people;
  for (std::size_t i = 0; i < list->size(); ++i) {
    Result<PersonParameters> person =
        PersonFrom((*list)[i], file + ": person " + std::to_string(i + 1));
    if (!person) return Error{person.error()};
    const bool taken = std::any_of(people.begin(), people.end(),
                                   [&](const auto& other) { return other.name == person->name; });
    if (taken) return Error{file + ": two people have the name " + Quoted(person->name)};
    people.push_back(*std::move(person));
  }
  return people;
}

Result<std::vector<PersonParameters>> ReadPeople(const std::filesystem::path& path) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParsePeople(*text, path.filename().string());
}

std::string FormatPeople(const std::vector<PersonParameters>& people) {
  nlohmann::ordered_json root;
  root["people"] = nlohmann::ordered_json::array();
  for (const PersonParameters& person : people) {
    nlohmann::ordered_json entry;
    entry["name"] = person.name;
    entry["style"] = person.style == PersonStyle::kRobot ? "robot" : "soft";
    for (const PersonMeasure& measure : PersonMeasures()) {
      entry[std::string(measure.key)] = person.*measure.value;
    }
    entry["hair"] = std::string(kHairNames[static_cast<std::size_t>(person.hair)]);
    for (const PersonColor& color : PersonColors()) {
      entry[std::string(color.key)] = Hex(person.*color.value);
    }
    root["people"].push_back(std::move(entry));
  }
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ego
