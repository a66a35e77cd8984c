// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "assets/people/person.h"
#include "assets/people/person_body.h"
#include "assets/people/person_shape.h"
#include "assets/people/person_skin.h"
#include "assets/people/polygonise.h"

namespace ego {

/// Puts a person together from meshes: materials, skin, nodes, rig and calibration.
class FigureBuilder {
 public:
  FigureBuilder(const PersonParameters& parameters, const Skeleton& skeleton);

  /// A mesh in several materials; vertices on a border are repeated in each of them.
  void AddSkin(const ClosedMesh& mesh, std::span<const Vec3> normals,
               std::span<const JointWeights> weights, std::span<const Region> regions);
  /// A closed piece rigid on one joint, in one of the regions' colours.
  void AddRigid(std::string name, const ClosedMesh& mesh, HumanoidJoint joint, Region region);
  /// The same in a colour of its own (sRGB): eyes, mouth. It only decorates: the calibration is
  /// measured without it.
  void AddDetail(std::string name, const ClosedMesh& mesh, HumanoidJoint joint, glm::vec3 color);

  /// What has been added as skin or rigid pieces, for rays.
  const FigureSurface& surface() const { return surface_; }

  Person Finish(const PersonShape& shape) &&;

 private:
  MeshPart& PartFor(const std::string& name, glm::vec3 color);
  glm::vec3 ColorOf(Region region) const;

  PersonParameters parameters_;
  Character character_;
  FigureSurface surface_;
};

/// Normals that average the faces around each vertex by their angles.
std::vector<Vec3> VertexNormals(const ClosedMesh& mesh);

/// A closed ball stretched to these radii; `segments` around, half as many from pole to pole.
ClosedMesh Ball(const Vec3& centre, const Vec3& radius, int segments);

}  // namespace ego
