// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/model/character.h"
#include "render/body_mesh.h"
#include "render/detail_levels.h"
#include "render/skinning.h"
#include "render/stage_view.h"

namespace ego {

/// What stays of a loaded character on the processor's side.
struct StageCharacter {
  /// Nodes, palette, map and materials; the mesh data itself moves into `meshes`.
  Character character;
  struct Part {
    SkinnedMesh mesh;
    std::vector<glm::vec2> uvs;  // one per vertex, or empty
  };
  std::vector<Part> parts;
  DetailLevels detail;  // the order of its vertices is that of the parts
};
using CharacterStore = std::map<std::uint32_t, StageCharacter>;

/// Checks and reorders a loaded character; parts with indices out of range are left out.
StageCharacter PrepareCharacter(const Character& character);

/// In which order and how a group is drawn.
enum class Pass { kOpaque, kTranslucent, kThrough };

/// How exact meshes must be: as seen from the camera, or exactly as loaded.
struct Exactness {
  double pixels = 0.0;  // by which a surface may be off; 0: none is simplified
  double focal = 0.0;   // pixels that a metre spans at a metre's distance
};

/// Everything one picture needs, posed, in world space, ready to be uploaded. Keeps its memory
/// from frame to frame.
struct DrawList {
  struct Mesh {
    std::uint32_t character = 0;  // whose indices; 0: the list's own
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint32_t first_shadow_index = 0;
    std::uint32_t shadow_index_count = 0;
    std::uint32_t first_vertex = 0;
    glm::vec4 color{1.0f};  // linear, with opacity
    int image = -1;         // of the character
    float alpha_cutoff = 0.0f;
    bool double_sided = false;
    bool mirrored = false;
  };
  /// Drawn together: hides itself, whatever lies behind it shows through when it is not opaque.
  struct Group {
    Pass pass = Pass::kOpaque;
    double distance = 0.0;  // from the camera
    bool hides_itself = true;
    bool casts_shadow = true;  // and lies in that of others
    bool edges = false;        // drawn as lines as well
    glm::vec4 rim{0.0f};
    Box3 box;
    std::uint32_t first_mesh = 0, mesh_count = 0;
  };
  struct Spot {
    glm::vec4 center;  // and radius
    glm::vec4 color;
  };
  struct Plate {
    std::string_view name;
    glm::vec3 color;
    Vec3 anchor_ws;
  };

  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> indices;
  std::vector<Mesh> meshes;
  std::vector<Group> groups;
  std::vector<Spot> contact_shadows;
  std::vector<Spot> glows;
  std::vector<Plate> plates;
  Box3 bounds;

  /// Poses every figure of the view. Names are borrowed from it.
  void Build(const StageView& view, const CharacterStore& characters,
             const Exactness& exactness = {});

 private:
  void Clear();
  void AddCharacter(const Figure& figure, const StageCharacter& character, const Vec3& eye);
  void AddSurface(const Figure& figure, const Vec3& eye);
  void AddSkeleton(const Figure& figure, const Vec3& eye);
  void AddMarkers(const Figure& figure, const Vec3& eye);
  void AddFeet(const Figure& figure, std::span<const Vec3> points_ws);
  void AddPlate(const Figure& figure, const CharacterStore& characters, const Camera& camera);
  Group Begin(Pass pass, const Figure& figure) const;
  void End(Group group, const Vec3& eye, std::size_t first_vertex);
  /// A mesh of the list's own triangles: fill the sink, then pass it to AddMesh.
  TriangleSink NewMesh(double smallest);
  /// Metres that a surface may be off where the nearest of these points is.
  double Smallest(std::span<const Vec3> points, const Figure& figure, const Vec3& eye) const;
  void AddMesh(const TriangleSink& sink, std::size_t first_index, const glm::vec4& color);

  Exactness exactness_;
  std::vector<glm::mat4> palette_;
  std::vector<Vec3> points_;
};

/// Linear light of an sRGB colour.
glm::vec3 Linear(const glm::vec3& srgb);

}  // namespace ego
