// SPDX-License-Identifier: MIT
#include "assets/people/figure_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr std::array<const char*, kRegionCount> kRegionNames = {
    "Skin", "Shirt", "Trim", "Trousers", "Shoes", "Soles",
    "Hair", "Lips",  "Eyes", "Iris",     "Pupil", "Lashes"};

float Linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

MeshPart::Influences InfluencesOf(const SkinJointWeights& weights) {
  std::array<std::size_t, kSkinJointCount> order{};
  for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
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

/// The pieces of a skin for the atlas: trunk, head, arms, legs, feet, palms, fingers.
enum : std::size_t {
  kTrunkPiece,
  kHeadPiece,
  kArmPiece,
  kLegPiece = 4,
  kFootPiece = 6,
  kPalmPiece = 8,
  kFingerPiece = 10
};

std::size_t PieceOf(std::size_t skin_joint) {
  if (skin_joint >= kJointCount) {
    return kFingerPiece + (skin_joint - kJointCount) / hand::kJointsPerFinger;
  }
  switch (static_cast<J>(skin_joint)) {
    case J::kNeck:
    case J::kHead:
      return kHeadPiece;
    case J::kLeftUpperArm:
    case J::kLeftLowerArm:
      return kArmPiece;
    case J::kRightUpperArm:
    case J::kRightLowerArm:
      return kArmPiece + 1;
    case J::kLeftUpperLeg:
    case J::kLeftLowerLeg:
      return kLegPiece;
    case J::kRightUpperLeg:
    case J::kRightLowerLeg:
      return kLegPiece + 1;
    case J::kLeftFoot:
    case J::kLeftToes:
      return kFootPiece;
    case J::kRightFoot:
    case J::kRightToes:
      return kFootPiece + 1;
    case J::kLeftHand:
      return kPalmPiece;
    case J::kRightHand:
      return kPalmPiece + 1;
    default:
      return kTrunkPiece;
  }
}

std::size_t Strongest(const SkinJointWeights& weights) {
  return static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                  weights.begin());
}

}  // namespace

FigureBuilder::FigureBuilder(const PersonParameters& parameters, const Skeleton& skeleton)
    : parameters_(parameters) {
  character_.name = parameters.name;
  AddNodes(skeleton);
}

void FigureBuilder::AddNodes(const Skeleton& skeleton) {
  Character& c = character_;
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
  const auto add_joint = [&](std::string name, int parent, const Vec3& at, J driver) {
    const int node = add_node(std::move(name), parent, at, driver);
    c.palette.push_back({node, glm::translate(Mat4(1.0), -at)});
    return node;
  };
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<J>(j);
    const int parent = j == 0 ? -1 : static_cast<int>(Index(kParent[j]));
    const int node = add_joint(std::string(Name(joint)), parent, position[j], joint);
    c.rig.node[j] = node;
    c.map.joint[j] = {node, 1.0, "made as this joint"};
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const J palm = side == 0 ? J::kLeftHand : J::kRightHand;
    const auto on_hand = [&](Vec3 q) {
      if (side == 1) q.x = -q.x;
      return position[Index(palm)] + parameters_.hand_length * q;
    };
    std::array<int, hand::kFingerCount> last{};
    for (std::size_t f = 0; f < hand::kFingerJointCount; ++f) {
      const std::size_t finger = f / hand::kJointsPerFinger;
      const bool first = f % hand::kJointsPerFinger == 0;
      const Vec3 at = on_hand(hand::Fingers()[finger].point[f % hand::kJointsPerFinger]);
      const int parent = first ? static_cast<int>(Index(palm)) : last[finger];
      last[finger] = add_joint(hand::FingerJointName(side == 0, f), parent, at, palm);
      if (first && finger == 0) c.map.thumb_base[side] = last[finger];
      if (first && finger == 1) c.map.index_base[side] = last[finger];
      if (first && finger == 4) c.map.little_base[side] = last[finger];
    }
    const std::string prefix = side == 0 ? "left" : "right";
    for (std::size_t finger = 0; finger < hand::kFingerCount; ++finger) {
      const hand::Finger& of = hand::Fingers()[finger];
      const Vec3 on = glm::normalize(of.point[3] - of.point[2]);
      const int tip = add_node(prefix + of.name + "Tip", last[finger],
                               on_hand(of.point[3] + of.radius[3] * on), palm);
      if (finger == 2) c.map.fingertip[side] = tip;
    }
    const J toes = side == 0 ? J::kLeftToes : J::kRightToes;
    c.map.toe_tip[side] =
        add_node(prefix + "ToeTip", static_cast<int>(Index(toes)),
                 position[Index(toes)] + Vec3{0.0, 0.0, 0.29 * parameters_.foot_length}, toes);
  }
  c.rig.fingers = FindFingers(c.nodes, c.rig.driver, c.rig.canonical_global);
}

