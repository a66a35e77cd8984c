// SPDX-License-Identifier: MIT
#include "render/gl/stage_painter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "render/key_light.h"

namespace ego::gl {
namespace {

constexpr double kGroundReach = 45.0;   // metres; the floor has faded before
constexpr double kLargestStage = 40.0;  // metres; what lies beyond has no shadow
constexpr float kVignette = 0.30f;      // darkening in the corners
constexpr int kShadowUnit = 1;
constexpr float kFloorInShadow = 0.42f;  // of the light that the floor and its lines keep
constexpr float kLineInShadow = 0.35f;
constexpr float kEdgeStrength = 0.55f;  // of a mesh's edges over its skin

// sRGB of linear light.
glm::vec3 Encoded(const glm::vec3& linear) {
  glm::vec3 srgb;
  for (int i = 0; i < 3; ++i) {
    srgb[i] = linear[i] <= 0.0031308f ? 12.92f * linear[i]
                                      : 1.055f * std::pow(linear[i], 1.0f / 2.4f) - 0.055f;
  }
  return srgb;
}

}  // namespace

Result<StagePainter> StagePainter::Create(std::span<const std::uint8_t> font, int shadow_map_size,
                                          float coarseness) {
  StagePainter painter(font);
  painter.coarseness_ = coarseness;
  Result<StagePrograms> programs = StagePrograms::Build();
  if (!programs) return Error{programs.error()};
  painter.programs_ = *std::move(programs);
  painter.buffers_.Create();
  painter.shadow_map_size_ = std::clamp(shadow_map_size, 256, 8192);
  // Shaders always have a map to look at, also when shadows are off.
  if (!painter.shadow_.Resize(painter.shadow_map_size_, painter.shadow_map_size_ / 2)) {
    return Error{"The graphics driver cannot draw into a depth texture; shadows need one."};
  }
  return painter;
}

const CharacterBuffers* StagePainter::BuffersOf(std::uint32_t character) const {
  const auto it = character_buffers_->find(character);
  return it != character_buffers_->end() ? &it->second : nullptr;
}

GLuint StagePainter::ImageOf(const DrawList::Mesh& mesh) const {
  const CharacterBuffers* c = BuffersOf(mesh.character);
  if (c == nullptr || mesh.image < 0) return 0;
  const auto image = static_cast<std::size_t>(mesh.image);
  return image < c->images.size() ? c->images[image].Name() : 0u;
}

void StagePainter::SetLight(const Program& program) const {
  program.Use();
  program.Set("view_projection", view_projection_);
  program.Set("shadow_matrix", shadow_matrix_);
  program.Set("shadow_map", kShadowUnit);
  program.Set("shadow_strength", shadows_ ? 1.0f : 0.0f);
  program.Set("shadow_texel", glm::vec2(1.0f / static_cast<float>(shadow_map_size_),
                                        2.0f / static_cast<float>(shadow_map_size_)));
  program.Set("key_direction", glm::vec3(KeyDirection()));
  program.Set("camera_position", eye_);
}

void StagePainter::Prepare(const StageView& view, int height, const CharacterStore& characters,
                           const CharacterBufferStore& character_buffers) {
  character_buffers_ = &character_buffers;
  list_.Build(view, characters, {coarseness_, 0.5 * height / std::tan(0.5 * view.camera.fov_y)});
  buffers_.Upload(list_);
  eye_ = glm::vec3(view.camera.Position());
  Box3 box = list_.bounds;
  if (!box.IsEmpty()) {
    const Vec3 middle = view.camera.target_ws;
    box.min = glm::clamp(box.min, middle - kLargestStage, middle + kLargestStage);
    box.max = glm::clamp(box.max, middle - kLargestStage, middle + kLargestStage);
  }
  shadows_ = view.shadows && !list_.groups.empty() &&
             shadow_.Resize(shadow_map_size_, shadow_map_size_ / 2);
  if (!shadows_) return;
  const Mat4 light = LightMatrix(box);
  const Mat4 to_texture = glm::translate(Mat4{1.0}, Vec3{0.5}) * glm::scale(Mat4{1.0}, Vec3{0.5});
  shadow_matrix_ = glm::mat4(to_texture * light);
  DrawShadows();
}

void StagePainter::DrawShadows() {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_.Name());
  glViewport(0, 0, shadow_map_size_, shadow_map_size_ / 2);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 3.0f);
  const glm::mat4 from_texture = glm::scale(glm::mat4{1.0f}, glm::vec3{2.0f}) *
                                 glm::translate(glm::mat4{1.0f}, glm::vec3{-0.5f});
  const glm::mat4 light = from_texture * shadow_matrix_;
  for (const DrawList::Group& group : list_.groups) {
    if (group.casts_shadow) DrawGroup(group, Draws::kShadow, light);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void StagePainter::DrawGroup(const DrawList::Group& group, Draws draws, const glm::mat4& clip) {
  const bool depth_only = draws != Draws::kLit;
  for (std::uint32_t i = 0; i < group.mesh_count; ++i) {
    const DrawList::Mesh& mesh = list_.meshes[group.first_mesh + i];
    const GLuint image = ImageOf(mesh);
    const bool textured = image != 0 && (!depth_only || mesh.alpha_cutoff > 0.0f);
    const Program& program = depth_only ? (textured ? programs_.depth_textured : programs_.depth)
                                        : (textured ? programs_.body_textured : programs_.body);
    program.Use();
    program.Set("view_projection", clip);
    program.Set("color", mesh.color);
    if (!depth_only) {
      program.Set("rim", group.rim);
      program.Set("shadow_strength", shadows_ && group.casts_shadow ? 1.0f : 0.0f);
    }
    if (textured) {
      glBindTexture(GL_TEXTURE_2D, image);
      program.Set("base_map", 0);
      program.Set("base_alpha", mesh.color.a);
      program.Set("alpha_cutoff", mesh.alpha_cutoff);
    }
    if (mesh.double_sided) {
      glDisable(GL_CULL_FACE);
    } else {
      glEnable(GL_CULL_FACE);
    }
    glFrontFace(mesh.mirrored ? GL_CW : GL_CCW);
    buffers_.DrawMesh(mesh, draws == Draws::kShadow, BuffersOf(mesh.character));
  }
}

void StagePainter::DrawGroups(Pass pass) {
  for (const DrawList::Group& group : list_.groups) {
    if (group.pass != pass) continue;
    if (pass != Pass::kOpaque && group.hides_itself) {
      // Its own depth first: what is seen through is the nearest skin only, not the inside.
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      DrawGroup(group, Draws::kDepth, view_projection_);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    glDepthMask(group.hides_itself ? GL_TRUE : GL_FALSE);
    DrawGroup(group, Draws::kLit, view_projection_);
    glDepthMask(GL_TRUE);
  }
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CCW);
}

// Over the skin by a hair, so that edges behind it stay hidden and those on it are whole.
void StagePainter::DrawEdges() {
  programs_.edge.Use();
  programs_.edge.Set("view_projection", view_projection_);
  programs_.edge.Set("color", glm::vec4(look::kRoom, kEdgeStrength));
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(-1.0f, -2.0f);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  for (const DrawList::Group& group : list_.groups) {
    if (!group.edges) continue;
    for (std::uint32_t i = 0; i < group.mesh_count; ++i) {
      const DrawList::Mesh& mesh = list_.meshes[group.first_mesh + i];
      glFrontFace(mesh.mirrored ? GL_CW : GL_CCW);
      buffers_.DrawMesh(mesh, false, BuffersOf(mesh.character));
    }
  }
  glFrontFace(GL_CCW);
  glDepthMask(GL_TRUE);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

// Cells of the floor, and which of them lie in somebody's shadow: only they are worth looking up.
void StagePainter::UploadFloor(const Vec3& low, const Vec3& high) {
  constexpr std::array<std::size_t, 2> kCells = {24, 10};  // along x and z
  std::vector<Box3> shadows;
  Box3 all;
  for (const DrawList::Group& group : list_.groups) {
    if (!group.casts_shadow || group.box.IsEmpty()) continue;
    Box3& box = shadows.emplace_back(ShadowOnGround(group.box));
    box.min -= 0.05;
    box.max += 0.05;
    all.Add(box);
  }
  if (all.IsEmpty()) all.Add(Vec3{0.0});
  std::array<std::vector<float>, 2> lines;
  for (std::size_t i = 0; i < 2; ++i) {
    const int axis = i == 0 ? 0 : 2;
    const double from = glm::clamp(all.min[axis], low[axis], high[axis]);
    const double to = glm::clamp(all.max[axis], low[axis], high[axis]);
    lines[i].push_back(static_cast<float>(low[axis]));
    for (std::size_t k = 0; k <= kCells[i]; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(kCells[i]);
      lines[i].push_back(static_cast<float>(glm::mix(from, to, share)));
    }
    lines[i].push_back(static_cast<float>(high[axis]));
  }
  const auto& x = lines[0];
  const auto& z = lines[1];
  std::vector<std::uint8_t> shaded;
  for (std::size_t row = 0; row + 1 < z.size(); ++row) {
    for (std::size_t column = 0; column + 1 < x.size(); ++column) {
      shaded.push_back(std::any_of(shadows.begin(), shadows.end(), [&](const Box3& box) {
        return box.min.x < static_cast<double>(x[column + 1]) &&
               box.max.x > static_cast<double>(x[column]) &&
               box.min.z < static_cast<double>(z[row + 1]) &&
               box.max.z > static_cast<double>(z[row]);
      }));
    }
  }
  buffers_.UploadFloor(x, z, shaded);
}

void StagePainter::DrawFloorAndRoom(const StageView& view, const DrawTarget& target) {
  const glm::vec2 center(static_cast<float>(target.x) + 0.5f * static_cast<float>(target.width),
                         static_cast<float>(target.y) + 0.5f * static_cast<float>(target.height));
  const glm::vec2 half(0.5f * static_cast<float>(target.width),
                       0.5f * static_cast<float>(target.height));
  const float vignette = kVignette / glm::dot(half, half);

  if (view.grid) {
    Box3 box = list_.bounds;
    if (box.IsEmpty()) box.Add(Vec3{0.0});
    const Vec3 extent = glm::min(box.max - box.min, Vec3{kLargestStage});
    const Vec3 reach{kGroundReach};
    const Vec3 low = view.camera.target_ws - reach, high = view.camera.target_ws + reach;
    UploadFloor(low, high);
    const glm::vec3 floor_dark = Encoded(kFloorInShadow * Linear(look::kFloor));
    const glm::vec3 line_dark = Encoded(kLineInShadow * Linear(look::kGrid));
    glEnable(GL_CULL_FACE);  // from below the floor is glass
    for (const bool shaded : {true, false}) {
      const Program& program = shaded && shadows_ ? programs_.ground_shadowed : programs_.ground;
      SetLight(program);
      program.Set("room_color", look::kRoom);
      program.Set("floor_dark", floor_dark);
      program.Set("floor_gain", look::kFloor - floor_dark);
      program.Set("line_dark", line_dark);
      program.Set("line_gain", look::kGrid - line_dark);
      program.Set("pool_center", glm::vec3(box.Center()));
      program.Set("pool_radius", static_cast<float>(3.0 + 0.7 * std::max(extent.x, extent.z)));
      program.Set("grid_strength", 0.8f);
      program.Set("picture_center", center);
      program.Set("vignette", vignette);
      buffers_.DrawFloor(shaded);
    }

    if (view.shadows) {
      glEnable(GL_BLEND);
      glDepthMask(GL_FALSE);
      programs_.spot.Use();
      programs_.spot.Set("view_projection", view_projection_);
      programs_.spot.Set("axis_x", glm::vec3{1.0f, 0.0f, 0.0f});
      programs_.spot.Set("axis_y", glm::vec3{0.0f, 0.0f, -1.0f});
      buffers_.DrawSpots(false);
      glDepthMask(GL_TRUE);
      glDisable(GL_BLEND);
    }
  }
  glDisable(GL_CULL_FACE);
  programs_.room.Use();
  programs_.room.Set("room_color", look::kRoom);
  programs_.room.Set("picture_center", center);
  programs_.room.Set("vignette", vignette);
  buffers_.DrawSquare();
}

void StagePainter::DrawGlows(const Camera& camera) {
  glDisable(GL_CULL_FACE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE);
  glDepthMask(GL_FALSE);
  // A contact lies between two skins: it shines through them.
  glDisable(GL_DEPTH_TEST);
  programs_.spot.Use();
  programs_.spot.Set("view_projection", view_projection_);
  programs_.spot.Set("axis_x", glm::vec3(camera.Right()));
  programs_.spot.Set("axis_y", glm::vec3(camera.Up()));
  buffers_.DrawSpots(true);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void StagePainter::DrawPlates(const StageView& view, const DrawTarget& target) {
  plate_vertices_.clear();
  LayoutPlates(list_.plates, view.camera, {target.width, target.height}, target.content_scale,
               atlas_, plate_vertices_);
  if (plate_vertices_.empty()) return;
  buffers_.UploadPlates(plate_vertices_, atlas_);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glBindTexture(GL_TEXTURE_2D, buffers_.GlyphTexture());
  programs_.plate.Use();
  programs_.plate.Set("glyphs", 0);
  buffers_.DrawPlates();
  glDepthMask(GL_TRUE);
}

void StagePainter::DrawScene(const StageView& view, const DrawTarget& target) {
  const ViewportSize size{target.width, target.height};
  view_projection_ = glm::mat4(view.camera.Projection(size) * view.camera.View());
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glViewport(target.x, target.y, target.width, target.height);
  glScissor(target.x, target.y, target.width, target.height);
  glEnable(GL_SCISSOR_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);

  glActiveTexture(GL_TEXTURE0 + kShadowUnit);
  glBindTexture(GL_TEXTURE_2D, shadow_.DepthTexture());
  glActiveTexture(GL_TEXTURE0);
  for (const Program* program : {&programs_.body, &programs_.body_textured}) SetLight(*program);

  DrawGroups(Pass::kOpaque);
  DrawFloorAndRoom(view, target);
  glEnable(GL_BLEND);
  DrawGroups(Pass::kTranslucent);
  DrawEdges();
  glDepthRange(0.0, 0.02);
  DrawGroups(Pass::kThrough);
  glDepthRange(0.0, 1.0);
  DrawGlows(view.camera);
  if (view.name_plates) DrawPlates(view, target);
}

}  // namespace ego::gl
