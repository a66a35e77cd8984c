// SPDX-License-Identifier: MIT
#include "render/stage_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "render/gl/program.h"
#include "render/gl/stage_buffers.h"
#include "render/gl/surface.h"
#include "render/key_light.h"

namespace ego {
namespace {

constexpr double kGroundReach = 45.0;   // metres; the floor has faded before
constexpr double kLargestStage = 40.0;  // metres; what lies beyond has no shadow
constexpr float kVignette = 0.30f;      // darkening in the corners
constexpr int kShadowUnit = 1;
constexpr float kFloorInShadow = 0.42f;  // of the light that the floor and its lines keep
constexpr float kLineInShadow = 0.35f;

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

struct StageRenderer::Impl {
  gl::Program body, body_textured;
  gl::Program depth, depth_textured;
  gl::Program ground, ground_shadowed, room, spot, plate;
  gl::StageBuffers buffers;
  gl::ShadowTarget shadow;
  gl::ColorTarget multisampled, plain;
  std::map<std::uint32_t, gl::CharacterBuffers> character_buffers;
  CharacterStore characters;
  std::uint32_t next_id = 1;
  TextAtlas atlas;
  std::vector<PlateVertex> plate_vertices;
  DrawList list;
  DrawList bounds_list;
  int samples = 0;
  int shadow_map_size = 1024;
  bool is_software = false;

  // Of the picture being drawn.
  glm::mat4 view_projection{1.0f};
  glm::mat4 shadow_matrix{1.0f};
  glm::vec3 eye{0.0f};
  bool shadows = false;

  explicit Impl(const Options& options) : atlas(options.font) {}

  const gl::CharacterBuffers* BuffersOf(std::uint32_t character) const {
    const auto it = character_buffers.find(character);
    return it != character_buffers.end() ? &it->second : nullptr;
  }
  GLuint ImageOf(const DrawList::Mesh& mesh) const {
    const gl::CharacterBuffers* c = BuffersOf(mesh.character);
    if (c == nullptr || mesh.image < 0) return 0;
    const auto image = static_cast<std::size_t>(mesh.image);
    return image < c->images.size() ? c->images[image].Name() : 0u;
  }