glm::vec3 FigureBuilder::ColorOf(Region region) const {
  const PersonParameters& m = parameters_;
  const glm::vec3 brow = m.hair == Hair::kNone ? 0.45f * m.skin_color : m.hair_color;
  switch (region) {
    case Region::kSkin:
      return m.skin_color;
    case Region::kShirt:
      return m.shirt_color;
    case Region::kTrim:
      return m.trim_color;
    case Region::kTrousers:
      return m.trouser_color;
    case Region::kShoes:
      return m.shoe_color;
    case Region::kSoles:
      return m.sole_color;
    case Region::kHair:
      return m.hair_color;
    case Region::kLips:
      return glm::mix(m.skin_color, glm::vec3{0.66f, 0.22f, 0.22f}, 0.42f);
    case Region::kEyeWhite:
      return {0.95f, 0.95f, 0.93f};
    case Region::kIris:
      return m.eye_color;
    case Region::kPupil:
      return {0.05f, 0.045f, 0.045f};
    case Region::kLashes:
      break;
  }
  return 0.45f * brow;
}

std::uint32_t FigureBuilder::MaterialFor(const std::string& name, glm::vec3 color) {
  std::vector<Material>& materials = character_.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].name == name) return static_cast<std::uint32_t>(i);
  }
  Material material;
  material.name = name;
  material.base_color = {Linear(color.r), Linear(color.g), Linear(color.b), 1.0f};
  materials.push_back(material);
  return static_cast<std::uint32_t>(materials.size() - 1);
}

void FigureBuilder::AddSkin(const ReliefMesh& skin, std::span<const SkinJointWeights> weights) {
  const std::size_t base_piece = pieces_.size();
  const std::vector<UvPiece> limbs = LimbPieces();
  pieces_.insert(pieces_.end(), limbs.begin(), limbs.end());
  const ClosedMesh& mesh = skin.mesh;
  const auto surface_base = static_cast<std::uint32_t>(surface_.position_ms.size());
  const auto base = static_cast<std::uint32_t>(position_.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const SkinJointWeights& w = weights[skin.source[v]];
    surface_.position_ms.push_back(mesh.positions[v]);
    surface_.attachment.push_back(StrongestFour(WithoutFingers(w)));
    position_.push_back(mesh.positions[v]);
    normal_.push_back(skin.normals[v]);
    weights_.push_back(w);
  }
  // Steps are shaded as what they are: sharp against both of their sides, smooth along the border.
  ClosedMesh steps;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (skin.step[t]) steps.triangles.push_back(mesh.triangles[t]);
  }
  steps.positions = mesh.positions;
  const std::vector<Vec3> step_normals = VertexNormals(steps);
  std::vector<std::uint32_t> step_vertex(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle = mesh.triangles[t];
    surface_.triangles.push_back(
        {triangle[0] + surface_base, triangle[1] + surface_base, triangle[2] + surface_base});
    const SkinJointWeights& w = weights[skin.source[triangle[0]]];
    for (std::uint32_t& v : triangle) {
      if (!skin.step[t]) {
        v += base;
        continue;
      }
      if (step_vertex[v] == 0) {
        step_vertex[v] = static_cast<std::uint32_t>(position_.size());
        position_.push_back(mesh.positions[v]);
        normal_.push_back(step_normals[v]);
        weights_.push_back(weights[skin.source[v]]);
      }
      v = step_vertex[v];
    }
    triangle_.push_back(triangle);
    const Region region = skin.regions[t];
    material_.push_back(
        MaterialFor(kRegionNames[static_cast<std::size_t>(region)], ColorOf(region)));
    piece_.push_back(static_cast<std::uint16_t>(base_piece + PieceOf(Strongest(w))));
  }
}

