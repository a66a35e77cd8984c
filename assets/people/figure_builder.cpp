// SPDX-License-Identifier: MIT
#include "assets/people/figure_builder.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::array<const char*, kRegionCount> kRegionNames = {"Skin", "Shirt", "Trousers",
                                                                "Shoes", "Hair"};

float Linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

MeshPart::Influences InfluencesOf(const JointWeights& weights) {
  std::array<std::size_t, kJointCount> order{};
  for (std::size_t j = 0; j < kJointCount; ++j) order[j] = j;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  constexpr double kNegligible = 1e-3;
  MeshPart::Influences influences;
  double sum = 0.0;
  std::size_t count = 0;
  while (count < MeshPart::kInfluences && weights[order[count]] > kNegligible) {
    sum += weights[order[count++]];
  }
  for (std::size_t k = 0; k < count; ++k) {
    influences.entry[k] = static_cast<std::uint16_t>(order[k]);
    influences.weight[k] = static_cast<float>(weights[order[k]] / sum);
  }
  return influences;
}

}  // namespace

FigureBuilder::FigureBuilder(const PersonParameters& parameters, const Skeleton& skeleton)
    : parameters_(parameters) {
  Character& c = character_;
  c.name = parameters.name;
  c.rig.skeleton = skeleton;
  const std::array<Vec3, kJointCount> position = CanonicalPositions(skeleton);
  const auto add_node = [&](std::string name, int parent, const Vec3& at, J driver) {
    const Vec3 from =
        parent < 0 ? Vec3(0.0) : Vec3(c.rig.canonical_global[static_cast<std::size_t>(parent)][3]);
    c.nodes.joints.push_back({std::move(name), parent, glm::translate(Mat4(1.0), at - from)});
    c.rig.driver.push_back(driver);
    c.rig.canonical_global.push_back(glm::translate(Mat4(1.0), at));
    return static_cast<int>(c.nodes.joints.size()) - 1;
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    const int parent = j == 0 ? -1 : static_cast<int>(Index(kParent[j]));
    const int node = add_node(std::string(Name(joint)), parent, position[j], joint);
    c.rig.node[j] = node;
    c.map.joint[j] = {node, 1.0, "made as this joint"};
    c.palette.push_back({node, glm::translate(Mat4(1.0), -position[j])});
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const std::string prefix = side == 0 ? "left" : "right";
    const J hand = side == 0 ? J::kLeftHand : J::kRightHand;
    const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
    c.map.fingertip[side] =
        add_node(prefix + "MiddleTip", static_cast<int>(Index(hand)),
                 position[Index(hand)] + parameters.hand_length * Vec3{sign, -0.045, 0.067}, hand);
    c.map.toe_tip[side] =
        add_node(prefix + "ToeTip", static_cast<int>(Index(toes)),
                 position[Index(toes)] + Vec3{0.0, 0.0, 0.29 * parameters.foot_length}, toes);
  }
}

glm::vec3 FigureBuilder::ColorOf(Region region) const {
  switch (region) {
    case Region::kSkin:
      return parameters_.skin_color;
    case Region::kShirt:
      return parameters_.shirt_color;
    case Region::kTrousers:
      return parameters_.trouser_color;
    case Region::kShoes:
      return parameters_.shoe_color;
    case Region::kHair:
      break;
  }
  return parameters_.hair_color;
}

MeshPart& FigureBuilder::PartFor(const std::string& name, glm::vec3 color) {
  for (MeshPart& part : character_.parts) {
    if (part.name == name) return part;
  }
  Material material;
  material.name = name;
  material.base_color = {Linear(color.r), Linear(color.g), Linear(color.b), 1.0f};
  character_.materials.push_back(material);
  MeshPart part;
  part.name = name;
  part.material = static_cast<int>(character_.materials.size()) - 1;
  character_.parts.push_back(std::move(part));
  return character_.parts.back();
}

