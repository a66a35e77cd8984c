// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <optional>

#include <tiny_gltf.h>

#include "assets/files/file_io.h"
#include "assets/gltf/character_file.h"
#include "assets/gltf/gltf_document.h"
#include "assets/gltf/gltf_model.h"
#include "assets/gltf/scene_reader.h"
#include "core/model/sole.h"
#include "core/skeleton/rest_alignment.h"

namespace ego {
namespace {

using J = HumanoidJoint;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

/// Nodes that move a vertex.
std::vector<bool> NodesWithWeight(const Character& character) {
  std::vector<bool> moves(character.nodes.joints.size(), false);
  for (const MeshPart& part : character.parts) {
    for (const MeshPart::Influences& influences : part.influences) {
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (influences.weight[k] > 0.0f) {
          moves[At(character.palette[influences.entry[k]].node)] = true;
        }
      }
    }
  }
  return moves;
}

/// Height of the lowest vertex in the canonical pose among those that feet and toes carry (else
/// the shins, else all).
std::optional<double> LowestSole(const Character& character) {
  std::vector<Mat4> placed;
  for (const PaletteEntry& entry : character.palette) {
    placed.push_back(character.rig.canonical_global[At(entry.node)] * entry.inverse_bind);
  }
  std::array<double, 3> lowest;
  lowest.fill(std::numeric_limits<double>::infinity());
  for (const MeshPart& part : character.parts) {
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      const MeshPart::Influences& influences = part.influences[v];
      Vec4 at(0.0);
      std::size_t strongest = 0;
      for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
        if (influences.weight[k] == 0.0f) continue;
        at += static_cast<double>(influences.weight[k]) *
              (placed[influences.entry[k]] * Vec4(Vec3(part.positions[v]), 1.0));
        if (influences.weight[k] > influences.weight[strongest]) strongest = k;
      }
      const J driver =
          character.rig.driver[At(character.palette[influences.entry[strongest]].node)];
      const bool foot = driver == J::kLeftFoot || driver == J::kRightFoot ||
                        driver == J::kLeftToes || driver == J::kRightToes;
      const bool shin = driver == J::kLeftLowerLeg || driver == J::kRightLowerLeg;
      if (foot) lowest[0] = std::min(lowest[0], at.y);
      if (foot || shin) lowest[1] = std::min(lowest[1], at.y);
      lowest[2] = std::min(lowest[2], at.y);
    }
  }
  for (const double y : lowest) {
    if (std::isfinite(y)) return y;
  }
  return {};
}

/// How the file's unit is read, from the body's height in it: glTF means metres, and creatures
/// from a hand to a house high stay as they are.
double MetresPerUnit(double height, std::vector<std::string>& notes) {
  constexpr double kSmallest = 0.1;
  constexpr double kLargest = 25.0;
  if (height >= kSmallest && height <= kLargest) return 1.0;
  double scale = 1.0;
  while (height * scale > kLargest && scale > 1e-9) scale *= 0.1;
  while (height * scale < kSmallest && scale < 1e9) scale *= 10.0;
  // The usual slips are factors of 100 (centimetres) and 1000 (millimetres).
  if (height > kLargest) {
    scale = height <= 500.0 ? 0.01 : height <= 5000.0 ? 0.001 : scale;
  } else {
    scale = height >= 0.005 ? 100.0 : scale;
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "the body is %.4g units high in the file: read as %.4g metres per unit", height,
                scale);
  notes.emplace_back(text);
  return scale;
}

/// Levels feet whose soles slope far more than modelling leaves to chance, because the rest pose
/// is no standing one; a slight slope may be meant. Says whether any was.
bool LevelFeet(const Character& character, Alignment& alignment) {
  bool levelled = false;
  for (const bool left : {true, false}) {
    if (character.map.Node(left ? J::kLeftFoot : J::kRightFoot) < 0) continue;
    const double slope = SoleSlope(character, left).value_or(0.0);
    const double t = std::clamp((std::abs(Degrees(slope)) - 6.0) / 6.0, 0.0, 1.0);
    if (t == 0.0) continue;
    alignment.RaiseToes(left, t * t * (3.0 - 2.0 * t) * slope);
    levelled = true;
  }
  return levelled;
}

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
  const std::vector<Mat4> rest = character.nodes.RestGlobal();
  auto aligned = AlignRestPose(character.nodes, rest, character.map);
  if (!aligned) return Error{aligned.error()};
  const double height = CanonicalPositions(aligned->skeleton)[Index(J::kHead)].y;
  const double scale = MetresPerUnit(height, character.notes);
  if (scale != 1.0) aligned = AlignRestPose(character.nodes, rest, character.map, scale);
  if (!aligned) return Error{aligned.error()};
  const std::vector<bool> moves = NodesWithWeight(character);
  character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  if (LevelFeet(character, *aligned)) {
    character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  }
  if (const auto sole = LowestSole(character)) {
    aligned->MoveGround(*sole);
    character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  }
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
