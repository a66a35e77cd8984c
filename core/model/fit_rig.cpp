// SPDX-License-Identifier: MIT
#include "core/model/fit_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

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

}  // namespace

Result<void> FitRig(Character& character, std::optional<double> metres_per_unit) {
  const std::vector<Mat4> rest = character.nodes.RestGlobal();
  auto aligned = AlignRestPose(character.nodes, rest, character.map, metres_per_unit.value_or(1.0));
  if (!aligned) return Error{aligned.error()};
  if (!metres_per_unit) {
    const double height = CanonicalPositions(aligned->skeleton)[Index(J::kHead)].y;
    const double scale = MetresPerUnit(height, character.notes);
    if (scale != 1.0) aligned = AlignRestPose(character.nodes, rest, character.map, scale);
    if (!aligned) return Error{aligned.error()};
  }
  const std::vector<bool> moves = NodesWithWeight(character);
  character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  if (LevelFeet(character, *aligned)) {
    character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  }
  if (const auto sole = LowestSole(character)) {
    aligned->MoveGround(*sole);
    character.rig = BuildRig(character.nodes, rest, character.map, *aligned, moves);
  }
  return {};
}

}  // namespace ego
