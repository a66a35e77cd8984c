// SPDX-License-Identifier: MIT
#include "assets/takes/marker_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "assets/files/shown_text.h"
#include "assets/takes/text.h"

namespace ego {
namespace {

constexpr double kFarthest = 1000.0;  // metres

struct UnitName {
  std::string_view name;
  double metres;
};
constexpr std::array<UnitName, 24> kUnits = {{
    {"mm", 1e-3},          {"millimeter", 1e-3},  {"millimeters", 1e-3}, {"millimetre", 1e-3},
    {"millimetres", 1e-3}, {"cm", 1e-2},          {"centimeter", 1e-2},  {"centimeters", 1e-2},
    {"centimetre", 1e-2},  {"centimetres", 1e-2}, {"dm", 1e-1},          {"m", 1.0},
    {"meter", 1.0},        {"meters", 1.0},       {"metre", 1.0},        {"metres", 1.0},
    {"in", 0.0254},        {"inch", 0.0254},      {"inches", 0.0254},    {"\"", 0.0254},
    {"ft", 0.3048},        {"foot", 0.3048},      {"feet", 0.3048},      {"km", 1000.0},
}};

// Endings (whole words of the usual biomechanics models) that say: not a marker. Compared without
// regard to case, after digits at the end are gone.
constexpr std::array<std::string_view, 26> kOutputEndings = {"angle",
                                                             "angles",
                                                             "force",
                                                             "forces",
                                                             "moment",
                                                             "moments",
                                                             "power",
                                                             "powers",
                                                             "torque",
                                                             "scalar",
                                                             "velocity",
                                                             "acceleration",
                                                             "grf",
                                                             "legheight",
                                                             "leglength",
                                                             "archheight",
                                                             "archheightindex",
                                                             "hjc",
                                                             "kjc",
                                                             "ajc",
                                                             "sjc",
                                                             "ejc",
                                                             "wjc",
                                                             "jointground",
                                                             "jointcenter",
                                                             "jointcentre"};
constexpr std::array<std::string_view, 5> kOutputBeginnings = {"centreofmass", "centerofmass", "v_",
                                                               "mid", "proj"};

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string LowerWithoutSubject(std::string_view label) {
  if (const std::size_t colon = label.rfind(':'); colon != std::string_view::npos) {
    label.remove_prefix(colon + 1);
  }
  std::string lower;
  for (const char c : label) lower += Lower(c);
  return lower;
}

bool LooksLikeOutput(std::string_view label) {
  std::string text = LowerWithoutSubject(label);
  const std::string_view original = label.substr(label.size() - text.size());
  for (const std::string_view beginning : kOutputBeginnings) {
    if (!text.starts_with(beginning)) continue;
    // "MidASIS" and "Mid_PSIS" are computed; "MIDDLE" or "midfoot" may be stuck to the skin.
    if (beginning == "mid" &&
        (text.size() < 4 || (original[3] != '_' && (original[3] < 'A' || original[3] > 'Z')) ||
         original[1] == 'I')) {
      continue;
    }
    // "V_R.Hip" is virtual, "V_Sacral" is stuck to the sacrum.
    if (beginning == "v_" && text.starts_with("v_sac")) continue;
    if (beginning == "proj" && (text.size() < 5 || original[4] < 'A' || original[4] > 'Z')) {
      continue;
    }
    return true;
  }
  while (!text.empty() && text.back() >= '0' && text.back() <= '9') text.pop_back();
  if (text.ends_with("harrington")) text.resize(text.size() - 10);
  if (text.size() > 6 && (text.ends_with("joint") || text.ends_with("ground"))) return true;
  return std::any_of(kOutputEndings.begin(), kOutputEndings.end(), [&](std::string_view ending) {
    // "LHJC", "R_HJC", "LHipAngles"; a bare "force" is no marker either.
    return text.ends_with(ending);
  });
}

/// Marks every label whose stem exists with all four endings.
void MarkQuadruples(std::span<const std::string> labels, std::string_view endings,
                    std::vector<std::uint8_t>& output) {
  std::unordered_map<std::string, unsigned> found;  // stem -> bit per ending
  const auto ending_of = [&](const std::string& label) {
    return label.size() < 3 || label.front() == '*' ? std::string_view::npos
                                                    : endings.find(label.back());
  };
  for (const std::string& label : labels) {
    if (const std::size_t k = ending_of(label); k != std::string_view::npos) {
      found[label.substr(0, label.size() - 1)] |= 1u << k;
    }
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (ending_of(labels[i]) == std::string_view::npos) continue;
    if (found[labels[i].substr(0, labels[i].size() - 1)] == 0b1111u) output[i] = 1;
  }
}

/// Sorted middle 80 % of one axis in one frame, as a length: outliers do not stretch it.
double Spread(std::vector<double>& values) {
  const std::size_t cut = values.size() / 10;
  std::sort(values.begin(), values.end());
  return values[values.size() - 1 - cut] - values[cut];
}

/// Median over the take of the markers' spread along each axis, file units. Zero without frames
/// that show at least four markers.
Vec3 MedianExtent(const MarkerTake& take) {
  const std::size_t n = take.labels.size();
  constexpr std::size_t kSampledFrames = 200;
  const std::size_t step = std::max<std::size_t>(1, take.frame_count / kSampledFrames);
  std::array<std::vector<double>, 3> extent;
  std::vector<double> values;
  for (std::size_t f = 0; f < take.frame_count; f += step) {
    for (int axis = 0; axis < 3; ++axis) {
      values.clear();
      for (std::size_t i = f * n; i < (f + 1) * n; ++i) {
        if (take.visible[i] != 0) values.push_back(take.position_ws[i][axis]);
      }
      if (values.size() >= 4) extent[static_cast<std::size_t>(axis)].push_back(Spread(values));
    }
  }
  Vec3 median{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& all = extent[static_cast<std::size_t>(axis)];
    if (all.empty()) return Vec3{0.0};
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    median[axis] = *middle;
  }
  return median;
}

double Longest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

/// Metres per file unit: the declared unit unless it is unknown or would make a person a giant or
/// a grain of sand while another common unit would not.
double ChooseUnit(MarkerTake& take, std::string_view unit, const Vec3& extent) {
  constexpr std::array<UnitName, 3> kGuesses = {{{"mm", 1e-3}, {"m", 1.0}, {"cm", 1e-2}}};
  constexpr std::size_t kEnoughMarkers = 10;
  // The middle 80 % of a person's markers span this much, lying, crouching or standing.
  const auto plausible = [&](double metres) {
    const double size = metres * Longest(extent);
    return size > 0.35 && size < 3.5;
  };
  const std::optional<double> declared = MetresPerUnit(unit);
  const bool judged = take.labels.size() >= kEnoughMarkers && Longest(extent) > 0.0;
  if (declared &&
      (!judged || (Longest(extent) * *declared > 0.1 && Longest(extent) * *declared < 10.0))) {
    return *declared;
  }
  for (const UnitName& guess : kGuesses) {
    if (!judged || !plausible(guess.metres)) continue;
    take.warnings.push_back((unit.empty() ? "no unit is given" : "unit " + Quoted(unit)) +
                            (unit.empty() ? "; read as " : " does not fit a person; read as ") +
                            std::string(guess.name));
    return guess.metres;
  }
  if (declared) return *declared;
  take.warnings.push_back(
      (unit.empty() ? std::string("no unit is given") : "unit " + Quoted(unit) + " is unknown") +
      "; read as mm");
  return 1e-3;
}

SignedAxis ChooseUp(MarkerTake& take, std::optional<SignedAxis> declared, SignedAxis usual,
                    const Vec3& extent) {
  constexpr double kSure = 0.35;  // below it the person mostly lay or crawled
  const std::optional<UpEvidence> evidence =
      UpFromMarkers(take.labels, take.position_ws, take.visible);
  if (evidence && evidence->agreement >= kSure) {
    if (declared && *declared != evidence->axis) {
      take.warnings.push_back("the file says that " + std::string(Name(*declared)) +
                              " is up, the markers say " + std::string(Name(evidence->axis)) +
                              "; the markers are believed");
    }
    return evidence->axis;
  }
  if (declared) return *declared;
  // Nothing is known: people are taller than deep, and files have Y or Z up.
  const SignedAxis other = usual == SignedAxis::kPlusZ ? SignedAxis::kPlusY : SignedAxis::kPlusZ;
  const double along_usual = std::abs(glm::dot(extent, Direction(usual)));
  const double along_other = std::abs(glm::dot(extent, Direction(other)));
  const SignedAxis up = along_other > 1.5 * along_usual ? other : usual;
  take.warnings.push_back("the up axis is not known; " + std::string(Name(up)) + " is assumed");
  return up;
}

}  // namespace

std::optional<double> MetresPerUnit(std::string_view unit) {
  const std::string clean = CleanText(unit);
  for (const UnitName& known : kUnits) {
    if (SameWord(clean, known.name)) return known.metres;
  }
  return std::nullopt;
}

std::vector<std::uint8_t> FindModelOutputs(std::span<const std::string> labels,
                                           std::span<const std::string> declared) {
  std::vector<std::uint8_t> output(labels.size(), 0);
  const std::unordered_set<std::string> named(declared.begin(), declared.end());
  bool other_outputs = false;
  // Millard and others keep single bone axes of Plug-in Gait; these stems are no body parts.
  constexpr std::array<std::string_view, 8> kLoneAxes = {"pelo", "pela", "pell", "pelp",
                                                         "trxo", "trxa", "trxl", "trxp"};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string lower = LowerWithoutSubject(labels[i]);
    const bool lone = std::find(kLoneAxes.begin(), kLoneAxes.end(), lower) != kLoneAxes.end();
    if (named.contains(labels[i]) || LooksLikeOutput(labels[i])) {
      output[i] = 1;
      other_outputs = true;
    } else if (lone) {
      output[i] = 1;
    }
  }
  MarkQuadruples(labels, "OALP", output);
  if (other_outputs) MarkQuadruples(labels, "0123", output);
  return output;
}