std::vector<UvPiece> FigureBuilder::LimbPieces() const {
  const std::array<Vec3, kJointCount> at = CanonicalPositions(character_.rig.skeleton);
  const auto between = [&](J from, J to) {
    return UvPiece{at[Index(from)], glm::normalize(at[Index(to)] - at[Index(from)])};
  };
  std::vector<UvPiece> pieces(kFingerPiece + 2 * hand::kFingerCount);
  pieces[kTrunkPiece] = {at[Index(J::kSpine)], kUp};
  pieces[kHeadPiece] = {at[Index(J::kHead)], kUp};
  pieces[kArmPiece] = between(J::kLeftUpperArm, J::kLeftHand);
  pieces[kArmPiece + 1] = between(J::kRightUpperArm, J::kRightHand);
  pieces[kLegPiece] = between(J::kLeftFoot, J::kLeftUpperLeg);
  pieces[kLegPiece + 1] = between(J::kRightFoot, J::kRightUpperLeg);
  for (std::size_t f = 0; f < 2 * hand::kFingerCount; ++f) {
    const bool left = f < hand::kFingerCount;
    const hand::Finger& finger = hand::Fingers()[f % hand::kFingerCount];
    Vec3 from = finger.point[0];
    Vec3 to = finger.point[2];
    if (!left) from.x = -from.x, to.x = -to.x;
    pieces[kFingerPiece + f] = {
        at[Index(left ? J::kLeftHand : J::kRightHand)] + parameters_.hand_length * from,
        glm::normalize(to - from)};
  }
  return pieces;
}

void FigureBuilder::AddPiece(const ClosedMesh& mesh, const SkinJointWeights& weights,
                             std::uint32_t material) {
  const auto base = static_cast<std::uint32_t>(position_.size());
  const std::vector<Vec3> normals = VertexNormals(mesh);
  position_.insert(position_.end(), mesh.positions.begin(), mesh.positions.end());
  normal_.insert(normal_.end(), normals.begin(), normals.end());
  weights_.resize(position_.size(), weights);
  for (const auto& t : mesh.triangles) {
    triangle_.push_back({t[0] + base, t[1] + base, t[2] + base});
    material_.push_back(material);
    piece_.push_back(static_cast<std::uint16_t>(pieces_.size()));
  }
  pieces_.push_back({});
}

void FigureBuilder::AddRigid(std::string name, const ClosedMesh& mesh, std::size_t skin_joint,
                             Region region) {
  const auto base = static_cast<std::uint32_t>(surface_.position_ms.size());
  const SkinJointWeights weights = Rigid(skin_joint);
  surface_.position_ms.insert(surface_.position_ms.end(), mesh.positions.begin(),
                              mesh.positions.end());
  surface_.attachment.resize(surface_.position_ms.size(), StrongestFour(WithoutFingers(weights)));
  for (const auto& t : mesh.triangles) {
    surface_.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  AddPiece(mesh, weights, MaterialFor(name, ColorOf(region)));
}

void FigureBuilder::AddDetail(std::string name, const ClosedMesh& mesh, HumanoidJoint joint,
                              glm::vec3 color) {
  AddPiece(mesh, Rigid(Index(joint)), MaterialFor(name, color));
}

void FigureBuilder::MakeParts() {
  const UvAtlas atlas = MakeUvAtlas(position_, triangle_, piece_, pieces_);
  character_.parts.resize(character_.materials.size());
  for (std::size_t i = 0; i < character_.parts.size(); ++i) {
    character_.parts[i].name = character_.materials[i].name;
    character_.parts[i].material = static_cast<int>(i);
  }
  // A vertex on a border is repeated in each material and chart, and on both sides of a cut.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, float, float>, std::uint32_t>
      index;
  for (std::size_t t = 0; t < triangle_.size(); ++t) {
    MeshPart& part = character_.parts[material_[t]];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = triangle_[t][c];
      const glm::vec2& uv = atlas.uv[t][c];
      const auto [it, fresh] = index.try_emplace({material_[t], v, atlas.chart[t], uv.x, uv.y},
                                                 static_cast<std::uint32_t>(part.positions.size()));
      if (fresh) {
        part.positions.emplace_back(position_[v]);
        part.normals.push_back(glm::normalize(glm::vec3(normal_[v])));
        part.uvs.push_back(uv);
        part.influences.push_back(InfluencesOf(weights_[v]));
      }
      part.triangles.push_back(it->second);
    }
  }
}

Person FigureBuilder::Finish(const PersonShape& shape) && {
  MakeParts();
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

}  // namespace ego
