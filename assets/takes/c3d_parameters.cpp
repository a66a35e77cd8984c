// SPDX-License-Identifier: MIT
#include "assets/takes/c3d_parameters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "assets/files/shown_text.h"
#include "assets/takes/text.h"

namespace ego {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kMostParameters = 1u << 16;
// The data start is a 16-bit block number: parameters cannot reach beyond it.
constexpr std::size_t kLongestSection = 65535 * kBlock;

std::string UpperCase(std::string_view text) {
  std::string upper = CleanText(text);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

std::size_t SizeOf(int type) { return type < 0 ? 1 : static_cast<std::size_t>(type); }

std::optional<C3dProcessor> ProcessorOf(std::uint8_t byte) {
  if (byte < 84 || byte > 86) return std::nullopt;
  return static_cast<C3dProcessor>(byte);
}

}  // namespace

std::uint16_t C3dBytes::Unsigned(std::size_t offset) const {
  const unsigned a = bytes_[offset];
  const unsigned b = bytes_[offset + 1];
  return static_cast<std::uint16_t>(processor_ == C3dProcessor::kSgi ? a << 8 | b : b << 8 | a);
}

std::int16_t C3dBytes::Integer(std::size_t offset) const {
  return static_cast<std::int16_t>(Unsigned(offset));
}

double C3dBytes::Float(std::size_t offset) const {
  const std::uint32_t first = Unsigned(offset);
  const std::uint32_t second = Unsigned(offset + 2);
  switch (processor_) {
    case C3dProcessor::kIntel:
      return std::bit_cast<float>(second << 16 | first);
    case C3dProcessor::kSgi:
      return std::bit_cast<float>(first << 16 | second);
    case C3dProcessor::kDec:
      break;
  }
  // VAX F: the high half comes first, the exponent's bias is 2 greater than IEEE's, exponent zero
  // is zero whatever the fraction.
  const std::uint32_t bits = first << 16 | second;
  const int exponent = static_cast<int>(bits >> 23 & 0xFFu);
  if (exponent == 0) return 0.0;
  const double fraction = 1.0 + static_cast<double>(bits & 0x7FFFFFu) / 8388608.0;
  return std::ldexp((bits >> 31) != 0 ? -fraction : fraction, exponent - 129);
}

Result<C3dParameters> C3dParameters::Read(std::span<const std::uint8_t> file) {
  // Byte 1 names the block of the section; where that is wrong, the section follows the header.
  const std::array<std::size_t, 2> blocks = {file.empty() ? std::size_t{0} : file[0], 2};
  std::optional<C3dProcessor> processor;
  std::size_t start = 0;
  for (const std::size_t block : blocks) {
    if (block < 2 || processor) continue;
    start = (block - 1) * kBlock;
    if (start + 4 <= file.size()) processor = ProcessorOf(file[start + 3]);
  }
  if (!processor) return Error{"no parameter section is found where a C3D file has it"};

  C3dParameters section{
      C3dBytes(file.first(std::min(file.size(), start + kLongestSection)), *processor)};
  section.processor_ = *processor;
  section.start_ = start;
  const C3dBytes& bytes = section.bytes_;
  std::size_t at = start + 4;
  while (bytes.Has(at, 4) && section.parameters_.size() < kMostParameters) {
    const auto name_length = static_cast<std::size_t>(
        std::abs(static_cast<int>(static_cast<std::int8_t>(bytes.Byte(at)))));  // negative: locked
    const int id = static_cast<std::int8_t>(bytes.Byte(at + 1));
    if (name_length == 0 || !bytes.Has(at + 2, name_length + 2)) break;
    const std::string name = UpperCase(bytes.Text(at + 2, name_length));
    const std::size_t link = at + 2 + name_length;
    const std::size_t step = bytes.Unsigned(link);
    if (id < 0) {
      section.groups_.push_back({-id, name});
    } else if (bytes.Has(link + 2, 2)) {
      Parameter parameter;
      parameter.group = id;
      parameter.name = name;
      parameter.type = static_cast<std::int8_t>(bytes.Byte(link + 2));
      const std::size_t rank = bytes.Byte(link + 3);
      const bool known =
          parameter.type == -1 || parameter.type == 1 || parameter.type == 2 || parameter.type == 4;
      if (known && rank <= 7 && bytes.Has(link + 4, rank)) {
        parameter.count = 1;
        parameter.offset = link + 4 + rank;
        const std::size_t room = bytes.size() - parameter.offset;
        for (std::size_t d = 0; d < rank; ++d) {
          parameter.dimensions.push_back(bytes.Byte(link + 4 + d));
          // At most 255^7, which fits.
          parameter.count *= parameter.dimensions.back();
        }
        if (parameter.count <= room / SizeOf(parameter.type)) {
          section.parameters_.push_back(std::move(parameter));
        }
      }
    }
    if (step == 0) break;
    at = link + step;
  }
  return section;
}

const C3dParameters::Parameter* C3dParameters::Find(std::string_view group,
                                                    std::string_view name) const {
  for (const Parameter& parameter : parameters_) {
    if (parameter.name != name) continue;
    for (const Group& candidate : groups_) {
      if (candidate.id == parameter.group && candidate.name == group) return &parameter;
    }
  }
  return nullptr;
}

std::optional<double> C3dParameters::Value(const Parameter& parameter, std::size_t index,
                                           bool is_signed) const {
  if (index >= parameter.count) return std::nullopt;
  double value = 0.0;
  switch (parameter.type) {
    case 1:
      value = bytes_.Byte(parameter.offset + index);
      break;
    case 2: {
      const std::size_t offset = parameter.offset + 2 * index;
      value = is_signed ? static_cast<double>(bytes_.Integer(offset))
                        : static_cast<double>(bytes_.Unsigned(offset));
      break;
    }
    case 4:
      value = bytes_.Float(parameter.offset + 4 * index);
      break;
    default:
      return std::nullopt;
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> C3dParameters::Count(std::string_view group, std::string_view name,
                                           std::size_t index) const {
  const Parameter* parameter = Find(group, name);
  return parameter == nullptr ? std::nullopt : Value(*parameter, index, false);
}

std::optional<double> C3dParameters::Number(std::string_view group, std::string_view name) const {
  const Parameter* parameter = Find(group, name);
  return parameter == nullptr ? std::nullopt : Value(*parameter, 0, true);
}

std::vector<std::string> C3dParameters::Texts(std::string_view group, std::string_view name) const {
  std::vector<std::string> texts;
  const Parameter* parameter = Find(group, name);
  if (parameter == nullptr || parameter->type != -1) return texts;
  // The first dimension is the length of each text; without dimensions it is one character.
  const std::size_t width = parameter->dimensions.empty() ? 1 : parameter->dimensions[0];
  if (width == 0) return texts;
  for (std::size_t at = 0; at + width <= parameter->count; at += width) {
    texts.push_back(CleanText(bytes_.Text(parameter->offset + at, width)));
  }
  return texts;
}

std::vector<std::string> C3dParameters::LongTexts(std::string_view group,
                                                  std::string_view name) const {
  std::vector<std::string> texts = Texts(group, name);
  for (int part = 2; part < 1000; ++part) {
    const std::string next = std::string(name) + std::to_string(part);
    if (!Has(group, next)) break;
    std::vector<std::string> more = Texts(group, next);
    texts.insert(texts.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
  }
  return texts;
}

}  // namespace ego
