// SPDX-License-Identifier: MIT
#include "assets/gltf/glb_container.h"

namespace ego {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinChunk = 0x004E4942;

std::uint32_t Word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

std::string_view AsText(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void AppendWord(std::vector<std::uint8_t>& out, std::size_t value) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xFFu));
}

}  // namespace

Result<GltfChunks> SplitGlb(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || Word(bytes, 0) != kGlbMagic) {
    const std::string_view text = AsText(bytes);
    const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (begin == std::string_view::npos || text[begin] != '{') {
      return Error{"neither a GLB header nor JSON at its beginning; expected a glTF 2.0 file"};
    }
    return GltfChunks{text.substr(begin), {}, false};
  }
  if (bytes.size() < 20) return Error{"the GLB header is truncated"};
  if (Word(bytes, 4) != 2) {
    return Error{"GLB version " + std::to_string(Word(bytes, 4)) + "; expected 2"};
  }
  if (Word(bytes, 8) > bytes.size()) {
    return Error{"truncated: the GLB header says " + std::to_string(Word(bytes, 8)) +
                 " bytes, the file has " + std::to_string(bytes.size())};
  }
  GltfChunks chunks;
  std::size_t at = 12;
  const std::size_t end = Word(bytes, 8);
  while (at + 8 <= end) {
    const std::size_t length = Word(bytes, at);
    const std::uint32_t kind = Word(bytes, at + 4);
    at += 8;
    if (length > end - at) return Error{"truncated: a GLB chunk runs past the end of the file"};
    if (kind == kJsonChunk && chunks.json.empty()) {
      chunks.json = AsText(bytes.subspan(at, length));
    } else if (kind == kBinChunk && !chunks.has_bin) {
      chunks.bin = bytes.subspan(at, length);
      chunks.has_bin = true;
    }
    at += length;
  }
  if (chunks.json.empty()) return Error{"the GLB has no JSON chunk"};
  return chunks;
}

std::vector<std::uint8_t> PackGlb(std::string_view json, std::span<const std::uint8_t> bin) {
  const std::size_t json_size = (json.size() + 3) / 4 * 4;
  const std::size_t bin_size = (bin.size() + 3) / 4 * 4;
  std::vector<std::uint8_t> out;
  out.reserve(28 + json_size + bin_size);
  AppendWord(out, kGlbMagic);
  AppendWord(out, 2);
  AppendWord(out, 20 + json_size + (bin.empty() ? 0 : 8 + bin_size));
  AppendWord(out, json_size);
  AppendWord(out, kJsonChunk);
  out.insert(out.end(), json.begin(), json.end());
  out.resize(20 + json_size, ' ');
  if (!bin.empty()) {
    AppendWord(out, bin_size);
    AppendWord(out, kBinChunk);
    out.insert(out.end(), bin.begin(), bin.end());
    out.resize(28 + json_size + bin_size, 0);
  }
  return out;
}

}  // namespace ego
