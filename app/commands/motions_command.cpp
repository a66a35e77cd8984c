// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/command.h"
#include "app/commands/motion_strip.h"
#include "app/commands/terminal.h"
#include "assets/files/file_io.h"
#include "assets/motions/motion_check.h"
#include "assets/motions/motion_script_file.h"
#include "assets/motions/motions.h"
#include "core/baselines/retarget_method.h"
#include "render/png.h"

namespace ego {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> names;
  fs::path report;
  fs::path table;
  bool list = false;
  bool source_only = false;
  double rate_hz = 20.0;
  fs::path strips;
  std::vector<std::string> people = {"Child", "Alien", "Big belly"};
  std::string method = "mdb";
  MotionStrips::Look look{8, 150, 25.0};
};

// A member of the cast who does what the performer does.
struct Follower {
  Person person;
  MotionFigure figure;
  SkinMeasure probe;
  explicit Follower(const PersonParameters& parameters)
      : person(MakePerson(parameters)), figure(person), probe(person.character) {}
};

// All contacts of one motion on one follower under one method.
struct FollowerGap {
  std::string follower;
  std::string method;
  std::vector<ContactGap> contacts;
  ContactGap all;
};

double Millimetres(double metres) { return std::round(metres * 1e5) / 100.0; }
double RoundedToMilliseconds(double seconds) { return std::round(seconds * 1e3) / 1e3; }

std::vector<FollowerGap> MeasureFollowers(const MotionScript& script,
                                          const std::vector<std::unique_ptr<Follower>>& cast,
                                          double rate_hz) {
  const MotionFigure& performer = ScriptedFigure();
  const MotionPlayer player(performer, script);
  std::vector<FollowerGap> gaps;
  for (const char* name : {"copy", "mdb"}) {
    const std::unique_ptr<RetargetMethod> method = MakeRetargetMethod(name);
    const std::size_t first = gaps.size();
    for (const auto& follower : cast) {
      gaps.push_back({follower->person.body.name, name, {}, {}});
      gaps.back().contacts.resize(player.contacts().size());
    }
    for (std::size_t c = 0; c < player.contacts().size(); ++c) {
      const TrueContact& contact = player.contacts()[c];
      if (contact.plate_ws) continue;  // stands where the performer's is
      const double length = contact.to_s - contact.from_s;
      const int steps = static_cast<int>(std::ceil(length * rate_hz));
      for (int i = 0; i <= steps; ++i) {
        const double time = contact.from_s + (steps == 0 ? 0.0 : length * i / steps);
        method->SetPerformerPose(performer.body(), player.At(time));
        for (std::size_t f = 0; f < cast.size(); ++f) {
          Follower& follower = *cast[f];
          Pose pose;
          method->Adapt(follower.person.body, pose);
          follower.probe.SetPose(pose);
          const ModelPose model = ForwardKinematics(follower.person.body.skeleton, pose);
          for (ContactGap* gap : {&gaps[first + f].contacts[c], &gaps[first + f].all}) {
            MeasureContact(follower.figure, contact, time, model, follower.probe, *gap);
          }
        }
      }
    }
  }
  return gaps;
}

Json GapFacts(const ContactGap& gap) {
  return {{"samples", gap.samples},
          {"mean_gap_mm", Millimetres(gap.mean_abs)},
          {"widest_mm", Millimetres(gap.widest)},
          {"deepest_mm", Millimetres(gap.deepest)},
          {"off_place_mm", Millimetres(gap.off_place)}};
}

void PrintSource(const MotionScript& script, const MotionPlayer& player, const MotionCheck& check) {
  std::printf("%s%s%s: %.2f s\n", script.study.c_str(), script.study.empty() ? "" : " ",
              script.name.c_str(), script.Duration());
  for (std::size_t c = 0; c < check.contacts.size(); ++c) {
    const TrueContact& contact = player.contacts()[c];
    std::printf("  %6.2f to %6.2f s  %s%s, off by at most %.2f mm\n", contact.from_s, contact.to_s,
                contact.Sentence().c_str(), contact.Slides() ? ", sliding" : "",
                1000.0 * std::max(check.contacts[c].widest, check.contacts[c].deepest));
  }
  if (check.sinking.depth > 0.0) {
    std::printf("  sinks into itself by at most %.1f mm: %s in %s at %.2f s\n",
                1000.0 * check.sinking.depth, std::string(Name(check.sinking.of)).c_str(),
                std::string(Name(check.sinking.in)).c_str(), check.sinking_at_s);
  } else {
    std::printf("  sinks into itself nowhere\n");
  }
  std::printf(
      "  fastest joint %.0f degrees/s at %.2f s, %.0f degrees/s2 at %.2f s, wrist bent by "
      "at most %.0f degrees at %.2f s\n",
      check.largest_speed, check.largest_speed_at_s, check.largest_acceleration,
      check.largest_acceleration_at_s, check.largest_wrist, check.largest_wrist_at_s);
}

