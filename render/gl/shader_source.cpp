// SPDX-License-Identifier: MIT
#include "render/gl/shader_source.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace ego::gl {
namespace {

constexpr int kMaxDepth = 8;

const ShaderFile* Find(std::string_view name, std::span<const ShaderFile> files) {
  const auto it =
      std::find_if(files.begin(), files.end(), [&](const ShaderFile& f) { return f.name == name; });
  return it == files.end() ? nullptr : &*it;
}

Result<void> Append(const ShaderFile& file, std::span<const ShaderFile> files, int depth,
                    ShaderSource& out) {
  int line = 1;
  for (std::string_view rest = file.text; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!text.starts_with("#include \"")) {
      out.text.append(text).push_back('\n');
      out.places.push_back({file.name, line});
      continue;
    }
    const std::string_view name = text.substr(10, text.find('"', 10) - 10);
    const ShaderFile* included = Find(name, files);
    if (included == nullptr || depth >= kMaxDepth) {
      return Error{"shaders/" + std::string(file.name) + ":" + std::to_string(line) +
                   ": cannot include \"" + std::string(name) + "\"."};
    }
    if (Result<void> ok = Append(*included, files, depth + 1, out); !ok) return ok;
  }
  return {};
}

std::size_t Digits(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && std::isdigit(static_cast<unsigned char>(text[n])) != 0) ++n;
  return n <= 6 ? n : 0;
}

/// "0:12(3): error: x" and "0(12) : error: x" become "shaders/a.frag:9: error: x".
std::string ReadableLine(std::string_view line, const ShaderSource& source) {
  const std::size_t a = Digits(line);
  if (a == 0 || a >= line.size() || (line[a] != ':' && line[a] != '(')) return std::string(line);
  const std::size_t b = Digits(line.substr(a + 1));
  if (b == 0) return std::string(line);
  const std::size_t number = std::stoul(std::string(line.substr(a + 1, b)));
  if (number == 0 || number > source.places.size() || source.places[number - 1].line == 0) {
    return std::string(line);
  }
  const ShaderSource::Place& place = source.places[number - 1];
  std::string_view rest = line.substr(a + 1 + b);
  if (!rest.empty() && (rest[0] == '(' || rest[0] == ')')) {
    rest.remove_prefix(std::min(rest.find(')') + 1, rest.size()));
  }
  while (!rest.empty() && (rest[0] == ' ' || rest[0] == ':')) rest.remove_prefix(1);
  return "shaders/" + std::string(place.file) + ":" + std::to_string(place.line) + ": " +
         std::string(rest);
}

}  // namespace

Result<ShaderSource> LoadShader(std::string_view name, std::span<const std::string_view> defines,
                                std::span<const ShaderFile> files) {
  const ShaderFile* file = Find(name, files);
  if (file == nullptr) return Error{"shaders/" + std::string(name) + ": no such shader."};
  ShaderSource source;
  source.text = "#version 330 core\n";
  source.places.emplace_back();
  for (const std::string_view define : defines) {
    source.places.emplace_back();
    source.text += "#define " + std::string(define) + " 1\n";
  }
  if (Result<void> ok = Append(*file, files, 0, source); !ok) return Error{ok.error()};
  return source;
}

std::string ReadableLog(std::string_view log, const ShaderSource& source) {
  std::string out;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    const std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    if (line.empty() || line[0] == '\0') continue;
    if (!out.empty()) out += "\n";
    out += ReadableLine(line, source);
  }
  return out;
}

}  // namespace ego::gl
