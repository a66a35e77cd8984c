// SPDX-License-Identifier: MIT
#include "tests/support/c3d_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ego::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Order = C3dFile::Order;

void PutWord(Bytes& out, Order order, std::uint32_t word) {
  const auto low = static_cast<std::uint8_t>(word & 0xFF);
  const auto high = static_cast<std::uint8_t>(word >> 8 & 0xFF);
  out.push_back(order == Order::kSgi ? high : low);
  out.push_back(order == Order::kSgi ? low : high);
}

void PutFloat(Bytes& out, Order order, double value) {
  if (order == Order::kDec && std::isfinite(value)) {
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(value), &exponent);  // 0.5 <= m < 1
    std::uint32_t bits = 0;
    if (value != 0.0) {
      const auto fraction = static_cast<std::uint32_t>(std::lround((mantissa - 0.5) * 16777216.0));
      bits = (static_cast<std::uint32_t>(exponent + 128) << 23) + fraction;
      if (value < 0.0) bits |= 0x80000000u;
    }
    PutWord(out, order, bits >> 16);
    PutWord(out, order, bits & 0xFFFF);
    return;
  }
  const auto single = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  for (int byte = 0; byte < 4; ++byte) {
    const int shift = order == Order::kSgi ? 24 - 8 * byte : 8 * byte;
    out.push_back(static_cast<std::uint8_t>(bits >> shift & 0xFF));
  }
}

struct Section {
  Order order;
  bool locked;
  Bytes groups;
  Bytes parameters;

  void PutName(Bytes& out, int id, const std::string& name) const {
    const int length = static_cast<int>(name.size());
    out.push_back(static_cast<std::uint8_t>(locked ? -length : length));
    out.push_back(static_cast<std::uint8_t>(id));
    out.insert(out.end(), name.begin(), name.end());
  }
  void Group(int id, const std::string& name) {
    PutName(groups, -id, name);
    PutWord(groups, order, 3);  // the pointer's own two bytes and one of description
    groups.push_back(0);
  }
  void Parameter(int id, const std::string& name, int type, const std::vector<std::size_t>& dims,
                 const Bytes& data) {
    PutName(parameters, id, name);
    const std::size_t body = 2 + 1 + 1 + dims.size() + data.size() + 1;
    PutWord(parameters, order, static_cast<std::uint32_t>(body));
    parameters.push_back(static_cast<std::uint8_t>(type));
    parameters.push_back(static_cast<std::uint8_t>(dims.size()));
    for (const std::size_t d : dims) parameters.push_back(static_cast<std::uint8_t>(d));
    parameters.insert(parameters.end(), data.begin(), data.end());
    parameters.push_back(0);
  }
  void Word(int id, const std::string& name, std::size_t value) {
    Bytes data;
    PutWord(data, order, static_cast<std::uint32_t>(value));
    Parameter(id, name, 2, {}, data);
  }
  void Float(int id, const std::string& name, double value) {
    Bytes data;
    PutFloat(data, order, value);
    Parameter(id, name, 4, {}, data);
  }
  void Text(int id, const std::string& name, const std::string& text) {
    Parameter(id, name, -1, {text.size()}, Bytes(text.begin(), text.end()));
  }
  void Texts(int id, const std::string& name, const std::vector<std::string>& texts) {
    for (std::size_t part = 0; part * 255 < std::max<std::size_t>(1, texts.size()); ++part) {
      const std::size_t begin = part * 255;
      const std::size_t count = std::min<std::size_t>(255, texts.size() - begin);
      std::size_t width = 1;
      for (const std::string& text : texts) width = std::max(width, text.size());
      Bytes data;
      for (std::size_t i = begin; i < begin + count; ++i) {
        std::string padded = texts[i];
        padded.resize(width, ' ');
        data.insert(data.end(), padded.begin(), padded.end());
      }
      const std::string full = part == 0 ? name : name + std::to_string(part + 1);
      Parameter(id, full, -1, {width, count}, data);
    }
  }
};

}  // namespace

