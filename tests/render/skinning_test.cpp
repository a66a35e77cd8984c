// SPDX-License-Identifier: MIT
#include "render/skinning.h"

#include <random>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "render/shadow_mesh.h"
#include "render/triangle_sink.h"

namespace ego {
namespace {

/// A cloud of vertices, each on eight joints with weights of its own, in centimetres.
Character EightInfluences() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Character character;
  for (int j = 0; j < 11; ++j) {
    character.nodes.joints.push_back({"joint", j - 1, Mat4{1.0}});
    Mat4 bind = glm::rotate(Mat4{1.0}, any(random), glm::normalize(Vec3{1.0, any(random), 0.3}));
    bind[3] = Vec4{40.0 * any(random), 90.0 + 50.0 * any(random), 10.0 * any(random), 1.0};
    character.palette.push_back({10 - j, glm::inverse(bind)});
  }
  MeshPart part;
  for (int v = 0; v < 200; ++v) {
    part.positions.emplace_back(50.0 * any(random), 100.0 + 80.0 * any(random), 20.0 * any(random));
    part.normals.push_back(glm::normalize(glm::vec3(any(random), any(random), 1.5)));
    MeshPart::Influences all;
    double sum = 0.0;
    for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
      all.entry[k] = static_cast<std::uint16_t>((static_cast<std::size_t>(v) + k) % 11);
      all.weight[k] = static_cast<float>(1.05 + any(random));
      sum += all.weight[k];
    }
    for (float& w : all.weight) w = static_cast<float>(w / sum);
    part.influences.push_back(all);
  }
  character.parts.push_back(part);
  return character;
}

std::vector<Mat4> Posed(std::size_t count) {
  std::vector<Mat4> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    Mat4 m = glm::rotate(Mat4{1.0}, 0.03 * static_cast<double>(i), Vec3{0.0, 0.6, 0.8});
    m[3] = Vec4{0.01 * static_cast<double>(i), 0.9, 0.02, 1.0};
    nodes.push_back(glm::scale(m, Vec3{0.01}));
  }
  return nodes;
}

TEST(Skinning, EightInfluencesEqualTheSumInDoublePrecision) {
  const Character character = EightInfluences();
  const std::vector<Mat4> nodes = Posed(11);
  const Vec3 offset{3.0, 0.0, -1.0};
  std::vector<glm::mat4> palette(character.palette.size());
  SkinningPalette(character, nodes, offset, palette);
  const MeshPart& part = character.parts[0];
  const SkinnedMesh mesh(part);
  std::vector<glm::vec3> positions(mesh.VertexCount()), normals(mesh.VertexCount());
  mesh.Skin(palette, positions, normals);
  for (std::size_t v = 0; v < part.positions.size(); ++v) {
    Vec3 expected = offset;
    Vec3 normal{0.0};
    for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
      const PaletteEntry& entry = character.palette[part.influences[v].entry[k]];
      const Mat4 m = nodes[static_cast<std::size_t>(entry.node)] * entry.inverse_bind;
      const double w = part.influences[v].weight[k];
      expected += w * Vec3(m * Vec4(Vec3(part.positions[v]), 1.0));
      normal += w * Vec3(m * Vec4(Vec3(part.normals[v]), 0.0));
    }
    EXPECT_NEAR(glm::distance(Vec3(positions[v]), expected), 0.0, 2e-5);  // metres
    EXPECT_NEAR(glm::distance(Vec3(normals[v]), glm::normalize(normal)), 0.0, 1e-4);
  }
}

TEST(Skinning, InfluencesWithoutWeightMayNameAnything) {
  Character character = EightInfluences();
  MeshPart& part = character.parts[0];
  for (MeshPart::Influences& all : part.influences) {
    all.weight.fill(0.0f);
    all.weight[3] = 1.0f;
    all.entry[0] = 60000;
  }
  const std::vector<Mat4> nodes = Posed(11);
  std::vector<glm::mat4> palette(11);
  SkinningPalette(character, nodes, Vec3{0.0}, palette);
  const SkinnedMesh mesh(part);
  std::vector<glm::vec3> positions(mesh.VertexCount()), normals(mesh.VertexCount());
  mesh.Skin(palette, positions, normals);
  const glm::vec4 expected = palette[part.influences[5].entry[3]] * glm::vec4(part.positions[5], 1);
  EXPECT_NEAR(glm::distance(positions[5], glm::vec3(expected)), 0.0f, 1e-5f);
}

