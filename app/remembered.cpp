// SPDX-License-Identifier: MIT
#include "app/remembered.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "assets/files/file_io.h"

namespace ego {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Every switch by the name that it has in the file.
template <class View, class Visit>
void ForEachSwitch(View& view, Visit visit) {
  visit("showLeft", view.layout.show_left);
  visit("showRight", view.layout.show_right);
  visit("showTimeline", view.layout.show_timeline);
  visit("surface", view.overlays.surface);
  visit("markers", view.overlays.markers);
  visit("skeleton", view.overlays.skeleton);
  visit("crude", view.overlays.crude);
  visit("contacts", view.overlays.contacts);
  visit("names", view.overlays.names);
  visit("trueSizes", view.overlays.true_sizes);
  visit("symmetricPicking", view.calibrate.symmetric);
  visit("loupe", view.calibrate.loupe);
  visit("cameraFollows", view.calibrate.follow);
  visit("guideSeen", view.calibrate.guide_seen);
  visit("calibrateCrude", view.calibrate.look.crude);
  visit("calibrateLimbs", view.calibrate.look.limbs);
}

template <class View, class Visit>
void ForEachSize(View& view, Visit visit) {
  visit("left", view.layout.left);
  visit("right", view.layout.right);
  visit("timeline", view.layout.timeline);
}

int SideOf(const Json& json, const char* name, int otherwise) {
  constexpr int kShortest = 400;
  constexpr int kLongest = 16384;
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return otherwise;
  return static_cast<int>(std::clamp(found->get<double>(), double{kShortest}, double{kLongest}));
}

}  // namespace

fs::path RememberedPath() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && fs::path(config).is_absolute()) {
    return fs::path(config) / "egostudio" / "window.json";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".config" / "egostudio" / "window.json";
}

Result<Remembered> ReadRemembered(const fs::path& path) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return Remembered{};
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) {
    return Error{path.string() +
                 ": damaged, so the window opens as it does at first; it is written anew on exit"};
  }
  Remembered remembered;
  remembered.window_width = SideOf(json, "width", remembered.window_width);
  remembered.window_height = SideOf(json, "height", remembered.window_height);
  ForEachSize(remembered, [&](const char* name, float& size) {
    const auto found = json.find(name);
    // Far from sense is brought back into it when the window is divided.
    if (found != json.end() && found->is_number()) {
      size = static_cast<float>(std::clamp(found->get<double>(), 0.0, 1e4));
    }
  });
  ForEachSwitch(remembered, [&](const char* name, bool& on) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_boolean()) on = found->get<bool>();
  });
  if (const auto found = json.find("navigation"); found != json.end() && found->is_string()) {
    remembered.navigation =
        NavigationNamed(found->get<std::string>()).value_or(remembered.navigation);
  }
  if (const auto found = json.find("recent"); found != json.end() && found->is_array()) {
    for (const Json& file : *found) {
      if (file.is_string()) remembered.recent.emplace_back(file.get<std::string>());
    }
  }
  return remembered;
}

Result<void> WriteRemembered(const fs::path& path, const Remembered& remembered) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) return Error{path.parent_path().string() + ": " + error.message()};
  Json json;
  json["width"] = remembered.window_width;
  json["height"] = remembered.window_height;
  ForEachSize(remembered, [&](const char* name, float size) { json[name] = size; });
  ForEachSwitch(remembered, [&](const char* name, bool on) { json[name] = on; });
  json["navigation"] = Name(remembered.navigation);
  json["recent"] = Json::array();
  for (const fs::path& file : remembered.recent) json["recent"].push_back(file.string());
  return WriteFileAtomically(path, json.dump(2) + "\n");
}

}  // namespace ego
