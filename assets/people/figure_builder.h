// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/people/person.h"
#include "assets/people/person_body.h"
#include "assets/people/person_shape.h"
#include "assets/people/person_skin.h"
#include "assets/people/polygonise.h"
#include "assets/people/relief.h"
#include "assets/people/uv_atlas.h"

namespace ego {

/// Puts a person together from meshes: materials, skin, texture coordinates, nodes, rig and
/// calibration.
class FigureBuilder {
 public:
  FigureBuilder(const PersonParameters& parameters, const Skeleton& skeleton);

  /// A closed skin in several materials. `weights` belong to the vertices of the plain mesh that
  /// `skin.source` names.
  void AddSkin(const ReliefMesh& skin, std::span<const SkinJointWeights> weights);
  /// A closed piece rigid on one joint of the palette (kSkinJointCount), in one of the regions'
  /// colours.
  void AddRigid(std::string name, const ClosedMesh& mesh, std::size_t skin_joint, Region region);
  /// The same in a colour of its own (sRGB): brows, mouth. It only decorates: the calibration is
  /// measured without it.
  void AddDetail(std::string name, const ClosedMesh& mesh, HumanoidJoint joint, glm::vec3 color);

  /// What has been added as skin or rigid pieces, for rays.
  const FigureSurface& surface() const { return surface_; }

  Person Finish(const PersonShape& shape) &&;

 private:
  void AddNodes(const Skeleton& skeleton);
  std::uint32_t MaterialFor(const std::string& name, glm::vec3 color);
  glm::vec3 ColorOf(Region region) const;
  std::vector<UvPiece> LimbPieces() const;
  void AddPiece(const ClosedMesh& mesh, const SkinJointWeights& weights, std::uint32_t material);
  void MakeParts();

  PersonParameters parameters_;
  Character character_;
  FigureSurface surface_;

  // Everything added, before it is divided by material and chart. Vertices are shared where their
  // normals are.
  std::vector<Vec3> position_;
  std::vector<Vec3> normal_;
  std::vector<SkinJointWeights> weights_;
  std::vector<std::array<std::uint32_t, 3>> triangle_;
  std::vector<std::uint32_t> material_;  // of triangles
  std::vector<std::uint16_t> piece_;     // of triangles: which of pieces_
  std::vector<UvPiece> pieces_;
};

/// Normals that average the faces around each vertex by their angles.
std::vector<Vec3> VertexNormals(const ClosedMesh& mesh);

}  // namespace ego