void FigureBuilder::AddSkin(const ClosedMesh& mesh, std::span<const Vec3> normals,
                            std::span<const JointWeights> weights,
                            std::span<const Region> regions) {
  const auto base = static_cast<std::uint32_t>(surface_.position_ms.size());
  surface_.position_ms.insert(surface_.position_ms.end(), mesh.positions.begin(),
                              mesh.positions.end());
  for (const JointWeights& w : weights) surface_.attachment.push_back(StrongestFour(w));
  for (const auto& t : mesh.triangles) {
    surface_.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }

  constexpr std::uint32_t kNone = 0xffffffffu;
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    const auto region = static_cast<Region>(r);
    if (std::find(regions.begin(), regions.end(), region) == regions.end()) continue;
    MeshPart& part = PartFor(kRegionNames[r], ColorOf(region));
    std::vector<std::uint32_t> index(mesh.positions.size(), kNone);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (regions[t] != region) continue;
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (index[v] == kNone) {
          index[v] = static_cast<std::uint32_t>(part.positions.size());
          part.positions.emplace_back(mesh.positions[v]);
          part.normals.push_back(glm::normalize(glm::vec3(normals[v])));
          part.influences.push_back(InfluencesOf(weights[v]));
        }
        part.triangles.push_back(index[v]);
      }
    }
  }
}

void FigureBuilder::AddRigid(std::string name, const ClosedMesh& mesh, HumanoidJoint joint,
                             Region region) {
  const auto base = static_cast<std::uint32_t>(surface_.position_ms.size());
  surface_.position_ms.insert(surface_.position_ms.end(), mesh.positions.begin(),
                              mesh.positions.end());
  surface_.attachment.resize(surface_.position_ms.size(),
                             Attachment{{joint, joint, joint, joint}, {1.0, 0.0, 0.0, 0.0}});
  for (const auto& t : mesh.triangles) {
    surface_.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  AddDetail(std::move(name), mesh, joint, ColorOf(region));
}

void FigureBuilder::AddDetail(std::string name, const ClosedMesh& mesh, HumanoidJoint joint,
                              glm::vec3 color) {
  MeshPart& part = PartFor(name, color);
  const auto base = static_cast<std::uint32_t>(part.positions.size());
  const std::vector<Vec3> normals = VertexNormals(mesh);
  MeshPart::Influences rigid;
  rigid.entry[0] = static_cast<std::uint16_t>(Index(joint));
  rigid.weight[0] = 1.0f;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    part.positions.emplace_back(mesh.positions[v]);
    part.normals.push_back(glm::normalize(glm::vec3(normals[v])));
    part.influences.push_back(rigid);
  }
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) part.triangles.push_back(base + v);
  }
}

Person FigureBuilder::Finish(const PersonShape& shape) && {
  Person person;
  person.body = MeasureBody(shape, surface_);
  person.character = std::move(character_);
  return person;
}

std::vector<Vec3> VertexNormals(const ClosedMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3(0.0));
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = mesh.positions[t[(c + 1) % 3]] - mesh.positions[t[c]];
      const Vec3 b = mesh.positions[t[(c + 2) % 3]] - mesh.positions[t[c]];
      const Vec3 n = glm::cross(a, b);
      const double area = glm::length(n);
      if (area > 0.0) normals[t[c]] += n / area * std::atan2(area, glm::dot(a, b));
    }
  }
  for (Vec3& n : normals) n = glm::length(n) > 1e-12 ? glm::normalize(n) : kUp;
  return normals;
}

ClosedMesh Ball(const Vec3& centre, const Vec3& radius, int segments) {
  ClosedMesh mesh;
  const int rings = segments / 2;
  const auto at = [&](int ring, int segment) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * segments + segment % segments);
  };
  mesh.positions.push_back(centre + Vec3{0.0, radius.y, 0.0});
  for (int r = 1; r < rings; ++r) {
    const double polar = kPi * r / rings;
    for (int s = 0; s < segments; ++s) {
      const double angle = 2.0 * kPi * s / segments;
      mesh.positions.push_back(centre + radius * Vec3{std::sin(polar) * std::cos(angle),
                                                      std::cos(polar),
                                                      -std::sin(polar) * std::sin(angle)});
    }
  }
  const auto south = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(centre - Vec3{0.0, radius.y, 0.0});
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0u, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, s), south, at(rings - 1, s + 1)});
  }
  return mesh;
}

}  // namespace ego
