// SPDX-License-Identifier: MIT
#include "core/markers/marker_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ego {
namespace {

constexpr std::array<std::string_view, 5> kRegionNames = {"trunk", "head", "limb", "hand", "foot"};

// Fewer known markers than this cannot hold a body's 59 degrees of freedom together.
constexpr std::size_t kMinKnownMarkers = 12;
// A label that another set knows is placed less surely than one of the take's own set.
constexpr double kForeignSigmaFactor = 1.5;
// Two sets mean the same place when they agree to this, metres.
constexpr double kSamePlace = 0.08;

char Upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
bool IsWordCharacter(char c) {
  const char u = Upper(c);
  return (u >= 'A' && u <= 'Z') || (u >= '0' && u <= '9');
}

std::string_view AfterColon(std::string_view label) {
  const std::size_t colon = label.rfind(':');
  return colon == std::string_view::npos ? label : label.substr(colon + 1);
}

/// The word before the first '_' that nearly all labels begin with; empty when there is none.
std::string_view SharedPrefix(std::span<const std::string> labels) {
  std::map<std::string_view, std::size_t> count;
  for (const std::string& label : labels) {
    const std::string_view tail = AfterColon(label);
    const std::size_t end = tail.find('_');
    if (end != std::string_view::npos && end > 1) ++count[tail.substr(0, end + 1)];
  }
  for (const auto& [prefix, n] : count) {
    if (n >= 5 && 10 * n >= 8 * labels.size()) return prefix;
  }
  return {};
}

using LabelIndex = std::map<std::string_view, std::size_t>;

LabelIndex IndexLabels(const MarkerSet& set) {
  LabelIndex index;
  for (std::size_t i = 0; i < set.markers.size(); ++i) index.emplace(set.markers[i].label, i);
  for (std::size_t i = 0; i < set.markers.size(); ++i) {
    for (const std::string& alias : set.markers[i].aliases) index.emplace(alias, i);
  }
  return index;
}

std::vector<std::optional<std::size_t>> MatchClean(const MarkerSet& set,
                                                   std::span<const std::string> clean) {
  const LabelIndex index = IndexLabels(set);
  std::vector<std::optional<std::size_t>> match(clean.size());
  std::vector<bool> taken(set.markers.size(), false);
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const auto found = index.find(clean[i]);
    if (found == index.end() || taken[found->second]) continue;
    taken[found->second] = true;
    match[i] = found->second;
  }
  return match;
}

std::size_t CountMatched(const std::vector<std::optional<std::size_t>>& match) {
  return static_cast<std::size_t>(
      std::count_if(match.begin(), match.end(), [](const auto& m) { return m.has_value(); }));
}

bool LooksUnlabelled(const std::string& label) {
  const std::string_view tail = AfterColon(label);
  if (tail.empty() || tail.front() == '*') return true;
  const std::string clean = CleanLabel(label);
  if (std::all_of(clean.begin(), clean.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    return true;
  }
  constexpr std::array<std::string_view, 6> kWords = {"UNLABELED", "UNLABELLED", "UNKNOWN",
                                                      "MARKER",    "POINT",      "UNNAMED"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view word) { return clean.starts_with(word); });
}

std::string NamesOf(std::span<const MarkerSet> sets) {
  std::string names;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (i > 0) names += i + 1 == sets.size() ? " and " : ", ";
    names += sets[i].name;
  }
  return names;
}

/// The marker that the other sets agree this label means.
std::optional<SetMarker> MeaningElsewhere(std::span<const MarkerSet> known,
                                          const std::string& label) {
  std::optional<SetMarker> meaning;
  for (const MarkerSet& set : known) {
    const LabelIndex index = IndexLabels(set);
    const auto found = index.find(label);
    if (found == index.end()) continue;
    const SetMarker& marker = set.markers[found->second];
    if (!meaning) {
      meaning = marker;
    } else if (meaning->joint != marker.joint ||
               glm::distance(meaning->position_ms, marker.position_ms) > kSamePlace) {
      return std::nullopt;
    }
  }
  return meaning;
}

bool IsTaken(const MarkerSet& set, const std::string& label) {
  return IndexLabels(set).contains(label);
}

void Complete(MarkerSet& set, std::span<const MarkerSet> known,
              std::span<const std::string> clean) {
  std::vector<SetMarker> added;
  for (const std::string& label : clean) {
    if (IsTaken(set, label)) continue;
    std::optional<SetMarker> marker = MeaningElsewhere(known, label);
    if (!marker) continue;
    // The place may already be marked under another name that this take uses as well.
    const bool doubled = std::any_of(set.markers.begin(), set.markers.end(), [&](const auto& m) {
      return m.joint == marker->joint && glm::distance(m.position_ms, marker->position_ms) < 0.01 &&
             std::find(clean.begin(), clean.end(), m.label) != clean.end();
    });
    if (doubled) continue;
    marker->label = label;
    marker->aliases.clear();
    marker->mirror.clear();
    marker->sigma = std::min(1.0, kForeignSigmaFactor * marker->sigma);
    set.markers.push_back(*marker);
  }
}

}  // namespace

