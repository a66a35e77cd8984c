// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ego::test {

/// A C3D file to be written, as the C3D User Guide describes the format. Shares no code with the
/// reader.
struct C3dFile {
  enum class Order : std::uint8_t { kIntel, kDec, kSgi };
  struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double residual = 0.0;  // negative: not measured
  };

  Order order = Order::kIntel;
  bool integers = false;
  double scale = 0.1;  // file units per integer step; written negative for floats
  double rate_hz = 100.0;
  std::string unit = "mm";
  std::string y_screen;  // written when not empty
  std::vector<std::string> labels;
  std::vector<std::vector<Point>> frames;  // file units
  /// Further lists of the POINT group ("ANGLES", ...), TYPE_GROUPS among them.
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;
  std::size_t analog_per_frame = 0;  // numbers written behind the points of each frame
  std::size_t first_frame = 1;

  // Quirks.
  bool groups_last = false;          // parameters before the groups they belong to
  bool locked_names = false;         // negative name lengths
  std::uint8_t parameter_block = 2;  // what byte 1 says; the section is always in block 2
  bool write_trial_fields = false;   // TRIAL:ACTUAL_START_FIELD and END_FIELD
  std::size_t declared_frames = 0;   // 0: as many as there are
};

std::vector<std::uint8_t> WriteC3d(const C3dFile& file);

}  // namespace ego::test