std::vector<std::uint8_t> WriteC3d(const C3dFile& file) {
  const Order order = file.order;
  const double scale = file.integers ? file.scale : -file.scale;
  const std::size_t frames = file.declared_frames != 0 ? file.declared_frames : file.frames.size();
  const std::size_t last_frame = file.first_frame + frames - 1;

  Section section{order, file.locked_names, {}, {}};
  section.Group(1, "POINT");
  section.Group(2, "TRIAL");
  section.Word(1, "USED", file.labels.size());
  section.Word(1, "FRAMES", std::min<std::size_t>(frames, 65535));
  section.Float(1, "SCALE", scale);
  section.Float(1, "RATE", file.rate_hz);
  if (!file.unit.empty()) section.Text(1, "UNITS", file.unit);
  if (!file.y_screen.empty()) section.Text(1, "Y_SCREEN", file.y_screen);
  section.Texts(1, "LABELS", file.labels);
  for (const auto& [name, texts] : file.lists) section.Texts(1, name, texts);
  if (file.write_trial_fields) {
    for (const auto& [name, frame] : {std::pair{"ACTUAL_START_FIELD", file.first_frame},
                                      std::pair{"ACTUAL_END_FIELD", last_frame}}) {
      Bytes data;
      PutWord(data, order, static_cast<std::uint32_t>(frame & 0xFFFF));
      PutWord(data, order, static_cast<std::uint32_t>(frame >> 16));
      section.Parameter(2, name, 2, {2}, data);
    }
  }
  Bytes body = file.groups_last ? section.parameters : section.groups;
  const Bytes& rest = file.groups_last ? section.groups : section.parameters;
  body.insert(body.end(), rest.begin(), rest.end());
  body.resize(body.size() + 4, 0);
  const std::size_t blocks = (4 + body.size() + 511) / 512;

  Bytes out;
  out.push_back(file.parameter_block);
  out.push_back(0x50);
  PutWord(out, order, static_cast<std::uint32_t>(file.labels.size()));
  PutWord(out, order, static_cast<std::uint32_t>(file.analog_per_frame));
  PutWord(out, order, static_cast<std::uint32_t>(std::min<std::size_t>(file.first_frame, 65535)));
  PutWord(out, order, static_cast<std::uint32_t>(std::min<std::size_t>(last_frame, 65535)));
  PutWord(out, order, 10);  // largest gap
  PutFloat(out, order, scale);
  PutWord(out, order, static_cast<std::uint32_t>(2 + blocks));
  PutWord(out, order, file.analog_per_frame == 0 ? 0 : 1);
  PutFloat(out, order, file.rate_hz);
  out.resize(512, 0);
  out.push_back(1);
  out.push_back(0x50);
  out.push_back(static_cast<std::uint8_t>(blocks));
  out.push_back(order == Order::kIntel ? 84 : order == Order::kDec ? 85 : 86);
  out.insert(out.end(), body.begin(), body.end());
  out.resize(512 * (1 + blocks), 0);

  for (const std::vector<C3dFile::Point>& frame : file.frames) {
    for (const C3dFile::Point& p : frame) {
      for (const double value : {p.x, p.y, p.z}) {
        if (file.integers) {
          const auto step = static_cast<std::int16_t>(std::lround(value / file.scale));
          PutWord(out, order, static_cast<std::uint16_t>(step));
        } else {
          PutFloat(out, order, value);
        }
      }
      if (file.integers) {
        PutWord(out, order, p.residual < 0.0 ? 0xFFFFu : 0x0301u);
      } else {
        PutFloat(out, order, p.residual);
      }
    }
    for (std::size_t a = 0; a < file.analog_per_frame; ++a) {
      if (file.integers) {
        PutWord(out, order, 0x7FFF);
      } else {
        PutFloat(out, order, 12345.0);
      }
    }
  }
  out.resize((out.size() + 511) / 512 * 512, 0);
  return out;
}

}  // namespace ego::test
