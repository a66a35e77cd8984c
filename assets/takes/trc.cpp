// SPDX-License-Identifier: MIT
#include "assets/takes/trc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/files/file_io.h"
#include "assets/files/shown_text.h"
#include "assets/takes/marker_border.h"
#include "assets/takes/text.h"

namespace ego {
namespace {

constexpr std::size_t kMostMarkers = 10000;

/// Hands out lines without their ends; knows "\n", "\r\n" and "\r".
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }
  bool Next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line = rest_.substr(0, end);
    const bool pair = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(rest_.size(), end + (pair ? 2 : 1)));
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Cells between tabs, empty ones included; a line without tabs is cut at blanks or commas.
void SplitCells(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  const bool tabs = line.find('\t') != std::string_view::npos;
  const bool commas = !tabs && line.find(',') != std::string_view::npos;
  const std::string_view separators = tabs ? "\t" : commas ? "," : " ";
  while (true) {
    const std::size_t end = std::min(line.find_first_of(separators), line.size());
    const std::string_view cell = line.substr(0, end);
    if (tabs || commas || !cell.empty()) cells.push_back(cell);
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
  }
}

bool IsBlank(std::string_view text) {
  return text.find_first_not_of(" \t\v\f") == std::string_view::npos;
}

std::vector<std::string> Words(std::string_view line) {
  std::vector<std::string_view> cells;
  SplitCells(line, cells);
  std::vector<std::string> words;
  for (const std::string_view cell : cells) {
    if (!IsBlank(cell)) words.push_back(CleanText(cell));
  }
  return words;
}

struct TableHeader {
  double rate_hz = 0.0;
  double frame_count = 0.0;
  std::string unit;
};

/// Values belong to their names in order, whatever number of tabs stands between them.
TableHeader ReadHeader(const std::vector<std::string>& names,
                       const std::vector<std::string>& values) {
  TableHeader header;
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
    const double number = ReadNumber(values[i]).value_or(0.0);
    if (SameWord(names[i], "DataRate")) header.rate_hz = number;
    if (SameWord(names[i], "NumFrames")) header.frame_count = number;
    if (SameWord(names[i], "Units")) header.unit = values[i];
  }
  if (!MetresPerUnit(header.unit)) {
    for (const std::string& value : values) {
      if (MetresPerUnit(value)) header.unit = value;
    }
  }
  return header;
}

/// The table while its rows come in.
struct Table {
  std::vector<std::string> labels;
  std::vector<Vec3> position;
  std::vector<std::uint8_t> visible;
  std::size_t frame_count = 0;
  double first_time_s = 0.0;
  double last_time_s = 0.0;
};

/// Adds one row: frame number, time, then three cells per marker; cells that are missing at the
/// end are empty ones. Errors (without the file's name): a cell that is no number.
Result<void> AddRow(const std::vector<std::string_view>& cells, std::size_t line_number,
                    Table& table) {
  const auto bad_cell = [&](std::string_view cell) {
    return Error{"line " + std::to_string(line_number) + ": " + Quoted(cell) +
                 " stands where a number is expected"};
  };
  const auto read = [](std::string_view cell) -> std::optional<double> {
    if (IsBlank(cell)) return std::numeric_limits<double>::quiet_NaN();
    return ReadNumber(cell);
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(2, cells.size()); ++i) {
    const std::optional<double> number = read(cells[i]);
    if (!number) return bad_cell(cells[i]);
    if (i == 1 && std::isfinite(*number)) {
      if (table.frame_count == 0) table.first_time_s = *number;
      table.last_time_s = *number;
    }
  }
  for (std::size_t m = 0; m < table.labels.size(); ++m) {
    Vec3 p{std::numeric_limits<double>::quiet_NaN()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = 2 + 3 * m + axis;
      if (column >= cells.size()) continue;
      const std::optional<double> number = read(cells[column]);
      if (!number) return bad_cell(cells[column]);
      p[static_cast<int>(axis)] = *number;
    }
    const bool whole = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    table.position.push_back(whole ? p : Vec3{0.0});
    table.visible.push_back(whole ? 1 : 0);
  }
  ++table.frame_count;
  return {};
}

