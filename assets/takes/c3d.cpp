// SPDX-License-Identifier: MIT
#include "assets/takes/c3d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/files/file_io.h"
#include "assets/takes/c3d_parameters.h"
#include "assets/takes/marker_border.h"
#include "assets/takes/text.h"

namespace ego {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::uint8_t kMagic = 0x50;
constexpr double kSaturated = 65535.0;  // a 16-bit count that may stand for more

/// Where the points lie in the file and how they are written.
struct Layout {
  std::size_t point_count = 0;
  std::size_t frame_count = 0;
  std::size_t data_offset = 0;  // bytes
  std::size_t frame_bytes = 0;
  bool is_float = false;
  double scale = 1.0;  // file units per integer step
};

/// The fixed header, words as the C3D User Guide numbers them.
struct Header {
  std::size_t point_count;   // word 2
  std::size_t analog_count;  // word 3: analog numbers per frame
  std::size_t first_frame;   // word 4
  std::size_t last_frame;    // word 5
  double scale;              // words 7 and 8
  std::size_t data_block;    // word 9
  double rate_hz;            // words 11 and 12
};

Header ReadHeader(const C3dBytes& bytes) {
  return {bytes.Unsigned(2), bytes.Unsigned(4),  bytes.Unsigned(6), bytes.Unsigned(8),
          bytes.Float(12),   bytes.Unsigned(16), bytes.Float(20)};
}

/// Frame counts that the file states, the most trustworthy first.
std::vector<std::size_t> StatedFrameCounts(const Header& header, const C3dParameters& parameters) {
  std::vector<double> counts;
  const auto field = [&](std::string_view name) -> std::optional<double> {
    const std::optional<double> low = parameters.Count("TRIAL", name, 0);
    const std::optional<double> high = parameters.Count("TRIAL", name, 1);
    if (!low) return std::nullopt;
    return *low + 65536.0 * high.value_or(0.0);
  };
  const std::optional<double> first = field("ACTUAL_START_FIELD");
  const std::optional<double> last = field("ACTUAL_END_FIELD");
  if (first && last && *last > 0.0) counts.push_back(*last - *first + 1.0);
  counts.push_back(parameters.Count("POINT", "LONG_FRAMES").value_or(0.0));
  counts.push_back(static_cast<double>(header.last_frame) -
                   static_cast<double>(header.first_frame) + 1.0);
  counts.push_back(parameters.Count("POINT", "FRAMES").value_or(0.0));

  const double most = *std::max_element(counts.begin(), counts.end());
  std::vector<std::size_t> stated;
  for (const double count : counts) {
    if (count < 1.0 || count > 4294967295.0) continue;
    if (count >= kSaturated - 1.0 && count <= kSaturated && most > kSaturated) continue;
    stated.push_back(static_cast<std::size_t>(count));
  }
  return stated;
}

Result<Layout> ReadLayout(const C3dBytes& bytes, const C3dParameters& parameters,
                          std::vector<std::string>& warnings) {
  const Header header = ReadHeader(bytes);
  Layout layout;
  layout.scale = parameters.Number("POINT", "SCALE").value_or(0.0);
  if (layout.scale == 0.0 && std::isfinite(header.scale)) layout.scale = header.scale;
  layout.is_float = layout.scale < 0.0;
  if (layout.scale == 0.0) {
    return Error{"POINT:SCALE is zero or absent, so the points' positions are unknown"};
  }
  layout.scale = std::abs(layout.scale);

  layout.point_count = header.point_count;
  if (layout.point_count == 0) {
    layout.point_count = static_cast<std::size_t>(
        std::clamp(parameters.Count("POINT", "USED").value_or(0.0), 0.0, 65535.0));
  }
  if (layout.point_count == 0) return Error{"holds no points"};

  std::size_t block = header.data_block;
  const std::size_t after_parameters = parameters.start() / kBlock + 2;
  if (block < after_parameters) {
    block = static_cast<std::size_t>(
        std::clamp(parameters.Count("POINT", "DATA_START").value_or(0.0), 0.0, 65535.0));
  }
  if (block < after_parameters) return Error{"the start of the data is not given"};
  layout.data_offset = (block - 1) * kBlock;

  const std::size_t number_bytes = layout.is_float ? 4 : 2;
  layout.frame_bytes = number_bytes * (4 * layout.point_count + header.analog_count);
  const std::size_t room =
      bytes.size() > layout.data_offset ? bytes.size() - layout.data_offset : 0;
  const std::size_t fitting = room / layout.frame_bytes;

  const std::vector<std::size_t> stated = StatedFrameCounts(header, parameters);
  if (stated.empty()) return Error{"holds no frames"};
  const auto chosen = std::find_if(stated.begin(), stated.end(),
                                   [&](std::size_t count) { return count <= fitting; });
  if (chosen == stated.end()) {
    return Error{"is cut off: " + std::to_string(fitting) + " of " +
                 std::to_string(stated.front()) + " frames are there"};
  }
  layout.frame_count = *chosen;
  if (chosen != stated.begin()) {
    warnings.push_back("frame counts in the file disagree; " + std::to_string(*chosen) +
                       " frames are read");
  } else if (static_cast<double>(*chosen) == kSaturated && fitting > *chosen) {
    layout.frame_count = fitting;
    warnings.push_back("more frames than a C3D header can count; " + std::to_string(fitting) +
                       " are read");
  }
  return layout;
}

double ReadRate(const C3dBytes& bytes, const C3dParameters& parameters,
                std::vector<std::string>& warnings) {
  constexpr double kFastest = 100000.0;
  constexpr double kAssumed = 100.0;
  const std::array<double, 3> stated = {parameters.Number("POINT", "RATE").value_or(0.0),
                                        ReadHeader(bytes).rate_hz,
                                        parameters.Number("TRIAL", "CAMERA_RATE").value_or(0.0)};
  for (const double rate : stated) {
    if (rate > 1e-3 && rate < kFastest) return rate;
  }
  warnings.push_back("no frame rate is given; 100 Hz is assumed");
  return kAssumed;
}

/// Labels of all points that the file's own lists call something other than markers.
std::vector<std::string> DeclaredOutputs(const C3dParameters& parameters) {
  std::vector<std::string> lists = {"ANGLES",  "FORCES",    "MOMENTS",        "POWERS",
                                    "SCALARS", "REACTIONS", "MODELED_MARKERS"};
  const std::vector<std::string> groups = parameters.Texts("POINT", "TYPE_GROUPS");
  for (std::size_t i = 0; i < groups.size(); i += 2) lists.push_back(groups[i]);
  std::sort(lists.begin(), lists.end());
  lists.erase(std::unique(lists.begin(), lists.end()), lists.end());
  std::vector<std::string> labels;
  for (const std::string& list : lists) {
    if (list.empty() || list == "LABELS") continue;
    for (std::string& label : parameters.LongTexts("POINT", list)) {
      if (!label.empty()) labels.push_back(std::move(label));
    }
  }
  return labels;
}

/// Reads positions and the sign of the residual (negative: the point was not measured).
void ReadPoints(const C3dBytes& bytes, const Layout& layout, const std::vector<std::size_t>& kept,
                MarkerTake& take) {
  const std::size_t number_bytes = layout.is_float ? 4 : 2;
  const auto number = [&](std::size_t offset) {
    return layout.is_float ? bytes.Float(offset)
                           : layout.scale * static_cast<double>(bytes.Integer(offset));
  };
  take.position_ws.resize(layout.frame_count * kept.size());
  take.visible.resize(layout.frame_count * kept.size());
  std::size_t out = 0;
  for (std::size_t f = 0; f < layout.frame_count; ++f) {
    const std::size_t frame = layout.data_offset + f * layout.frame_bytes;
    for (const std::size_t point : kept) {
      const std::size_t at = frame + 4 * number_bytes * point;
      take.position_ws[out] = {number(at), number(at + number_bytes),
                               number(at + 2 * number_bytes)};
      const double residual =
          layout.is_float ? bytes.Float(at + 12) : static_cast<double>(bytes.Integer(at + 6));
      take.visible[out] = residual < 0.0 ? 0 : 1;
      ++out;
    }
  }
}

Result<MarkerTake> Parse(std::span<const std::uint8_t> file, std::string_view name) {
  if (file.size() < kBlock || file[1] != kMagic) {
    return Error{"is not a C3D file: its header does not begin with the C3D mark"};
  }
  Result<C3dParameters> parameters = C3dParameters::Read(file);
  if (!parameters) return Error{parameters.error()};
  const C3dBytes bytes(file, parameters->processor());

  MarkerTake take;
  take.name = TakeName(name);
  const Result<Layout> layout = ReadLayout(bytes, *parameters, take.warnings);
  if (!layout) return Error{layout.error()};
  take.rate_hz = ReadRate(bytes, *parameters, take.warnings);
  take.frame_count = layout->frame_count;

  std::vector<std::string> labels = parameters->LongTexts("POINT", "LABELS");
  labels.resize(layout->point_count);
  const std::vector<std::uint8_t> output = FindModelOutputs(labels, DeclaredOutputs(*parameters));
  MakeLabelsUnique(labels, take.warnings);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (output[i] == 0) kept.push_back(i);
    (output[i] == 0 ? take.labels : take.ignored).push_back(std::move(labels[i]));
  }
  if (kept.empty()) return Error{"holds model outputs only, no markers"};

  ReadPoints(bytes, *layout, kept, take);
  const std::vector<std::string> unit = parameters->Texts("POINT", "UNITS");
  const std::vector<std::string> screen = parameters->Texts("POINT", "Y_SCREEN");
  ConvertToStage(take, unit.empty() ? std::string_view() : std::string_view(unit[0]),
                 screen.empty() ? std::nullopt : SignedAxisNamed(screen[0]), SignedAxis::kPlusZ);
  return take;
}

}  // namespace

Result<MarkerTake> ParseC3d(std::span<const std::uint8_t> bytes, std::string_view name) {
  Result<MarkerTake> take = Parse(bytes, name);
  if (!take) return Error{std::string(name) + ": " + take.error()};
  return take;
}

Result<MarkerTake> ReadC3d(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = ReadFile(path);
  if (!bytes) return Error{bytes.error()};
  return ParseC3d(*bytes, path.string());
}

}  // namespace ego