Json SourceFacts(const MotionScript& script, const MotionPlayer& player, const MotionCheck& check) {
  Json contacts = Json::array();
  for (std::size_t c = 0; c < check.contacts.size(); ++c) {
    const TrueContact& contact = player.contacts()[c];
    contacts.push_back({{"what", contact.Sentence()},
                        {"from_s", RoundedToMilliseconds(contact.from_s)},
                        {"to_s", RoundedToMilliseconds(contact.to_s)},
                        {"slides", contact.Slides()},
                        {"gap", GapFacts(check.contacts[c])}});
  }
  return {{"name", script.name},
          {"study", script.study},
          {"title", script.title},
          {"duration_s", RoundedToMilliseconds(script.Duration())},
          {"contacts", contacts},
          {"deepest_interpenetration_mm", Millimetres(check.sinking.depth)},
          {"deepest_of", std::string(Name(check.sinking.of))},
          {"deepest_in", std::string(Name(check.sinking.in))},
          {"deepest_at_s", RoundedToMilliseconds(check.sinking_at_s)},
          {"largest_joint_speed_deg_per_s", std::round(check.largest_speed)},
          {"largest_joint_acceleration_deg_per_s2", std::round(check.largest_acceleration)},
          {"largest_wrist_bend_deg", std::round(check.largest_wrist)}};
}

// The touch that is farthest from the skin, of those that were compared.
std::string WorstTouch(const MotionPlayer& player, const FollowerGap& gap) {
  const auto distance = [](const ContactGap& g) { return std::max(g.widest, g.deepest); };
  const auto worst = std::max_element(
      gap.contacts.begin(), gap.contacts.end(),
      [&](const ContactGap& a, const ContactGap& b) { return distance(a) < distance(b); });
  const TrueContact& contact =
      player.contacts()[static_cast<std::size_t>(worst - gap.contacts.begin())];
  std::array<char, 32> at;
  std::snprintf(at.data(), at.size(), " at %.2f s", contact.from_s);
  return contact.Sentence() + at.data();
}

void PrintFollowers(const MotionPlayer& player, const std::vector<FollowerGap>& gaps) {
  const std::size_t half = gaps.size() / 2;
  for (std::size_t f = 0; f < half; ++f) {
    if (gaps[f].all.samples == 0) continue;
    for (const FollowerGap* gap : {&gaps[f], &gaps[f + half]}) {
      std::printf(
          "  %-10s %-4s  gap %5.1f mm  outside by up to %5.1f  inside by up to %5.1f  "
          "off place %5.1f  worst: %s\n",
          gap == &gaps[f] ? gap->follower.c_str() : "", gap->method.c_str(),
          1000.0 * gap->all.mean_abs, 1000.0 * gap->all.widest, 1000.0 * gap->all.deepest,
          1000.0 * gap->all.off_place, WorstTouch(player, *gap).c_str());
    }
  }
  const std::vector<TrueContact>& contacts = player.contacts();
  if (half > 0 && std::any_of(contacts.begin(), contacts.end(),
                              [](const TrueContact& c) { return c.plate_ws.has_value(); })) {
    std::printf("  plates stand where the performer's stand: touches on them are not compared\n");
  }
}

