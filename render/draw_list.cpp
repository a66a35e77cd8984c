// SPDX-License-Identifier: MIT
#include "render/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ego {
namespace {

using J = HumanoidJoint;

constexpr float kRimStrength = 0.9f;

std::uint32_t Size(const auto& container) { return static_cast<std::uint32_t>(container.size()); }

Vec3 OnGround(const Vec3& p) { return {p.x, 0.0, p.z}; }

bool IsUsable(const MeshPart& part, std::size_t palette_size) {
  const std::size_t n = part.positions.size();
  if (part.triangles.empty() || part.influences.size() != n) return false;
  for (const std::uint32_t i : part.triangles) {
    if (i >= n) return false;
  }
  for (const MeshPart::Influences& all : part.influences) {
    for (std::size_t k = 0; k < MeshPart::kInfluences; ++k) {
      if (all.weight[k] != 0.0f && all.entry[k] >= palette_size) return false;
    }
  }
  return true;
}

bool IsUsable(const std::optional<CharacterPart>& part, const CharacterStore& characters) {
  if (!part) return false;
  const auto it = characters.find(part->character.value);
  return it != characters.end() &&
         it->second.character.nodes.joints.size() == part->node_global.size();
}

}  // namespace

glm::vec3 Linear(const glm::vec3& srgb) {
  glm::vec3 linear;
  for (int i = 0; i < 3; ++i) {
    linear[i] =
        srgb[i] <= 0.04045f ? srgb[i] / 12.92f : std::pow((srgb[i] + 0.055f) / 1.055f, 2.4f);
  }
  return linear;
}

StageCharacter PrepareCharacter(const Character& character) {
  StageCharacter out;
  out.character.name = character.name;
  out.character.nodes = character.nodes;
  out.character.palette = character.palette;
  out.character.materials = character.materials;
  out.character.map = character.map;
  for (const PaletteEntry& entry : character.palette) {
    if (entry.node < 0 || static_cast<std::size_t>(entry.node) >= character.nodes.joints.size()) {
      return out;
    }
  }
  std::vector<MeshPart> usable;
  for (const MeshPart& part : character.parts) {
    if (!IsUsable(part, character.palette.size())) continue;
    usable.push_back(part);
    // The parts of `character` keep their materials, without their vertices.
    MeshPart& kept = out.character.parts.emplace_back();
    kept.name = part.name;
    kept.material = part.material;
  }
  out.detail = MakeDetailLevels(usable);
  for (std::size_t p = 0; p < usable.size(); ++p) {
    const MeshPart& part = usable[p];
    const std::vector<std::uint32_t>& order = out.detail.order[p];
    StageCharacter::Part& to = out.parts.emplace_back();
    to.mesh = SkinnedMesh(part, order);
    if (part.uvs.size() != part.positions.size()) continue;
    for (const std::uint32_t v : order) to.uvs.push_back(part.uvs[v]);
  }
  out.detail.order = {};
  return out;
}

void DrawList::Clear() {
  positions.clear();
  normals.clear();
  uvs.clear();
  indices.clear();
  meshes.clear();
  groups.clear();
  contact_shadows.clear();
  glows.clear();
  plates.clear();
  bounds = {};
}

void DrawList::Build(const StageView& view, const CharacterStore& characters,
                     const Exactness& exactness) {
  Clear();
  exactness_ = exactness;
  const Vec3 eye = view.camera.Position();
  for (const Figure& figure : view.figures) {
    if (IsUsable(figure.character, characters)) {
      AddCharacter(figure, characters.at(figure.character->character.value), eye);
    }
    if (figure.surface && figure.surface->body != nullptr && figure.surface->pose != nullptr) {
      AddSurface(figure, eye);
    }
    if (figure.skeleton && figure.skeleton->skeleton != nullptr &&
        figure.skeleton->pose != nullptr) {
      AddSkeleton(figure, eye);
    }
    if (figure.markers) AddMarkers(figure, eye);
    for (const ContactGlow& glow : figure.contacts) {
      glows.push_back({glm::vec4(glm::vec3(glow.position_ws + figure.offset_ws), glow.radius),
                       glm::vec4(glow.color, std::clamp(glow.strength, 0.0f, 1.0f))});
    }
    if (!figure.name.empty()) AddPlate(figure, characters, view.camera);
  }
  uvs.resize(positions.size(), glm::vec2{0.0f});
  // What is seen through is drawn from far to near.
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.pass != b.pass ? a.pass < b.pass
                            : (a.pass != Pass::kOpaque && a.distance > b.distance);
  });
}

