// SPDX-License-Identifier: MIT
#include "core/markers/up_axis.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

namespace ego {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

enum class Level : std::uint8_t { kUnknown, kFoot, kPelvis, kUpperBody };

// Label parts after the side letter is gone. Plug-in Gait, CMU, HDM05, Helen Hayes, Rizzoli,
// OptiTrack and OpenSim words; a longer word may follow.
constexpr std::array<std::string_view, 14> kFootParts = {"ANK", "HEE",  "HEL",    "TOE",   "MT1",
                                                         "MT5", "FOOT", "FCC",    "FM1",   "FM5",
                                                         "FAL", "TAM",  "5THMET", "1STMET"};
constexpr std::array<std::string_view, 12> kPelvisParts = {
    "ASI", "PSI", "FWT", "BWT", "MWT", "IAS", "IPS", "SACR", "HIP", "PELVIS", "WAIST", "ASIS"};
constexpr std::array<std::string_view, 19> kUpperParts = {
    "FHD", "BHD",  "HEAD", "HEA", "HDF", "HDB", "ARIEL", "C7",  "CV7",  "CLAV",
    "T10", "STRN", "SHO",  "FSH", "BSH", "SAJ", "SNJ",   "SXS", "CHEST"};

Level LevelOf(std::string_view label) {
  const std::string plain = PlainLabel(label);
  const auto begins = [&](std::string_view text, const auto& parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return text.starts_with(part); });
  };
  // "SKELETONLFOOT1": a skeleton's name may stand before the part, so look inside too, but only
  // for words long enough to be no accident.
  const auto holds = [&](std::string_view word) { return plain.find(word) != std::string::npos; };
  std::string_view text = plain;
  for (int pass = 0; pass < 2; ++pass) {
    if (begins(text, kUpperParts)) return Level::kUpperBody;
    if (begins(text, kFootParts)) return Level::kFoot;
    if (begins(text, kPelvisParts)) return Level::kPelvis;
    if (text.size() < 2 || (text[0] != 'L' && text[0] != 'R' && text[0] != 'F' && text[0] != 'T')) {
      break;
    }
    text.remove_prefix(1);
  }
  if (holds("HEAD") || holds("CHEST") || holds("SHOULDER") || holds("CLAVICLE")) {
    return Level::kUpperBody;
  }
  if (holds("FOOT") || holds("ANKLE") || holds("HEEL")) return Level::kFoot;
  if (holds("PELVIS")) return Level::kPelvis;
  return Level::kUnknown;
}

/// Component-wise median of the group's visible markers: one ghost does not move it.
std::optional<Vec3> GroupMedian(const std::vector<std::size_t>& group, std::span<const Vec3> point,
                                std::span<const std::uint8_t> seen, std::vector<double>& buffer) {
  Vec3 median{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    buffer.clear();
    for (const std::size_t i : group) {
      if (seen[i] != 0) buffer.push_back(point[i][axis]);
    }
    if (buffer.empty()) return std::nullopt;
    const auto middle = buffer.begin() + static_cast<std::ptrdiff_t>(buffer.size() / 2);
    std::nth_element(buffer.begin(), middle, buffer.end());
    median[axis] = *middle;
  }
  return median;
}

}  // namespace

Vec3 Direction(SignedAxis axis) {
  const auto index = static_cast<std::uint8_t>(axis);
  Vec3 direction{0.0};
  direction[index / 2] = (index & 1u) != 0u ? -1.0 : 1.0;
  return direction;
}

std::string_view Name(SignedAxis axis) { return kNames[static_cast<std::uint8_t>(axis)]; }

std::optional<SignedAxis> SignedAxisNamed(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  if (text.size() == 1) text.insert(text.begin(), '+');
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (text == kNames[i]) return static_cast<SignedAxis>(i);
  }
  return std::nullopt;
}

Mat3 RotationToYUp(SignedAxis up) {
  // Rows of the matrix: images' X, Y and Z in terms of the file's axes; glm takes columns.
  const Vec3 y = Direction(up);
  const Vec3 x = std::abs(y.x) > 0.5 ? Vec3{0.0, -y.x, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 z = glm::cross(x, y);
  return glm::transpose(Mat3(x, y, z));
}

std::string PlainLabel(std::string_view label) {
  if (const std::size_t colon = label.rfind(':'); colon != std::string_view::npos) {
    label.remove_prefix(colon + 1);
  }
  std::string plain;
  for (const char c : label) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte) != 0) plain += static_cast<char>(std::toupper(byte));
  }
  return plain;
}

std::optional<UpEvidence> UpFromMarkers(std::span<const std::string> labels,
                                        std::span<const Vec3> position,
                                        std::span<const std::uint8_t> visible) {
  std::vector<std::size_t> feet;
  std::vector<std::size_t> pelvis;
  std::vector<std::size_t> upper;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    switch (LevelOf(labels[i])) {
      case Level::kFoot:
        feet.push_back(i);
        break;
      case Level::kPelvis:
        pelvis.push_back(i);
        break;
      case Level::kUpperBody:
        upper.push_back(i);
        break;
      case Level::kUnknown:
        break;
    }
  }
  const std::vector<std::size_t>& high = upper.empty() ? pelvis : upper;
  if (feet.empty() || high.empty()) return std::nullopt;

  const std::size_t n = labels.size();
  const std::size_t frames = position.size() / n;
  constexpr std::size_t kSampledFrames = 400;
  const std::size_t step = std::max<std::size_t>(1, frames / kSampledFrames);
  std::vector<double> buffer;
  Vec3 sum{0.0};
  std::size_t counted = 0;
  for (std::size_t f = 0; f < frames; f += step) {
    const auto point = position.subspan(f * n, n);
    const auto seen = visible.subspan(f * n, n);
    const std::optional<Vec3> low_point = GroupMedian(feet, point, seen, buffer);
    const std::optional<Vec3> high_point = GroupMedian(high, point, seen, buffer);
    if (!low_point || !high_point) continue;
    const Vec3 rise = *high_point - *low_point;
    const double length = glm::length(rise);
    if (!(length > 0.0)) continue;
    sum += rise / length;
    ++counted;
  }
  if (counted == 0) return std::nullopt;
  UpEvidence best;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto axis = static_cast<SignedAxis>(i);
    const double agreement = glm::dot(sum, Direction(axis)) / static_cast<double>(counted);
    if (agreement > best.agreement) best = {axis, agreement};
  }
  if (best.agreement <= 0.0) return std::nullopt;
  return best;
}

}  // namespace ego