// One row of the Markdown table: the performer's own figures, then every follower's mean gap.
std::string TableRow(const MotionScript& script, const MotionCheck& check,
                     const std::vector<FollowerGap>& gaps) {
  const auto written = [](const char* format, auto... values) {
    std::array<char, 96> text;
    std::snprintf(text.data(), text.size(), format, values...);
    return std::string(text.data());
  };
  std::string row = "| " + (script.study.empty() ? script.name : script.study + " " + script.name);
  row += written(" | %zu | %.1f | %.0f |", check.contacts.size(), 1000.0 * check.sinking.depth,
                 check.largest_speed);
  const std::size_t half = gaps.size() / 2;
  for (std::size_t f = 0; f < half; ++f) {
    row += gaps[f].all.samples == 0 ? " |"
                                    : written(" %.0f → %.0f |", 1000.0 * gaps[f].all.mean_abs,
                                              1000.0 * gaps[f + half].all.mean_abs);
  }
  return row + "\n";
}

std::string TableHead(const std::vector<std::unique_ptr<Follower>>& cast) {
  std::string names = "| motion | touches | sinks in, mm | fastest, degrees/s |";
  std::string rule = "| --- | ---: | ---: | ---: |";
  for (const auto& follower : cast) {
    names += " " + follower->person.body.name + " |";
    rule += " ---: |";
  }
  return names + "\n" + rule + "\n";
}

Result<std::vector<MotionScript>> ScriptsOf(const Arguments& arguments) {
  const std::span<const MotionScript> shipped = ShippedMotions();
  if (arguments.names.empty()) return std::vector<MotionScript>(shipped.begin(), shipped.end());
  std::vector<MotionScript> scripts;
  for (const std::string& name : arguments.names) {
    if (name.ends_with(".json")) {
      Result<MotionScript> script = ReadMotionScript(name);
      if (!script) return Error{script.error()};
      scripts.push_back(*std::move(script));
      continue;
    }
    const Result<const MotionScript*> script = FindMotion(name);
    if (!script) return Error{script.error()};
    scripts.push_back(**script);
  }
  return scripts;
}

// Writes one picture per motion: the performer and those who follow.
int DrawStrips(const Arguments& arguments, const std::vector<MotionScript>& scripts) {
  std::vector<std::unique_ptr<Person>> followers;
  std::vector<const Person*> people = {&ScriptedPerformer()};
  for (const std::string& name : arguments.people) {
    const std::vector<PersonParameters> cast = StudioCast();
    const auto found =
        std::find_if(cast.begin(), cast.end(), [&](const auto& p) { return p.name == name; });
    if (found == cast.end()) return Fail("--with " + name + ": nobody in the cast has this name");
    followers.push_back(std::make_unique<Person>(MakePerson(*found)));
    people.push_back(followers.back().get());
  }
  std::error_code error;
  fs::create_directories(arguments.strips, error);
  if (error) return Fail(arguments.strips.string() + ": this folder cannot be made");
  Result<MotionStrips> strips = MotionStrips::Create(people, arguments.method);
  if (!strips) return Fail(strips.error());
  ProgressLine line("drawing");
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    const MotionScript& script = scripts[i];
    line.Show(static_cast<double>(i) / static_cast<double>(scripts.size()), script.name);
    const Result<Image> sheet = strips->Draw(script, arguments.look);
    if (!sheet) return Fail(sheet.error());
    const std::string stem = (script.study.empty() ? "" : script.study + "_") + script.name;
    const Result<void> written =
        WriteFileAtomically(arguments.strips / (stem + ".png"), EncodePng(*sheet));
    if (!written) return Fail(written.error());
  }
  return kDone;
}

