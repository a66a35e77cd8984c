// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace ego {

/// How a C3D file writes numbers; the values are those of the file (C3D User Guide, "Parameter
/// section header").
enum class C3dProcessor : std::uint8_t { kIntel = 84, kDec = 85, kSgi = 86 };

/// Numbers of a C3D file at a byte offset. The caller has checked that they lie inside.
class C3dBytes {
 public:
  C3dBytes(std::span<const std::uint8_t> bytes, C3dProcessor processor)
      : bytes_(bytes), processor_(processor) {}

  std::size_t size() const { return bytes_.size(); }
  /// True when `count` bytes from `offset` on lie inside the file.
  bool Has(std::size_t offset, std::size_t count) const {
    return offset <= bytes_.size() && count <= bytes_.size() - offset;
  }
  std::uint8_t Byte(std::size_t offset) const { return bytes_[offset]; }
  std::uint16_t Unsigned(std::size_t offset) const;
  std::int16_t Integer(std::size_t offset) const;
  /// IEEE single (Intel, SGI) or VAX F format (DEC).
  double Float(std::size_t offset) const;
  std::string_view Text(std::size_t offset, std::size_t count) const {
    return {reinterpret_cast<const char*>(bytes_.data()) + offset, count};
  }

 private:
  std::span<const std::uint8_t> bytes_;
  C3dProcessor processor_;
};

/// The parameter section of a C3D file, read by group and name (both upper case).
class C3dParameters {
 public:
  /// Finds and reads the section. Order of groups and parameters does not matter; what lies
  /// outside the file ends the section. Errors (without the file's name): no section is found.
  static Result<C3dParameters> Read(std::span<const std::uint8_t> file);

  C3dProcessor processor() const { return processor_; }
  /// Byte offset of the section.
  std::size_t start() const { return start_; }

  bool Has(std::string_view group, std::string_view name) const {
    return Find(group, name) != nullptr;
  }
  /// The index-th number; 16-bit integers are taken as unsigned, as frame counts mean them.
  std::optional<double> Count(std::string_view group, std::string_view name,
                              std::size_t index = 0) const;
  /// The first number, signed; nothing when it is absent or not finite.
  std::optional<double> Number(std::string_view group, std::string_view name) const;
  /// Texts of a character array, blanks at their ends removed; empty when absent.
  std::vector<std::string> Texts(std::string_view group, std::string_view name) const;
  /// Texts of NAME, NAME2, NAME3, ...: how lists of more than 255 go on.
  std::vector<std::string> LongTexts(std::string_view group, std::string_view name) const;

 private:
  struct Parameter {
    int group = 0;
    std::string name;
    int type = 0;  // -1 text, 1 byte, 2 integer, 4 float
    std::vector<std::uint8_t> dimensions;
    std::size_t offset = 0;
    std::size_t count = 0;  // elements
  };
  struct Group {
    int id = 0;
    std::string name;
  };

  explicit C3dParameters(C3dBytes bytes) : bytes_(bytes) {}
  const Parameter* Find(std::string_view group, std::string_view name) const;
  std::optional<double> Value(const Parameter& parameter, std::size_t index, bool is_signed) const;

  C3dBytes bytes_;
  C3dProcessor processor_ = C3dProcessor::kIntel;
  std::size_t start_ = 0;
  std::vector<Group> groups_;
  std::vector<Parameter> parameters_;
};

}  // namespace ego
