// SPDX-License-Identifier: MIT
#include "assets/motions/motions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "assets/motions/motion_script_file.h"
#include "assets/motions/shipped_motions.h"
#include "assets/motions/synthetic_markers.h"
#include "core/base/check.h"

namespace ego {
namespace {

constexpr double kRate = 60.0;

/// What the demo shows, in this order.
constexpr std::array<std::string_view, 12> kDemo = {
    "M1", "hands_clasped", "arms_crossed", "clap", "M6",    "hand_on_shoulder",
    "M8", "hands_on_hips", "haka",         "M4",   "lotus", "walk"};

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::replace(lower.begin(), lower.end(), '-', '_');
  std::replace(lower.begin(), lower.end(), ' ', '_');
  return lower;
}

}  // namespace

std::span<const MotionScript> ShippedMotions() {
  static const std::vector<MotionScript> kScripts = [] {
    std::vector<MotionScript> scripts;
    for (const ShippedMotionText& text : ShippedMotionTexts()) {
      Result<MotionScript> script = ParseMotionScript(text.json, text.file);
      if (script) scripts.push_back(*std::move(script));  // a test proves that each one parses
    }
    std::sort(scripts.begin(), scripts.end(), [](const MotionScript& a, const MotionScript& b) {
      if (a.study.empty() != b.study.empty()) return b.study.empty();
      return a.study != b.study ? a.study < b.study : a.name < b.name;
    });
    return scripts;
  }();
  return kScripts;
}

Result<const MotionScript*> FindMotion(std::string_view name) {
  const std::string wanted = Lower(name);
  std::string names;
  for (const MotionScript& script : ShippedMotions()) {
    if (wanted == script.name || (!script.study.empty() && wanted == Lower(script.study))) {
      return &script;
    }
    if (!names.empty()) names += ", ";
    if (!script.study.empty()) names += script.study + " ";
    names += script.name;
  }
  return Error{"There is no motion \"" + std::string(name) + "\"; there are " + names + "."};
}

const Person& ScriptedPerformer() {
  static const Person performer = MakePerson(DemoCast().front());
  return performer;
}

const MotionFigure& ScriptedFigure() {
  static const MotionFigure figure(ScriptedPerformer());
  return figure;
}

ScriptedTake Perform(const MotionFigure& figure, const MotionScript& script) {
  const MotionPlayer player(figure, script);
  ScriptedTake take;
  take.contacts = player.contacts();
  take.motion.name = script.study.empty() ? script.name : script.study + " " + script.name;
  take.motion.performer = figure.body();
  take.motion.rate_hz = kRate;
  const auto frames = static_cast<std::size_t>(std::lround(script.Duration() * kRate));
  for (std::size_t f = 0; f < frames; ++f) {
    take.motion.poses.push_back(player.At(static_cast<double>(f) / kRate));
  }
  return take;
}

ScriptedTake PerformWithMarkers(const MotionScript& script) {
  static const WornMarkers worn = WearMarkers(ScriptedPerformer(), StudioMarkerSet());
  ScriptedTake take = Perform(ScriptedFigure(), script);
  take.motion.markers = RecordMarkers(ScriptedPerformer(), worn, take.motion);
  return take;
}

Result<ScriptedTake> PerformShipped(std::string_view name) {
  const Result<const MotionScript*> script = FindMotion(name);
  if (!script) return Error{script.error()};
  return PerformWithMarkers(**script);
}

MotionScript DemoScript() {
  MotionScript demo;
  demo.name = "demo";
  demo.title = "Demo";
  for (const std::string_view name : kDemo) {
    const Result<const MotionScript*> script = FindMotion(name);
    if (!script) continue;  // a test proves that all are there
    const double begin = demo.keys.empty() ? 0.0 : demo.keys.back().time;
    for (const MotionKey& key : (*script)->keys) {
      if (key.time == 0.0 && !demo.keys.empty()) continue;
      demo.keys.push_back({begin + key.time, key.posture});
    }
  }
  return demo;
}

ScriptedTake PerformDemo() { return PerformWithMarkers(DemoScript()); }

}  // namespace ego