void MakeLabelsUnique(std::vector<std::string>& labels, std::vector<std::string>& warnings) {
  std::unordered_map<std::string, std::size_t> next_number;  // per label, repeated or not
  std::size_t repeated = 0;
  std::string example;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::string label = CleanText(labels[i]);
    if (label.empty()) label.append("*").append(std::to_string(i + 1));
    std::string unique = label;
    const auto [entry, is_new] = next_number.try_emplace(label, 2);
    std::size_t& number = entry->second;  // stays valid when the map grows
    for (bool taken = !is_new; taken; taken = !next_number.try_emplace(unique, 2).second) {
      unique = label + "#" + std::to_string(number++);
    }
    if (unique != label && repeated++ == 0) example = label;
    labels[i] = std::move(unique);
  }
  if (repeated != 0) {
    warnings.push_back(std::to_string(repeated) + " labels are repeated (" + Quoted(example) +
                       " first) and got a number");
  }
}

void ConvertToStage(MarkerTake& take, std::string_view unit, std::optional<SignedAxis> declared_up,
                    SignedAxis usual_up) {
  for (std::size_t i = 0; i < take.position_ws.size(); ++i) {
    const Vec3& p = take.position_ws[i];
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (!finite || p == Vec3{0.0}) take.visible[i] = 0;
    if (take.visible[i] == 0) take.position_ws[i] = Vec3{0.0};
  }
  const Vec3 extent = MedianExtent(take);
  const double metres = ChooseUnit(take, unit, extent);
  const Mat3 turn = RotationToYUp(ChooseUp(take, declared_up, usual_up, extent));
  for (std::size_t i = 0; i < take.position_ws.size(); ++i) {
    Vec3& p = take.position_ws[i];
    if (take.visible[i] == 0) continue;
    p = turn * (metres * p);
    // Written so that an overflow to NaN counts as far.
    if (!(std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest)) {
      take.visible[i] = 0;
      p = Vec3{0.0};
    }
  }
}

}  // namespace ego
