// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/commands/command.h"
#include "app/commands/people_sheet.h"
#include "app/commands/terminal.h"
#include "assets/calibration/calibration_file.h"
#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"
#include "assets/people/person.h"
#include "assets/people/person_calibration.h"
#include "assets/people/person_file.h"
#include "render/png.h"

namespace ego {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path out;
  fs::path params;
  fs::path sheet;
  std::string show;
  std::vector<std::string> only;
  int cell_height = 320;
  bool print = false;
};

// "Big belly" -> "big-belly": letters and digits stay, whatever else is between them is one dash.
std::string FileStem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool plain = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
    if (plain) {
      stem += upper ? static_cast<char>(c + 32) : c;
    } else if (!stem.empty() && stem.back() != '-') {
      stem += '-';
    }
  }
  while (!stem.empty() && stem.back() == '-') stem.pop_back();
  return stem.empty() ? "person" : stem;
}

Result<std::vector<PersonParameters>> Chosen(const Arguments& arguments) {
  Result<std::vector<PersonParameters>> people =
      arguments.params.empty() ? Result<std::vector<PersonParameters>>(StudioCast())
                               : ReadPeople(arguments.params);
  if (!people || arguments.only.empty()) return people;
  std::vector<PersonParameters> chosen;
  for (const std::string& name : arguments.only) {
    const auto found = std::find_if(people->begin(), people->end(),
                                    [&](const auto& person) { return person.name == name; });
    if (found == people->end()) return Error{"--only " + name + ": nobody has this name"};
    chosen.push_back(*found);
  }
  return chosen;
}

std::size_t VertexCount(const Character& character) {
  std::size_t count = 0;
  for (const MeshPart& part : character.parts) count += part.positions.size();
  return count;
}

int WritePeople(const Arguments& arguments) {
  const Result<std::vector<PersonParameters>> chosen = Chosen(arguments);
  if (!chosen) return Fail(chosen.error());
  if (arguments.print) {
    std::printf("%s", FormatPeople(*chosen).c_str());
    return kDone;
  }
  if (arguments.out.empty() && arguments.sheet.empty()) {
    return Fail("nothing to do: give --out, --sheet or --print");
  }
  std::set<std::string> stems;
  for (const PersonParameters& person : *chosen) {
    if (!stems.insert(FileStem(person.name)).second) {
      return Fail("two people would be written as " + FileStem(person.name) + ".glb");
    }
  }

  std::vector<Person> people;
  {
    ProgressLine line("making people");
    for (const PersonParameters& parameters : *chosen) {
      line.Show(static_cast<double>(people.size()) / static_cast<double>(chosen->size()),
                parameters.name);
      people.push_back(MakePerson(parameters));
    }
  }
  if (!arguments.out.empty()) {
    std::error_code error;
    fs::create_directories(arguments.out, error);
    if (error) return Fail(arguments.out.string() + ": this folder cannot be made");
    for (const Person& person : people) {
      const fs::path path = arguments.out / (FileStem(person.body.name) + ".glb");
      Result<void> written = WriteCharacter(path, person.character);
      if (written) {
        written =
            WriteCalibration(CalibrationPathFor(path), person.character, CalibrationOf(person));
      }
      if (!written) return Fail(written.error());
      std::printf("%s: %.0f cm, %zu vertices\n", path.string().c_str(), 100.0 * person.body.height,
                  VertexCount(person.character));
    }
  }
  if (!arguments.sheet.empty()) {
    const Result<Image> sheet = DrawPeopleSheet(people, arguments.show, arguments.cell_height);
    if (!sheet) return Fail(sheet.error());
    const std::vector<std::uint8_t> png = EncodePng(*sheet);
    if (png.empty()) return Fail(arguments.sheet.string() + ": the picture is too large");
    const Result<void> written = WriteFileAtomically(arguments.sheet, png);
    if (!written) return Fail(written.error());
    std::printf("%s\n", arguments.sheet.string().c_str());
  }
  return kDone;
}

}  // namespace

Command AddPeopleCommand(CLI::App& program) {
  CLI::App* line = program.add_subcommand(
      "people", "Make the studio's cast, or people of your own, as characters with calibration");
  auto arguments = std::make_shared<Arguments>();
  line->add_option("--out", arguments->out,
                   "Folder for the characters (.glb, VRM 1.0 humanoid) and their calibrations");
  line->add_option("--params", arguments->params,
                   "Measurements of your own people, .json (default: the studio's cast)");
  line->add_option("--only", arguments->only, "Only the person of this name; may be repeated")
      ->allow_extra_args(false);
  line->add_option("--sheet", arguments->sheet, "Also draw everyone side by side, .png");
  line->add_option("--show", arguments->show, "What the sheet shows")
      ->check(CLI::IsMember(PeopleSheetNames()))
      ->default_val("turn");
  line->add_option("--cell", arguments->cell_height, "Height of one picture on the sheet, pixels")
      ->check(CLI::Range(64, 2048))
      ->capture_default_str();
  line->add_flag("--print", arguments->print,
                 "Print all measurements as .json, to be changed and given to --params");
  line->footer(
      "A file of measurements names what differs from a member of the cast (\"base\", default\n"
      "\"Performer\"); lengths in metres, colours as #RRGGBB. --print shows every name.\n\n"
      "  {\"people\": [{\"name\": \"Giant\", \"base\": \"Long arms\", \"height\": 2.1,\n"
      "               \"legLength\": 1.04, \"bellyThickness\": 0.3, \"shirtColor\": "
      "\"#46C77A\"}]}\n\n"
      "Examples:\n"
      "  egostudio people --out cast --sheet cast.png\n"
      "  egostudio people --params mine.json --out mine\n"
      "  egostudio people --only Child --print > child.json");
  return {line, [arguments] { return WritePeople(*arguments); }};
}

}  // namespace ego