std::string_view Name(MarkerRegion region) {
  return kRegionNames[static_cast<std::size_t>(region)];
}

std::optional<MarkerRegion> MarkerRegionNamed(std::string_view name) {
  for (std::size_t i = 0; i < kRegionNames.size(); ++i) {
    if (kRegionNames[i] == name) return static_cast<MarkerRegion>(i);
  }
  return std::nullopt;
}

std::string CleanLabel(std::string_view label) {
  std::string clean;
  for (const char c : AfterColon(label)) {
    if (IsWordCharacter(c) || c == '*') clean += Upper(c);
  }
  return clean;
}

std::vector<std::string> CleanLabels(std::span<const std::string> labels) {
  const std::string_view prefix = SharedPrefix(labels);
  std::vector<std::string> clean;
  clean.reserve(labels.size());
  for (const std::string& label : labels) {
    std::string_view tail = AfterColon(label);
    if (!prefix.empty() && tail.starts_with(prefix)) tail.remove_prefix(prefix.size());
    clean.push_back(CleanLabel(tail));
  }
  return clean;
}

std::vector<std::optional<std::size_t>> MatchLabels(const MarkerSet& set,
                                                    std::span<const std::string> labels) {
  return MatchClean(set, CleanLabels(labels));
}

Result<MarkerSet> ChooseMarkerSet(std::span<const MarkerSet> known,
                                  std::span<const std::string> labels) {
  const std::vector<std::string> clean = CleanLabels(labels);
  const MarkerSet* best = nullptr;
  std::size_t best_found = 0;
  std::size_t best_missing = 0;
  for (const MarkerSet& set : known) {
    const std::size_t found = CountMatched(MatchClean(set, clean));
    const std::size_t missing = set.markers.size() - found;
    if (best == nullptr || found > best_found || (found == best_found && missing < best_missing)) {
      best = &set;
      best_found = found;
      best_missing = missing;
    }
  }
  if (best != nullptr && best_found > 0) {
    MarkerSet chosen = *best;
    Complete(chosen, known, clean);
    best_found = CountMatched(MatchClean(chosen, clean));
    if (best_found >= kMinKnownMarkers) return chosen;
  }
  const std::size_t unlabelled =
      static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), LooksUnlabelled));
  if (labels.empty() || 2 * unlabelled > labels.size()) {
    return Error{
        "the markers are not labelled: label them (or export the labelled take) with the "
        "names of one of the sets " +
        NamesOf(known) + ", or describe the set in a marker set file"};
  }
  return Error{"only " + std::to_string(best_found) + " of " + std::to_string(labels.size()) +
               " marker labels are known and at least " + std::to_string(kMinKnownMarkers) +
               " are needed: use the labels of one of the sets " + NamesOf(known) +
               ", or describe the set in a marker set file"};
}

Result<void> Validate(const MarkerSet& set) {
  const std::string where = "marker set \"" + set.name + "\"";
  if (set.markers.empty()) return Error{where + " has no markers"};
  std::map<std::string, std::size_t> by_label;
  for (std::size_t i = 0; i < set.markers.size(); ++i) {
    const SetMarker& marker = set.markers[i];
    const std::string which = where + ", marker \"" + marker.label + "\": ";
    std::vector<std::string> names = marker.aliases;
    names.push_back(marker.label);
    for (const std::string& name : names) {
      if (name.empty() || name != CleanLabel(name)) {
        return Error{which + "label \"" + name + "\" must be upper case letters and digits"};
      }
      if (!by_label.emplace(name, i).second) {
        return Error{which + "label \"" + name + "\" is used twice"};
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double value = marker.position_ms[axis];
      if (!std::isfinite(value) || std::abs(value) > 3.0) {
        return Error{which + "position must be three numbers within 3 m"};
      }
    }
    if (!(marker.sigma > 0.0) || marker.sigma > 1.0) {
      return Error{which + "sigma must be above 0 and at most 1 m"};
    }
  }
  for (const SetMarker& marker : set.markers) {
    if (marker.mirror.empty()) continue;
    const auto partner = by_label.find(marker.mirror);
    if (partner == by_label.end() || set.markers[partner->second].mirror != marker.label) {
      return Error{where + ", marker \"" + marker.label + "\": its mirror \"" + marker.mirror +
                   "\" must be a marker that names it in turn"};
    }
  }
  return {};
}

}  // namespace ego