int Motions(const Arguments& arguments) {
  const Result<std::vector<MotionScript>> scripts = ScriptsOf(arguments);
  if (!scripts) return Fail(scripts.error());
  if (arguments.list) {
    for (const MotionScript& script : *scripts) {
      std::printf("%-3s %-18s %5.1f s  %s\n", script.study.c_str(), script.name.c_str(),
                  script.Duration(), script.title.c_str());
    }
    return kDone;
  }
  if (!arguments.strips.empty()) return DrawStrips(arguments, *scripts);
  std::vector<std::unique_ptr<Follower>> cast;
  if (!arguments.source_only) {
    const std::vector<PersonParameters> everyone = DemoCast();
    for (std::size_t i = 1; i < everyone.size(); ++i) {
      cast.push_back(std::make_unique<Follower>(everyone[i]));
    }
  }
  Json report = Json::array();
  std::string table = TableHead(cast);
  ProgressLine line("measuring");
  for (std::size_t i = 0; i < scripts->size(); ++i) {
    const MotionScript& script = (*scripts)[i];
    line.Show(static_cast<double>(i) / static_cast<double>(scripts->size()), script.name);
    const MotionPlayer player(ScriptedFigure(), script);
    const MotionCheck check = CheckMotion(ScriptedFigure(), script, 1.0 / arguments.rate_hz);
    PrintSource(script, player, check);
    Json facts = SourceFacts(script, player, check);
    const std::vector<FollowerGap> gaps = MeasureFollowers(script, cast, 5.0);
    PrintFollowers(player, gaps);
    table += TableRow(script, check, gaps);
    std::fflush(stdout);
    facts["cast"] = Json::array();
    for (const FollowerGap& gap : gaps) {
      Json contacts = Json::array();
      for (const ContactGap& contact : gap.contacts) contacts.push_back(GapFacts(contact));
      facts["cast"].push_back({{"name", gap.follower},
                               {"method", gap.method},
                               {"all", GapFacts(gap.all)},
                               {"contacts", contacts}});
    }
    report.push_back(std::move(facts));
  }
  if (!arguments.report.empty()) {
    const Json root = {{"performer", ScriptedPerformer().body.name}, {"motions", report}};
    const Result<void> written = WriteFileAtomically(arguments.report, root.dump(2) + "\n");
    if (!written) return Fail(written.error());
  }
  if (!arguments.table.empty()) {
    const Result<void> written = WriteFileAtomically(arguments.table, table);
    if (!written) return Fail(written.error());
  }
  return kDone;
}

}  // namespace

Command AddMotionsCommand(CLI::App& program) {
  CLI::App* line = program.add_subcommand(
      "motions", "Measure the studio's own motions: true contacts, interpenetration, contact gaps");
  auto arguments = std::make_shared<Arguments>();
  line->add_option("--motion", arguments->names,
                   "Only this one: a name, a number of the study (M7) or a script file .json; may "
                   "be repeated")
      ->allow_extra_args(false);
  line->add_flag("--list", arguments->list, "Only list names, lengths and titles");
  line->add_flag("--source-only", arguments->source_only,
                 "Measure the performer alone, not the cast that follows");
  line->add_option("--rate", arguments->rate_hz,
                   "How many times per second interpenetration is looked for")
      ->check(CLI::Range(1.0, 240.0))
      ->capture_default_str();
  line->add_option("--report", arguments->report, "Also write all figures, .json");
  line->add_option("--table", arguments->table,
                   "Also write a Markdown table: one row a motion, mean gaps in mm under copy and, "
                   "after the arrow, under mdb")
      ->type_name("FILE");
  line->add_option("--strips", arguments->strips,
                   "Instead draw each motion into this folder, .png: a row for the performer and "
                   "one for each follower");
  line->add_option("--with", arguments->people,
                   "With --strips: a member of the cast who follows; may be repeated")
      ->allow_extra_args(false);
  line->add_option("--method", arguments->method, "With --strips: how they follow")
      ->check(CLI::IsMember({"mdb", "paper", "copy"}))
      ->capture_default_str();
  line->add_option("--columns", arguments->look.columns, "With --strips: so many instants")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  line->add_option("--cell", arguments->look.cell_height, "With --strips: height of a row, pixels")
      ->check(CLI::Range(32, 800))
      ->capture_default_str();
  line->add_option("--yaw", arguments->look.yaw,
                   "With --strips: degrees by which the camera stands to the performer's left")
      ->check(CLI::Range(-180.0, 180.0))
      ->capture_default_str();
  line->footer(
      "For each motion: which hand or foot touches what, and when; how deep the performer's skin "
      "sinks into itself (skinned mesh; limbs against the body without that limb; the folds at "
      "shoulders, hips, elbows and knees do not count); for each character of the cast how far the "
      "same contacts are from the skin (gap: mean distance, inside or outside) and from the place "
      "that is meant, with plain joint angles (copy) and with contacts kept (mdb).\n\n"
      "Examples:\n"
      "  egostudio motions --list\n"
      "  egostudio motions --motion M7 --report m7.json\n"
      "  egostudio motions --strips pictures --columns 10\n"
      "  egostudio motions --motion my_motion.json --source-only");
  return {line, [arguments] { return Motions(*arguments); }};
}

}  // namespace ego