DrawList::Group DrawList::Begin(Pass pass, const Figure& figure) const {
  Group group;
  group.pass = pass;
  if (figure.selected) group.rim = glm::vec4(Linear(figure.color), kRimStrength);
  group.first_mesh = Size(meshes);
  return group;
}

void DrawList::End(Group group, const Vec3& eye, std::size_t first_vertex) {
  group.mesh_count = Size(meshes) - group.first_mesh;
  if (group.mesh_count == 0) return;
  glm::vec3 low{1e30f}, high{-1e30f};
  for (std::size_t i = first_vertex; i < positions.size(); ++i) {
    low = glm::min(low, positions[i]);
    high = glm::max(high, positions[i]);
  }
  const Box3 box{Vec3(low), Vec3(high)};
  group.distance = box.IsEmpty() ? 0.0 : glm::length(box.Center() - eye);
  bounds.Add(box);
  group.box = box;
  groups.push_back(group);
}

TriangleSink DrawList::NewMesh(double smallest) {
  return {positions, normals, indices, positions.size(), smallest};
}

double DrawList::Smallest(std::span<const Vec3> points, const Figure& figure,
                          const Vec3& eye) const {
  if (!(exactness_.pixels > 0.0) || !(exactness_.focal > 0.0)) return 0.0;
  double nearest = 1e300;
  for (const Vec3& p : points) {
    const Vec3 d = p + figure.offset_ws - eye;
    nearest = std::min(nearest, glm::dot(d, d));
  }
  return std::sqrt(nearest) * exactness_.pixels / exactness_.focal;
}

void DrawList::AddMesh(const TriangleSink& sink, std::size_t first_index, const glm::vec4& color) {
  if (indices.size() == first_index) return;
  Mesh mesh;
  mesh.color = color;
  mesh.first_vertex = static_cast<std::uint32_t>(sink.first_vertex);
  mesh.first_index = static_cast<std::uint32_t>(first_index);
  mesh.index_count = Size(indices) - mesh.first_index;
  mesh.first_shadow_index = mesh.first_index;
  mesh.shadow_index_count = mesh.index_count;
  meshes.push_back(mesh);
}

