// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "assets/calibration/calibration_file.h"
#include "core/base/check.h"
#include "core/model/avatar_body.h"

namespace {

/// One joint, one triangle: enough for every branch of the reader.
ego::Character SmallCharacter() {
  ego::Character character;
  character.name = "triangle";
  character.nodes.joints.emplace_back();
  character.palette.emplace_back();
  ego::MeshPart& part = character.parts.emplace_back();
  part.positions = {{0.0f, 1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {0.0f, 2.0f, 0.0f}};
  part.normals.resize(3, {0.0f, 0.0f, 1.0f});
  part.influences.resize(3);
  for (auto& influences : part.influences) influences.weight[0] = 1.0f;
  part.triangles = {0, 1, 2};
  character.rig.node.fill(-1);
  character.rig.driver = {ego::HumanoidJoint::kHips};
  character.rig.canonical_global = {ego::Mat4{1.0}};
  for (std::size_t j = 0; j < ego::kJointCount; ++j) {
    character.rig.skeleton.offset[j] = {0.0, 0.1, 0.0};
  }
  return character;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ego::Character character = SmallCharacter();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto loaded = ego::ParseCalibration(text, "fuzz", character);
  if (!loaded) {
    EGO_CHECK(!loaded.error().empty());
    return 0;
  }
  // What is accepted must be usable, and must come back from its own text.
  const ego::Body body = ego::MakeAvatarBody(character, loaded->calibration);
  EGO_CHECK(body.height == body.height);
  EGO_CHECK(static_cast<bool>(ego::ParseCalibration(
      ego::FormatCalibration(character, loaded->calibration), "again", character)));
  return 0;
}
