// SPDX-License-Identifier: MIT
#include "assets/markers/marker_set_file.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "assets/files/file_io.h"
#include "assets/files/shown_text.h"
#include "assets/markers/shipped_marker_sets.h"

namespace ego {
namespace {

using Json = nlohmann::json;

// More than any body carries; bounds the work on a hostile file.
constexpr std::size_t kMaxMarkers = 1000;
constexpr std::size_t kMaxAliases = 100;
constexpr std::size_t kLongestLabel = 64;
constexpr const char* kTooLong = " must have at most 64 letters";

std::optional<std::string> StringAt(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  return CleanText(found->get_ref<const std::string&>());
}

std::optional<Vec3> VectorAt(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 3) return std::nullopt;
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const Json& value = (*found)[static_cast<std::size_t>(i)];
    if (!value.is_number()) return std::nullopt;
    v[i] = value.get<double>();
  }
  return v;
}

Result<SetMarker> ReadMarker(const Json& object, const std::string& where) {
  if (!object.is_object()) return Error{where + " must be an object"};
  SetMarker marker;
  const std::optional<std::string> label = StringAt(object, "label");
  if (!label) return Error{where + " needs a \"label\" string"};
  marker.label = CleanLabel(*label);
  const std::string which = where + " " + Quoted(*label);
  if (label->size() > kLongestLabel) return Error{which + kTooLong};

  if (const auto aliases = object.find("aliases"); aliases != object.end()) {
    if (!aliases->is_array() || aliases->size() > kMaxAliases) {
      return Error{which + ": \"aliases\" must be a list of at most " +
                   std::to_string(kMaxAliases) + " strings"};
    }
    for (const Json& alias : *aliases) {
      if (!alias.is_string()) return Error{which + ": \"aliases\" must hold strings only"};
      const std::string word = CleanText(alias.get_ref<const std::string&>());
      if (word.size() > kLongestLabel) return Error{which + kTooLong};
      marker.aliases.push_back(CleanLabel(word));
    }
  }
  const std::optional<std::string> joint = StringAt(object, "joint");
  const std::optional<HumanoidJoint> known = joint ? JointNamed(*joint) : std::nullopt;
  if (!known) return Error{which + ": \"joint\" must be a humanoid bone name such as \"leftHand\""};
  marker.joint = *known;
  const std::optional<Vec3> position = VectorAt(object, "position");
  if (!position) return Error{which + ": \"position\" must be three numbers, metres"};
  marker.position_ms = *position;
  if (const auto sigma = object.find("sigma"); sigma != object.end()) {
    if (!sigma->is_number()) return Error{which + ": \"sigma\" must be a number, metres"};
    marker.sigma = sigma->get<double>();
  }
  const std::optional<std::string> region = StringAt(object, "region");
  const std::optional<MarkerRegion> lies_on = region ? MarkerRegionNamed(*region) : std::nullopt;
  if (!lies_on) {
    return Error{which + ": \"region\" must be trunk, head, limb, hand or foot"};
  }
  marker.region = *lies_on;
  if (object.contains("mirror")) {
    const std::optional<std::string> mirror = StringAt(object, "mirror");
    if (!mirror) return Error{which + ": \"mirror\" must be the label of the other side"};
    if (mirror->size() > kLongestLabel) return Error{which + kTooLong};
    marker.mirror = CleanLabel(*mirror);
  }
  return marker;
}

/// Adds the partners that a file leaves out because they are mirror images.
void AddImpliedPartners(MarkerSet& set) {
  const std::size_t written = set.markers.size();
  for (std::size_t i = 0; i < written; ++i) {
    const SetMarker marker = set.markers[i];
    if (marker.mirror.empty()) continue;
    const bool present = std::any_of(set.markers.begin(), set.markers.end(),
                                     [&](const auto& m) { return m.label == marker.mirror; });
    if (present) continue;
    SetMarker partner = marker;
    std::swap(partner.label, partner.mirror);
    partner.aliases.clear();
    partner.joint = Mirror(marker.joint);
    partner.position_ms.x = -marker.position_ms.x;
    set.markers.push_back(partner);
  }
}

}  // namespace

Result<MarkerSet> ParseMarkerSet(std::string_view text, std::string_view name) {
  const std::string file(name);
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded()) return Error{file + ": not valid JSON"};
  if (!root.is_object()) return Error{file + ": a marker set must be a JSON object"};
  MarkerSet set;
  const std::optional<std::string> set_name = StringAt(root, "name");
  if (!set_name || set_name->empty()) return Error{file + ": needs a \"name\" string"};
  if (set_name->size() > kLongestLabel) return Error{file + ": its name" + kTooLong};
  set.name = *set_name;
  set.description = StringAt(root, "description").value_or("");
  const auto markers = root.find("markers");
  if (markers == root.end() || !markers->is_array() || markers->size() > kMaxMarkers) {
    return Error{file + ": \"markers\" must be a list of at most " + std::to_string(kMaxMarkers)};
  }
  for (std::size_t i = 0; i < markers->size(); ++i) {
    Result<SetMarker> marker =
        ReadMarker((*markers)[i], file + ": marker " + std::to_string(i + 1));
    if (!marker) return Error{marker.error()};
    set.markers.push_back(*std::move(marker));
  }
  AddImpliedPartners(set);
  if (const Result<void> valid = Validate(set); !valid) return Error{file + ": " + valid.error()};
  return set;
}

Result<MarkerSet> ReadMarkerSet(const std::filesystem::path& path) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParseMarkerSet(*text, path.filename().string());
}

std::string FormatMarkerSet(const MarkerSet& set) {
  nlohmann::ordered_json root;
  root["name"] = set.name;
  root["description"] = set.description;
  root["markers"] = nlohmann::ordered_json::array();
  for (const SetMarker& marker : set.markers) {
    nlohmann::ordered_json entry;
    entry["label"] = marker.label;
    if (!marker.aliases.empty()) entry["aliases"] = marker.aliases;
    entry["joint"] = std::string(Name(marker.joint));
    entry["position"] = {marker.position_ms.x, marker.position_ms.y, marker.position_ms.z};
    entry["sigma"] = marker.sigma;
    entry["region"] = std::string(Name(marker.region));
    if (!marker.mirror.empty()) entry["mirror"] = marker.mirror;
    root["markers"].push_back(std::move(entry));
  }
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::span<const MarkerSet> ShippedMarkerSets() {
  static const std::vector<MarkerSet> kSets = [] {
    std::vector<MarkerSet> sets;
    for (const ShippedMarkerSetText& shipped : ShippedMarkerSetTexts()) {
      Result<MarkerSet> set = ParseMarkerSet(shipped.json, shipped.file);
      if (set) sets.push_back(*std::move(set));  // a test proves that each one parses
    }
    return sets;
  }();
  return kSets;
}

Result<MarkerSet> ChooseMarkerSet(std::span<const std::string> labels) {
  return ChooseMarkerSet(ShippedMarkerSets(), labels);
}

}  // namespace ego
