// SPDX-License-Identifier: MIT
#include "assets/gltf/gltf_model.h"

#include <exception>

#include <tiny_gltf.h>

#include "assets/gltf/glb_container.h"

namespace ego {
namespace {

/// Keeps an image's bytes as the file has them: only those that are drawn are decoded, later, and
/// a texture less is no reason to refuse a character.
bool KeepImage(tinygltf::Image* image, int, std::string*, std::string*, int, int,
               const unsigned char* bytes, int size, void*) {
  if (size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

}  // namespace

void DeleteModel::operator()(tinygltf::Model* model) const { delete model; }

Result<ModelPtr> ParseModel(const GltfDocument& document) {
  ModelPtr model(new tinygltf::Model);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(&KeepImage, nullptr);
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