  void Prepare(const StageView& view);
  void DrawShadows();
  void DrawScene(const StageView& view, const DrawTarget& target);
  enum class Draws { kLit, kDepth, kShadow };
  void DrawGroup(const DrawList::Group& group, Draws draws, const glm::mat4& clip);
  void DrawGroups(Pass pass);
  void DrawFloorAndRoom(const StageView& view, const DrawTarget& target);
  void DrawGlows(const Camera& camera);
  void DrawPlates(const StageView& view, const DrawTarget& target);
  void SetLight(const gl::Program& program) const;
};

void StageRenderer::Impl::SetLight(const gl::Program& program) const {
  program.Use();
  program.Set("view_projection", view_projection);
  program.Set("shadow_matrix", shadow_matrix);
  program.Set("shadow_map", kShadowUnit);
  program.Set("shadow_strength", shadows ? 1.0f : 0.0f);
  program.Set("shadow_texel", glm::vec2(1.0f / static_cast<float>(shadow_map_size),
                                        2.0f / static_cast<float>(shadow_map_size)));
  program.Set("key_direction", glm::vec3(KeyDirection()));
  program.Set("camera_position", eye);
}

void StageRenderer::Impl::Prepare(const StageView& view) {
  list.Build(view, characters);
  buffers.Upload(list);
  eye = glm::vec3(view.camera.Position());
  Box3 box = list.bounds;
  if (!box.IsEmpty()) {
    const Vec3 middle = view.camera.target_ws;
    box.min = glm::clamp(box.min, middle - kLargestStage, middle + kLargestStage);
    box.max = glm::clamp(box.max, middle - kLargestStage, middle + kLargestStage);
  }
  shadows =
      view.shadows && !list.groups.empty() && shadow.Resize(shadow_map_size, shadow_map_size / 2);
  if (!shadows) return;
  const Mat4 light = LightMatrix(box);
  const Mat4 to_texture = glm::translate(Mat4{1.0}, Vec3{0.5}) * glm::scale(Mat4{1.0}, Vec3{0.5});
  shadow_matrix = glm::mat4(to_texture * light);
  DrawShadows();
}

void StageRenderer::Impl::DrawShadows() {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow.Name());
  glViewport(0, 0, shadow_map_size, shadow_map_size / 2);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 3.0f);
  const glm::mat4 from_texture = glm::scale(glm::mat4{1.0f}, glm::vec3{2.0f}) *
                                 glm::translate(glm::mat4{1.0f}, glm::vec3{-0.5f});
  const glm::mat4 light = from_texture * shadow_matrix;
  for (const DrawList::Group& group : list.groups) {
    if (group.casts_shadow) DrawGroup(group, Draws::kShadow, light);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void StageRenderer::Impl::DrawGroup(const DrawList::Group& group, Draws draws,
                                    const glm::mat4& clip) {
  const bool depth_only = draws != Draws::kLit;
  for (std::uint32_t i = 0; i < group.mesh_count; ++i) {
    const DrawList::Mesh& mesh = list.meshes[group.first_mesh + i];
    const GLuint image = ImageOf(mesh);
    const bool textured = image != 0 && (!depth_only || mesh.alpha_cutoff > 0.0f);
    const gl::Program& program =
        depth_only ? (textured ? depth_textured : depth) : (textured ? body_textured : body);
    program.Use();
    program.Set("view_projection", clip);
    program.Set("color", mesh.color);
    if (!depth_only) {
      program.Set("rim", group.rim);
      program.Set("shadow_strength", shadows && group.casts_shadow ? 1.0f : 0.0f);
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
    buffers.DrawMesh(mesh, draws == Draws::kShadow, BuffersOf(mesh.character));
  }
}

void StageRenderer::Impl::DrawGroups(Pass pass) {
  for (const DrawList::Group& group : list.groups) {
    if (group.pass != pass) continue;
    if (pass != Pass::kOpaque && group.hides_itself) {
      // Its own depth first: what is seen through is the nearest skin only, not the inside.
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      DrawGroup(group, Draws::kDepth, view_projection);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    glDepthMask(group.hides_itself ? GL_TRUE : GL_FALSE);
    DrawGroup(group, Draws::kLit, view_projection);
    glDepthMask(GL_TRUE);
  }
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CCW);
}

void StageRenderer::Impl::DrawFloorAndRoom(const StageView& view, const DrawTarget& target) {
  const glm::vec2 center(static_cast<float>(target.x) + 0.5f * static_cast<float>(target.width),
                         static_cast<float>(target.y) + 0.5f * static_cast<float>(target.height));
  const glm::vec2 half(0.5f * static_cast<float>(target.width),
                       0.5f * static_cast<float>(target.height));
  const float vignette = kVignette / glm::dot(half, half);

  if (view.grid) {
    Box3 box = list.bounds;
    if (box.IsEmpty()) box.Add(Vec3{0.0});
    const Vec3 extent = glm::min(box.max - box.min, Vec3{kLargestStage});
    const Vec3 reach{kGroundReach};
    const Box3 shaded = ShadowOnGround(box);
    const Vec3 low = view.camera.target_ws - reach, high = view.camera.target_ws + reach;
    const Vec3 inner_low = glm::clamp(shaded.min - 0.05, low, high);
    const Vec3 inner_high = glm::clamp(shaded.max + 0.05, low, high);
    const auto lines = [&](int axis) {
      return std::array<float, 4>{
          static_cast<float>(low[axis]), static_cast<float>(inner_low[axis]),
          static_cast<float>(inner_high[axis]), static_cast<float>(high[axis])};
    };
    buffers.UploadFloor(lines(0), lines(2));
    const glm::vec3 floor_dark = Encoded(kFloorInShadow * Linear(look::kFloor));
    const glm::vec3 line_dark = Encoded(kLineInShadow * Linear(look::kGrid));
    glEnable(GL_CULL_FACE);  // from below the floor is glass
    for (const bool middle : {true, false}) {
      const gl::Program& program = middle && shadows ? ground_shadowed : ground;
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
      buffers.DrawFloor(middle);
    }

    if (view.shadows) {
      glEnable(GL_BLEND);
      glDepthMask(GL_FALSE);
      spot.Use();
      spot.Set("view_projection", view_projection);
      spot.Set("axis_x", glm::vec3{1.0f, 0.0f, 0.0f});
      spot.Set("axis_y", glm::vec3{0.0f, 0.0f, -1.0f});
      buffers.DrawSpots(false);
      glDepthMask(GL_TRUE);
      glDisable(GL_BLEND);
    }
  }
  glDisable(GL_CULL_FACE);
  room.Use();
  room.Set("room_color", look::kRoom);
  room.Set("picture_center", center);
  room.Set("vignette", vignette);
  buffers.DrawSquare();
}

void StageRenderer::Impl::DrawGlows(const Camera& camera) {
  glDisable(GL_CULL_FACE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE);
  glDepthMask(GL_FALSE);
  // A contact lies between two skins: it shines through them.
  glDisable(GL_DEPTH_TEST);
  spot.Use();
  spot.Set("view_projection", view_projection);
  spot.Set("axis_x", glm::vec3(camera.Right()));
  spot.Set("axis_y", glm::vec3(camera.Up()));
  buffers.DrawSpots(true);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

void StageRenderer::Impl::DrawPlates(const StageView& view, const DrawTarget& target) {
  plate_vertices.clear();
  LayoutPlates(list.plates, view.camera, {target.width, target.height}, target.content_scale, atlas,
               plate_vertices);
  if (plate_vertices.empty()) return;
  buffers.UploadPlates(plate_vertices, atlas);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glBindTexture(GL_TEXTURE_2D, buffers.GlyphTexture());
  plate.Use();
  plate.Set("glyphs", 0);
  buffers.DrawPlates();
  glDepthMask(GL_TRUE);
}

void StageRenderer::Impl::DrawScene(const StageView& view, const DrawTarget& target) {
  const ViewportSize size{target.width, target.height};
  view_projection = glm::mat4(view.camera.Projection(size) * view.camera.View());
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glViewport(target.x, target.y, target.width, target.height);
  glScissor(target.x, target.y, target.width, target.height);
  glEnable(GL_SCISSOR_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);

  glActiveTexture(GL_TEXTURE0 + kShadowUnit);
  glBindTexture(GL_TEXTURE_2D, shadow.DepthTexture());
  glActiveTexture(GL_TEXTURE0);
  for (const gl::Program* program : {&body, &body_textured}) SetLight(*program);

  DrawGroups(Pass::kOpaque);
  DrawFloorAndRoom(view, target);
  glEnable(GL_BLEND);
  DrawGroups(Pass::kTranslucent);
  glDepthRange(0.0, 0.02);
  DrawGroups(Pass::kThrough);
  glDepthRange(0.0, 1.0);
  DrawGlows(view.camera);
  if (view.name_plates) DrawPlates(view, target);
}

Result<StageRenderer> StageRenderer::Create(const Options& options) {
  const int version = epoxy_gl_version();
  if (version < 33) {
    return Error{"The graphics driver offers OpenGL " + std::to_string(version / 10) + "." +
                 std::to_string(version % 10) + "; 3.3 is needed."};
  }
  auto impl = std::make_unique<Impl>(options);
  struct Recipe {
    gl::Program* program;
    const char* vertex;
    const char* fragment;
    std::string_view define;
  };
  const std::array<Recipe, 9> recipes = {{
      {&impl->body, "body.vert", "body.frag", {}},
      {&impl->body_textured, "body.vert", "body.frag", "TEXTURED"},
      {&impl->depth, "depth.vert", "depth.frag", {}},
      {&impl->depth_textured, "depth.vert", "depth.frag", "TEXTURED"},
      {&impl->ground, "ground.vert", "ground.frag", {}},
      {&impl->ground_shadowed, "ground.vert", "ground.frag", "SHADOWED"},
      {&impl->room, "room.vert", "room.frag", {}},
      {&impl->spot, "spot.vert", "spot.frag", {}},
      {&impl->plate, "plate.vert", "plate.frag", {}},
  }};
  for (const Recipe& r : recipes) {
    Result<gl::Program> built =
        gl::Program::Build(r.vertex, r.fragment, std::span(&r.define, r.define.empty() ? 0u : 1u));
    if (!built) return Error{built.error()};
    *r.program = std::move(*built);
  }
  impl->buffers.Create();
  const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view name = driver != nullptr ? driver : "";
  impl->is_software = name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos ||
                      name.find("swrast") != name.npos;
  const int wanted =
      options.shadow_map_size > 0 ? options.shadow_map_size : (impl->is_software ? 1024 : 2048);
  impl->shadow_map_size = std::clamp(wanted, 256, 8192);
  // Shaders always have a map to look at, also when shadows are off.
  if (!impl->shadow.Resize(impl->shadow_map_size, impl->shadow_map_size / 2)) {
    return Error{"The graphics driver cannot draw into a depth texture; shadows need one."};
  }
  StageRenderer renderer(std::move(impl));
  renderer.SetSamples(options.samples);
  return renderer;
}

StageRenderer::StageRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StageRenderer::StageRenderer(StageRenderer&&) noexcept = default;
StageRenderer& StageRenderer::operator=(StageRenderer&&) noexcept = default;
StageRenderer::~StageRenderer() = default;

CharacterId StageRenderer::Load(const Character& character) {
  const std::uint32_t id = impl_->next_id++;
  StageCharacter prepared = PrepareCharacter(character);
  gl::CharacterBuffers& buffers = impl_->character_buffers[id];
  buffers.indices = gl::Buffer::Make();
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, buffers.indices.Name());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(prepared.indices.size() * sizeof(std::uint32_t)),
               prepared.indices.data(), GL_STATIC_DRAW);
  prepared.indices.clear();
  prepared.indices.shrink_to_fit();
  for (const Image& image : character.images) {
    buffers.images.push_back(gl::MakeColorTexture(image));
  }
  impl_->characters.emplace(id, std::move(prepared));
  return CharacterId{id};
}

void StageRenderer::Unload(CharacterId id) {
  impl_->characters.erase(id.value);
  impl_->character_buffers.erase(id.value);
}

bool StageRenderer::IsSoftware() const { return impl_->is_software; }

void StageRenderer::SetSamples(int samples) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &limit);
  impl_->samples = std::clamp(samples, 0, static_cast<int>(limit));
}
int StageRenderer::Samples() const { return impl_->samples; }

