// SPDX-License-Identifier: MIT
#include "assets/gltf/gltf_uri.h"

#include <algorithm>

namespace ego {
namespace {

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string PercentDecoded(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && HexDigit(uri[i + 1]) >= 0 &&
        HexDigit(uri[i + 2]) >= 0) {
      out.push_back(static_cast<char>(HexDigit(uri[i + 1]) * 16 + HexDigit(uri[i + 2])));
      i += 2;
    } else {
      out.push_back(uri[i]);
    }
  }
  return out;
}

}  // namespace

std::vector<std::uint8_t> Base64(std::string_view text) {
  std::vector<std::uint8_t> out;
  out.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    std::uint32_t value = 0;
    if (c >= 'A' && c <= 'Z') {
      value = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      value = static_cast<std::uint32_t>(c - 'a' + 26);
    } else if (c >= '0' && c <= '9') {
      value = static_cast<std::uint32_t>(c - '0' + 52);
    } else if (c == '+' || c == '-') {
      value = 62;
    } else if (c == '/' || c == '_') {
      value = 63;
    } else {
      continue;
    }
    bits = bits << 6 | value;
    have += 6;
    if (have >= 8) {
      have -= 8;
      out.push_back(static_cast<std::uint8_t>(bits >> have & 0xFFu));
    }
  }
  return out;
}

Result<std::filesystem::path> PathBeside(const std::string& uri,
                                         const std::optional<std::filesystem::path>& folder) {
  const std::string decoded = PercentDecoded(uri);
  const std::filesystem::path path(decoded);
  const bool climbs =
      std::any_of(path.begin(), path.end(), [](const auto& p) { return p == ".."; });
  if (decoded.empty() || path.is_absolute() || climbs ||
      decoded.find_first_of(":\\") != std::string::npos ||
      decoded.find('\0') != std::string::npos) {
    return Error{"it refers to '" + uri.substr(0, 120) +
                 "'; only files beside it, without '..' or an absolute path, are read"};
  }
  if (!folder)
    return Error{"it refers to the file '" + decoded.substr(0, 120) + "', and no folder is known"};
  return *folder / path;
}

}  // namespace ego