void DrawList::AddCharacter(const Figure& figure, const StageCharacter& character,
                            const Vec3& eye) {
  const CharacterPart& shown = *figure.character;
  const Character& source = character.character;
  palette_.resize(source.palette.size());
  SkinningPalette(source, shown.node_global, figure.offset_ws, palette_);

  points_.clear();
  for (const Mat4& node : shown.node_global) points_.emplace_back(node[3]);
  float scale = 0.0f;  // from the mesh's units to metres
  for (const glm::mat4& m : palette_) scale = std::max(scale, glm::length(glm::vec3(m[0])));
  const double smallest = Smallest(points_, figure, eye);
  std::size_t chosen = 0;
  while (!shown.edges && chosen + 1 < character.detail.levels.size() &&
         static_cast<double>(scale * character.detail.levels[chosen + 1].error) <= smallest) {
    ++chosen;
  }

  const bool see_through = shown.opacity < 0.999f;
  Group solid = Begin(see_through ? Pass::kTranslucent : Pass::kOpaque, figure);
  solid.edges = shown.edges;
  const std::size_t first_vertex = positions.size();
  std::vector<Mesh> blended;
  for (std::size_t p = 0; p < character.parts.size(); ++p) {
    const StageCharacter::Part& part = character.parts[p];
    const DetailLevel::Part& detail = character.detail.levels[chosen].parts[p];
    if (detail.index_count == 0) continue;
    const std::size_t first = positions.size();
    const std::size_t count = detail.vertex_count;
    positions.resize(first + count);
    normals.resize(first + count);
    part.mesh.Skin(palette_, std::span(positions).subspan(first),
                   std::span(normals).subspan(first));
    if (!part.uvs.empty()) {
      uvs.resize(first, glm::vec2{0.0f});
      uvs.insert(uvs.end(), part.uvs.begin(),
                 part.uvs.begin() + static_cast<std::ptrdiff_t>(count));
    }

    const int material_index = source.parts[p].material;
    const bool has_material =
        material_index >= 0 && static_cast<std::size_t>(material_index) < source.materials.size();
    const Material material =
        has_material ? source.materials[static_cast<std::size_t>(material_index)] : Material{};
    Mesh mesh;
    mesh.character = shown.character.value;
    mesh.first_index = detail.first_index;
    mesh.index_count = detail.index_count;
    mesh.first_shadow_index = detail.first_shadow_index;
    mesh.shadow_index_count = detail.shadow_index_count;
    mesh.first_vertex = static_cast<std::uint32_t>(first);
    mesh.color = material.base_color * glm::vec4(shown.tint, shown.opacity);
    mesh.image = part.uvs.empty() ? -1 : material.base_color_image;
    mesh.alpha_cutoff = material.alpha_mask ? material.alpha_cutoff * shown.opacity : 0.0f;
    mesh.double_sided = material.double_sided;
    mesh.mirrored = part.mesh.IsMirrored(palette_);
    if (!material.blend) mesh.color.a = shown.opacity;
    if (material.blend) {
      mesh.alpha_cutoff = 0.02f;
      blended.push_back(mesh);
    } else {
      meshes.push_back(mesh);
    }
  }
  End(solid, eye, first_vertex);
  if (!blended.empty()) {
    Group thin = Begin(Pass::kTranslucent, figure);
    thin.hides_itself = false;
    thin.casts_shadow = false;
    meshes.insert(meshes.end(), blended.begin(), blended.end());
    End(thin, eye, first_vertex);
  }

  std::array<Vec3, 4> feet;
  std::size_t count = 0;
  for (const J joint : {J::kLeftFoot, J::kRightFoot, J::kLeftToes, J::kRightToes}) {
    const int node = source.map.Node(joint);
    if (node < 0 || static_cast<std::size_t>(node) >= shown.node_global.size()) continue;
    feet[count++] = Vec3(shown.node_global[static_cast<std::size_t>(node)][3]);
  }
  AddFeet(figure, std::span(feet).first(count));
}

void DrawList::AddSurface(const Figure& figure, const Vec3& eye) {
  const SurfacePart& shown = *figure.surface;
  const bool overlay = shown.through || figure.character.has_value();
  const Pass pass = shown.through            ? Pass::kThrough
                    : shown.opacity < 0.999f ? Pass::kTranslucent
                                             : Pass::kOpaque;
  Group group = Begin(pass, figure);
  group.casts_shadow = !overlay;
  TriangleSink sink = NewMesh(Smallest(shown.pose->position_ws, figure, eye));
  const std::size_t first_index = indices.size();
  AppendBody(*shown.body, *shown.pose, figure.offset_ws,
             shown.through ? CrudeLook::kFacets : CrudeLook::kRounded, sink);
  AddMesh(sink, first_index, glm::vec4(Linear(shown.color), std::clamp(shown.opacity, 0.0f, 1.0f)));
  End(group, eye, sink.first_vertex);
  if (overlay) return;
  const std::array<Vec3, 4> feet = {
      shown.pose->Position(J::kLeftFoot), shown.pose->Position(J::kRightFoot),
      shown.pose->Position(J::kLeftToes), shown.pose->Position(J::kRightToes)};
  AddFeet(figure, feet);
}