TEST(Skinning, KnowsAMirroringPalette) {
  const Character character = EightInfluences();
  std::vector<Mat4> nodes = Posed(11);
  std::vector<glm::mat4> palette(11);
  const SkinnedMesh mesh(character.parts[0]);
  SkinningPalette(character, nodes, Vec3{0.0}, palette);
  EXPECT_FALSE(mesh.IsMirrored(palette));
  for (Mat4& node : nodes) node = glm::scale(Mat4{1.0}, Vec3{-1.0, 1.0, 1.0}) * node;
  SkinningPalette(character, nodes, Vec3{0.0}, palette);
  EXPECT_TRUE(mesh.IsMirrored(palette));
}

TEST(Capsule, PointsLieOnItAndTrianglesFaceOutwards) {
  const Vec3 a{0.2, 1.0, -0.3}, b{-0.1, 0.4, 0.5};
  for (const Roundness roundness : {Roundness::kLimb, Roundness::kBone}) {
    for (const Vec3& end : {b, a, a + Vec3{0.0, 0.0, -0.7}, a + Vec3{0.0, -0.4, 0.0}}) {
      std::vector<glm::vec3> positions, normals;
      std::vector<std::uint32_t> indices;
      TriangleSink sink{positions, normals, indices, 0};
      AppendCapsule(a, 0.08, end, 0.08, roundness, sink);
      const Vec3 axis = end - a;
      const double length_squared = std::max(1e-12, glm::dot(axis, axis));
      const auto nearest = [&](const Vec3& p) {
        return a + glm::clamp(glm::dot(p - a, axis) / length_squared, 0.0, 1.0) * axis;
      };
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 p(positions[i]);
        EXPECT_NEAR(glm::distance(p, nearest(p)), 0.08, 1e-6);
        EXPECT_NEAR(glm::distance(Vec3(normals[i]), (p - nearest(p)) / 0.08), 0.0, 1e-4);
      }
      for (std::size_t i = 0; i < indices.size(); i += 3) {
        const Vec3 p(positions[indices[i]]), q(positions[indices[i + 1]]),
            r(positions[indices[i + 2]]);
        const Vec3 n = glm::cross(q - p, r - p);
        const Vec3 middle = (p + q + r) / 3.0;
        EXPECT_GE(glm::dot(n, middle - nearest(middle)), -1e-12);
      }
    }
  }
}

TEST(ShadowMesh, KeepsTheShapeWithFewerTriangles) {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> indices;
  TriangleSink sink{positions, normals, indices, 0};
  AppendCapsule({0.0, 0.5, 0.0}, 0.5, {0.0, 1.5, 0.0}, 0.5, Roundness::kLimb, sink);
  const auto volume = [&](const std::vector<std::uint32_t>& triangles) {
    double sum = 0.0;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      sum += glm::dot(Vec3(positions[triangles[i]]), glm::cross(Vec3(positions[triangles[i + 1]]),
                                                                Vec3(positions[triangles[i + 2]])));
    }
    return sum / 6.0;
  };
  const std::vector<std::uint32_t> coarse = ClusterTriangles(positions, normals, indices, 0.25f);
  EXPECT_LT(coarse.size(), indices.size());
  EXPECT_GT(coarse.size(), 60u);
  for (const std::uint32_t i : coarse) ASSERT_LT(i, positions.size());
  EXPECT_NEAR(volume(coarse) / volume(indices), 1.0, 0.15);
  EXPECT_EQ(ClusterTriangles(positions, normals, indices, 0.0f), indices);
}

}  // namespace
}  // namespace ego
