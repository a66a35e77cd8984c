// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <optional>

#include <tiny_gltf.h>

#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"
#include "assets/gltf/gltf_document.h"
#include "assets/gltf/gltf_model.h"
#include "assets/gltf/scene_reader.h"
#include "core/model/fit_rig.h"

namespace ego {
namespace {

Result<void> FitHumanoid(const tinygltf::Model& model, const SceneSkeleton& skeleton,
                         Character& character) {
  auto hints = ReadVrmHints(model, skeleton.order);
  if (!hints) return Error{hints.error()};
  const bool skinned = std::find(skeleton.is_skin_joint.begin(), skeleton.is_skin_joint.end(),
                                 true) != skeleton.is_skin_joint.end();
  if (skinned) hints->deforms = skeleton.is_skin_joint;
  auto map = MapHumanoid(character.nodes, *hints);
  if (!map) return Error{map.error()};
  character.map = *std::move(map);
  if (auto fitted = FitRig(character); !fitted) return Error{fitted.error()};
  character.notes.insert(character.notes.end(), character.map.notes.begin(),
                         character.map.notes.end());
  return {};
}

/// A message that may hold names from the file, on one line and of bearable length.
std::string OneLine(std::string text) {
  constexpr std::size_t kLongest = 500;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

Result<Character> Read(std::span<const std::uint8_t> bytes, std::string_view name,
                       const std::optional<std::filesystem::path>& folder,
                       const Progress& progress) {
  const std::string prefix = std::string(name) + ": ";
  const auto cancelled = [&](double fraction, std::string_view what) {
    return !Report(progress, fraction, what);
  };
  try {
    if (cancelled(0.0, "opening the file")) return Error{"cancelled"};
    auto document = OpenGltf(bytes, name, folder);
    if (!document) return Error{document.error()};
    auto model = ParseModel(*document);
    if (!model) return Error{model.error()};
    if (cancelled(0.2, "reading the skeleton")) return Error{"cancelled"};
    auto skeleton = ReadSkeleton(**model);
    if (!skeleton) return Error{prefix + skeleton.error()};

    Character character;
    character.name = std::filesystem::path(name).stem().string();
    character.nodes = skeleton->tree;
    character.notes = document->notes;
    if (auto read = ReadMaterials(**model, character); !read) return Error{prefix + read.error()};
    if (auto read = ReadMeshes(**model, *skeleton, character, progress); !read) {
      return Error{read.error() == "cancelled" ? read.error() : prefix + read.error()};
    }
    if (cancelled(0.75, "finding the humanoid")) return Error{"cancelled"};
    if (auto fit = FitHumanoid(**model, *skeleton, character); !fit) {
      return Error{prefix + fit.error()};
    }
    for (std::string& note : character.notes) note = OneLine(std::move(note));
    if (cancelled(1.0, "done")) return Error{"cancelled"};
    return character;
  } catch (const std::bad_alloc&) {
    return Error{prefix + "it needs more memory than there is"};
  }
}

}  // namespace

Result<Character> ReadCharacter(const std::filesystem::path& path, const Progress& progress) {
  auto bytes = ReadFile(path);
  if (!bytes) return Error{bytes.error()};
  auto character = Read(*bytes, path.filename().string(), path.parent_path(), progress);
  if (!character) return Error{OneLine(character.error())};
  character->source_path = path.string();
  return character;
}

Result<Character> ParseCharacter(std::span<const std::uint8_t> bytes, std::string_view name,
                                 const Progress& progress) {
  auto character = Read(bytes, name, {}, progress);
  if (!character) return Error{OneLine(character.error())};
  return character;
}

}  // namespace ego
