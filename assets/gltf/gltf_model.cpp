// SPDX-License-Identifier: MIT
#include "assets/gltf/gltf_model.h"

#include <algorithm>
#include <exception>

#include <tiny_gltf.h>

namespace ego {
namespace {

std::size_t Big(const unsigned char* at, int bytes) {
  std::size_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | at[i];
  return value;
}

/// Pixels that a PNG or JPEG header promises; 0 for anything else. A few bytes must not make the
/// decoder ask for gigabytes.
std::size_t PixelsPromised(const unsigned char* bytes, std::size_t size) {
  if (size > 24 && bytes[0] == 0x89 && bytes[1] == 'P') {
    return Big(bytes + 16, 4) * Big(bytes + 20, 4);
  }
  if (size < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return 0;
  for (std::size_t at = 2; at + 9 < size;) {
    if (bytes[at] != 0xFF) return 0;
    const unsigned char marker = bytes[at + 1];
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) return Big(bytes + at + 5, 2) * Big(bytes + at + 7, 2);
    at += marker == 0xFF ? 1 : 2 + std::max<std::size_t>(2, Big(bytes + at + 2, 2));
  }
  return 0;
}

/// Decodes where it can and never fails: a texture less is no reason to refuse a character.
bool LoadImage(tinygltf::Image* image, int index, std::string* error, std::string* warning,
               int width, int height, const unsigned char* bytes, int size, void* user) {
  constexpr std::size_t kMaxPixels = std::size_t{1} << 26;
  const std::size_t pixels =
      size > 0 ? PixelsPromised(bytes, static_cast<std::size_t>(size)) : std::size_t{0};
  std::string ignored;
  if (pixels == 0 || pixels > kMaxPixels ||
      !tinygltf::LoadImageData(image, index, &ignored, warning, width, height, bytes, size, user)) {
    image->width = image->height = 0;
    image->image.clear();
  }
  static_cast<void>(error);
  return true;
}

}  // namespace

void DeleteModel::operator()(tinygltf::Model* model) const { delete model; }

Result<ModelPtr> ParseModel(const GltfDocument& document) {
  ModelPtr model(new tinygltf::Model);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(&LoadImage, nullptr);
  // The document holds everything; no path in it is followed.
  tinygltf::FsCallbacks no_files{};
  no_files.FileExists = [](const std::string&, void*) { return false; };
  no_files.ExpandFilePath = [](const std::string& path, void*) { return path; };
  no_files.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                              void*) { return false; };
  no_files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                               void*) { return false; };
  loader.SetFsCallbacks(no_files);
  const std::vector<std::uint8_t> glb = PackGlb(document.json, document.bin);
  std::string error;
  std::string warning;
  try {
    if (loader.LoadBinaryFromMemory(model.get(), &error, &warning, glb.data(),
                                    static_cast<unsigned int>(glb.size()), "")) {
      return model;
    }
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  for (char& c : error) {
    if (c == '\n') c = ' ';
  }
  while (!error.empty() && (error.back() == ' ' || error.back() == '.')) error.pop_back();
  return Error{document.name + ": it is no valid glTF 2.0: " +
               (error.empty() ? "its JSON could not be read" : error.substr(0, 300))};
}

}  // namespace ego
