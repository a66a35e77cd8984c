// SPDX-License-Identifier: MIT
#include "tests/support/character_laws.h"

#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "core/skeleton/pose.h"
#include "tests/support/sentence_law.h"

namespace ego::test {
namespace {

bool IsFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool IsFinite(const Mat4& m) {
  return IsFinite(Vec3(m[0])) && IsFinite(Vec3(m[1])) && IsFinite(Vec3(m[2])) &&
         IsFinite(Vec3(m[3]));
}

/// -1 or an index into `size` things.
bool IsNoneOrIn(int index, std::size_t size) {
  return index >= -1 && index < static_cast<int>(size);
}

void CheckPart(const MeshPart& part, const Character& character) {
  const std::size_t count = part.positions.size();
  EGO_CHECK(IsNoneOrIn(part.material, character.materials.size()));
  EGO_CHECK(!part.triangles.empty() && part.triangles.size() % 3 == 0);
  EGO_CHECK(part.normals.size() == count && part.influences.size() == count);
  EGO_CHECK(part.uvs.empty() || part.uvs.size() == count);
  for (const std::uint32_t corner : part.triangles) EGO_CHECK(corner < count);
  for (std::size_t v = 0; v < count; ++v) {
    EGO_CHECK(IsFinite(Vec3(part.positions[v])));
    EGO_CHECK(std::abs(glm::length(part.normals[v]) - 1.0f) < 1e-3f);
    float sum = 0.0f;
    for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
      EGO_CHECK(part.influences[v].entry[k] < character.palette.size());
      EGO_CHECK(part.influences[v].weight[k] >= 0.0f);
      sum += part.influences[v].weight[k];
    }
    EGO_CHECK(std::abs(sum - 1.0f) < 1e-3f);
  }
}

}  // namespace

void CheckCharacter(const Result<Character>& character, std::string_view file) {
  if (!character) return CheckSentence(character.error(), file);
  const std::size_t nodes = character->nodes.joints.size();
  EGO_CHECK(nodes > 0 && !character->parts.empty());
  for (std::size_t n = 0; n < nodes; ++n) {
    EGO_CHECK(character->nodes.joints[n].parent >= -1);
    EGO_CHECK(character->nodes.joints[n].parent < static_cast<int>(n));
    EGO_CHECK(IsFinite(character->nodes.joints[n].rest_local));
  }
  for (const PaletteEntry& entry : character->palette) {
    EGO_CHECK(entry.node >= 0 && entry.node < static_cast<int>(nodes));
    EGO_CHECK(IsFinite(entry.inverse_bind));
  }
  for (const Material& material : character->materials) {
    EGO_CHECK(IsNoneOrIn(material.base_color_image, character->images.size()));
  }
  for (const Image& image : character->images) {
    EGO_CHECK(image.width >= 0 && image.height >= 0);
    EGO_CHECK(image.rgba.size() ==
              4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  }
  for (const MeshPart& part : character->parts) CheckPart(part, *character);
  for (const std::string& note : character->notes) {
    EGO_CHECK(!note.empty() && note.find('\n') == std::string::npos);
  }

  const Rig& rig = character->rig;
  EGO_CHECK(rig.driver.size() == nodes && rig.canonical_global.size() == nodes);
  EGO_CHECK(std::isfinite(rig.metres_per_unit) && rig.metres_per_unit > 0.0);
  for (const int node : rig.node) EGO_CHECK(IsNoneOrIn(node, nodes));
  std::vector<Mat4> posed(nodes);
  PoseNodes(rig, ForwardKinematics(rig.skeleton, CanonicalPose(rig.skeleton)), posed);
  for (const Mat4& matrix : posed) EGO_CHECK(IsFinite(matrix));
}

}  // namespace ego::test