/// Labels stand above the first of their three columns; where a writer packed them without the
/// empty cells between, they are taken in order.
Result<std::vector<std::string>> ReadLabels(std::string_view line, std::string_view axes_line) {
  std::vector<std::string_view> cells;
  SplitCells(line, cells);
  std::vector<std::string_view> axes;
  SplitCells(axes_line, axes);
  std::size_t columns = 0;  // up to the last named axis ("X1", "Y1", ...)
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!IsBlank(axes[i])) columns = i + 1;
  }
  std::vector<std::string> labels;
  bool in_place = true;
  for (std::size_t i = 2; i < cells.size(); ++i) {
    if (IsBlank(cells[i])) continue;
    in_place = in_place && (i - 2) % 3 == 0;
    labels.push_back(CleanText(cells[i]));
  }
  if (in_place) {
    // A marker may have lost its name: its place in the row still counts.
    labels.clear();
    for (std::size_t i = 2; i < cells.size(); i += 3) labels.push_back(CleanText(cells[i]));
    while (!labels.empty() && labels.back().empty()) labels.pop_back();
  }
  if (columns > 2 && columns <= 2 + 3 * kMostMarkers) {
    labels.resize(std::max(labels.size(), (columns - 2 + 2) / 3));
  }
  if (labels.empty()) return Error{"names no markers in its \"Frame#\" line"};
  if (labels.size() > kMostMarkers) {
    return Error{"names " + std::to_string(labels.size()) + " markers, more than " +
                 std::to_string(kMostMarkers)};
  }
  return labels;
}

double ChooseRate(const TableHeader& header, const Table& table,
                  std::vector<std::string>& warnings) {
  constexpr double kAssumed = 100.0;
  if (header.rate_hz > 1e-3 && header.rate_hz < 1e5) return header.rate_hz;
  const double span = table.last_time_s - table.first_time_s;
  const double rate = static_cast<double>(table.frame_count - 1) / span;
  if (table.frame_count > 1 && rate > 1e-3 && rate < 1e5) {
    warnings.push_back("no frame rate is given; it is taken from the time column");
    return rate;
  }
  warnings.push_back("no frame rate is given; 100 Hz is assumed");
  return kAssumed;
}

/// Moves the markers' columns from the table to the take, model outputs aside.
void KeepMarkers(Table table, MarkerTake& take) {
  const std::vector<std::uint8_t> output = FindModelOutputs(table.labels, {});
  MakeLabelsUnique(table.labels, take.warnings);
  const std::size_t n = table.labels.size();
  for (std::size_t i = 0; i < n; ++i) {
    (output[i] == 0 ? take.labels : take.ignored).push_back(table.labels[i]);
  }
  take.frame_count = table.frame_count;
  for (std::size_t i = 0; i < table.position.size(); ++i) {
    if (output[i % n] != 0) continue;
    take.position_ws.push_back(table.position[i]);
    take.visible.push_back(table.visible[i]);
  }
}

Result<MarkerTake> Parse(std::string_view text, std::string_view name) {
  Lines lines(text);
  std::string_view line;
  std::string_view before;
  std::string_view before_that;
  bool found = false;
  while (!found && lines.number() < 50 && lines.Next(line)) {
    found = SameWord(CleanText(line.substr(0, 6)), "Frame#");
    if (!found && !IsBlank(line)) before_that = std::exchange(before, line);
  }
  if (!found) return Error{"is not a TRC table: the line that begins with \"Frame#\" is missing"};
  const TableHeader header = ReadHeader(Words(before_that), Words(before));

  const std::string_view label_line = line;
  std::vector<std::string_view> cells;
  Table table;
  bool first_row = true;
  while (lines.Next(line)) {
    if (IsBlank(line)) continue;
    SplitCells(line, cells);
    const bool axes = IsBlank(cells[0]) || !ReadNumber(cells[0]);
    if (first_row) {
      Result<std::vector<std::string>> labels =
          ReadLabels(label_line, axes ? line : std::string_view());
      if (!labels) return Error{labels.error()};
      table.labels = *std::move(labels);
      first_row = false;
      if (axes) continue;
    }
    if (Result<void> added = AddRow(cells, lines.number(), table); !added) {
      return Error{added.error()};
    }
  }
  if (table.frame_count == 0) return Error{"holds no frames"};
  const auto frames = static_cast<double>(table.frame_count);
  if (header.frame_count > frames) {
    return Error{"is cut off: " + std::to_string(table.frame_count) + " of " +
                 std::to_string(static_cast<long long>(std::min(header.frame_count, 1e15))) +
                 " frames are there"};
  }
  MarkerTake take;
  take.name = TakeName(name);
  if (header.frame_count >= 1.0 && header.frame_count < frames) {
    take.warnings.push_back("more rows than the header says; all " +
                            std::to_string(table.frame_count) + " are read");
  }
  take.rate_hz = ChooseRate(header, table, take.warnings);
  KeepMarkers(std::move(table), take);
  if (take.labels.empty()) return Error{"holds model outputs only, no markers"};
  ConvertToStage(take, header.unit, std::nullopt, SignedAxis::kPlusY);
  return take;
}

}  // namespace

Result<MarkerTake> ParseTrc(std::string_view text, std::string_view name) {
  Result<MarkerTake> take = Parse(text, name);
  if (!take) return Error{std::string(name) + ": " + take.error()};
  return take;
}

Result<MarkerTake> ReadTrc(const std::filesystem::path& path) {
  const Result<std::string> text = ReadTextFile(path);
  if (!text) return Error{text.error()};
  return ParseTrc(*text, path.string());
}

}  // namespace ego