void DrawList::AddSkeleton(const Figure& figure, const Vec3& eye) {
  const SkeletonPart& shown = *figure.skeleton;
  Group group = Begin(shown.through ? Pass::kThrough : Pass::kOpaque, figure);
  group.casts_shadow = !figure.character && !figure.surface;
  TriangleSink sink = NewMesh(Smallest(shown.pose->position_ws, figure, eye));
  const std::size_t first_index = indices.size();
  AppendSkeleton(*shown.skeleton, *shown.pose, figure.offset_ws, sink);
  AddMesh(sink, first_index, glm::vec4(Linear(shown.color), 1.0f));
  End(group, eye, sink.first_vertex);
  if (!group.casts_shadow) return;
  const std::array<Vec3, 4> feet = {
      shown.pose->Position(J::kLeftFoot), shown.pose->Position(J::kRightFoot),
      shown.pose->Position(J::kLeftToes), shown.pose->Position(J::kRightToes)};
  AddFeet(figure, feet);
}

void DrawList::AddMarkers(const Figure& figure, const Vec3& eye) {
  const MarkerPart& shown = *figure.markers;
  Group group = Begin(Pass::kOpaque, figure);
  group.rim = {};
  TriangleSink sink = NewMesh(Smallest(shown.frame.position_ws, figure, eye));
  const std::size_t first_index = indices.size();
  const std::size_t n = std::min(shown.frame.position_ws.size(), shown.frame.visible.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (shown.frame.visible[i] == 0) continue;
    const Vec3 at = shown.frame.position_ws[i] + figure.offset_ws;
    AppendCapsule(at, shown.radius, at, shown.radius, Roundness::kBone, sink);
  }
  // Lighter than the surface they lie on, as what throws the light back is.
  AddMesh(sink, first_index,
          glm::vec4(glm::mix(Linear(shown.color), glm::vec3{1.0f}, 0.35f), 1.0f));
  End(group, eye, sink.first_vertex);
}

void DrawList::AddFeet(const Figure& figure, std::span<const Vec3> points_ws) {
  for (const Vec3& p : points_ws) {
    const double near = std::clamp(1.0 - (p.y - 0.1) / 0.35, 0.0, 1.0);
    if (near <= 0.0) continue;
    const Vec3 at = OnGround(p + figure.offset_ws) + Vec3{0.0, 0.002, 0.0};
    contact_shadows.push_back({glm::vec4(glm::vec3(at), 0.24f),
                               glm::vec4(0.0f, 0.0f, 0.0f, static_cast<float>(0.42 * near))});
  }
}

void DrawList::AddPlate(const Figure& figure, const CharacterStore& characters,
                        const Camera& camera) {
  Vec3 at{0.0};
  if (figure.plate_ws) {
    at = *figure.plate_ws;
  } else if (figure.surface && figure.surface->pose != nullptr) {
    at = figure.surface->pose->Position(J::kHips);
  } else if (figure.skeleton && figure.skeleton->pose != nullptr) {
    at = figure.skeleton->pose->Position(J::kHips);
  } else if (IsUsable(figure.character, characters)) {
    const StageCharacter& character = characters.at(figure.character->character.value);
    const int hips = std::max(0, character.character.map.Node(J::kHips));
    if (!figure.character->node_global.empty()) {
      const auto node = static_cast<std::size_t>(hips) < figure.character->node_global.size()
                            ? static_cast<std::size_t>(hips)
                            : 0u;
      at = Vec3(figure.character->node_global[node][3]);
    }
  } else if (figure.markers) {
    Box3 box;
    const MarkerFrame& frame = figure.markers->frame;
    for (std::size_t i = 0; i < std::min(frame.position_ws.size(), frame.visible.size()); ++i) {
      if (frame.visible[i] != 0) box.Add(frame.position_ws[i]);
    }
    if (!box.IsEmpty()) at = box.Center();
  }
  // In front of the toes, as seen from the camera.
  Vec3 toward = OnGround(camera.Position() - camera.target_ws);
  const double length = glm::length(toward);
  toward = length > 1e-6 ? toward / length : -OnGround(camera.Up());
  plates.push_back({figure.name, figure.color,
                    OnGround(at + figure.offset_ws) + (figure.plate_ws ? 0.0 : 0.38) * toward});
}

}  // namespace ego
