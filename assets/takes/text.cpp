// SPDX-License-Identifier: MIT
#include "assets/takes/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "assets/files/shown_text.h"

namespace ego {
std::string TakeName(std::string_view file) {
  return CleanText(std::filesystem::path(std::string(file)).stem().string());
}

std::optional<double> ReadNumber(std::string_view text) {
  text = Trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  // A number too small for a double is zero, one too large is refused with the malformed ones.
  if (code == std::errc::result_out_of_range && end == text.data() + text.size()) {
    const bool tiny =
        text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool SameWord(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) ==
                  std::tolower(static_cast<unsigned char>(y));
         });
}

}  // namespace ego