void StageRenderer::Draw(const StageView& view, const DrawTarget& target) {
  if (target.width <= 0 || target.height <= 0) return;
  glActiveTexture(GL_TEXTURE0);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glCullFace(GL_BACK);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);

  impl_->Prepare(view);
  if (impl_->samples > 1 &&
      impl_->multisampled.Resize(target.width, target.height, impl_->samples)) {
    DrawTarget own = target;
    own.framebuffer = impl_->multisampled.Name();
    own.x = own.y = 0;
    impl_->DrawScene(view, own);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, own.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glBlitFramebuffer(0, 0, target.width, target.height, target.x, target.y,
                      target.x + target.width, target.y + target.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  } else {
    impl_->DrawScene(view, target);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
  glUseProgram(0);
}

Image StageRenderer::DrawImage(const StageView& view, int width, int height, float content_scale) {
  Image image;
  if (!impl_->plain.Resize(width, height, 0)) return image;
  Draw(view, {impl_->plain.Name(), 0, 0, width, height, content_scale});
  image.width = width;
  image.height = height;
  const std::size_t row = static_cast<std::size_t>(width) * 4u;
  image.rgba.resize(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (int y = 0; y < height / 2; ++y) {  // OpenGL's first row is the lowest
    auto* low = image.rgba.data() + static_cast<std::size_t>(y) * row;
    auto* high = image.rgba.data() + static_cast<std::size_t>(height - 1 - y) * row;
    std::swap_ranges(low, low + row, high);
  }
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

Box3 StageRenderer::Bounds(std::span<const Figure> figures) {
  StageView view;
  view.figures = figures;
  impl_->bounds_list.Build(view, impl_->characters);
  return impl_->bounds_list.bounds;
}

std::span<const glm::vec3> StageRenderer::SkinnedPositions(std::size_t figure,
                                                           std::size_t part) const {
  for (const DrawList::SkinnedRange& range : impl_->list.skinned) {
    if (range.figure == figure && range.part == part) {
      return std::span(impl_->list.positions).subspan(range.first_vertex, range.vertex_count);
    }
  }
  return {};
}

}  // namespace ego
