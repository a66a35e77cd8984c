// SPDX-License-Identifier: MIT
#include "render/stage_renderer.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <epoxy/gl.h>

#include "render/draw_list.h"
#include "render/gl/stage_painter.h"
#include "render/gl/surface.h"

namespace ego {
struct StageRenderer::Impl {
  gl::StagePainter painter;
  gl::ColorTarget multisampled, plain;
  gl::CharacterBufferStore character_buffers;
  CharacterStore characters;
  std::uint32_t next_id = 1;
  DrawList bounds_list;
  int samples = 0;
  bool is_software = false;

  explicit Impl(gl::StagePainter made) : painter(std::move(made)) {}
};

namespace {

bool DrawsOnProcessor() {
  const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view name = driver != nullptr ? driver : "";
  return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos ||
         name.find("swrast") != name.npos;
}

}  // namespace

Result<StageRenderer> StageRenderer::Create(const Options& options) {
  const int version = epoxy_gl_version();
  if (version < 33) {
    return Error{"The graphics driver offers OpenGL " + std::to_string(version / 10) + "." +
                 std::to_string(version % 10) + "; 3.3 is needed."};
  }
  const bool is_software = DrawsOnProcessor();
  const int shadow_map_size =
      options.shadow_map_size > 0 ? options.shadow_map_size : (is_software ? 1024 : 2048);
  Result<gl::StagePainter> painter =
      gl::StagePainter::Create(options.font, shadow_map_size, options.coarseness);
  if (!painter) return Error{painter.error()};
  auto impl = std::make_unique<Impl>(*std::move(painter));
  impl->is_software = is_software;
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
  std::vector<std::uint32_t>& indices = prepared.detail.indices;
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
               indices.data(), GL_STATIC_DRAW);
  indices = {};
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

  impl_->painter.Prepare(view, target.height, impl_->characters, impl_->character_buffers);
  if (impl_->samples > 1 &&
      impl_->multisampled.Resize(target.width, target.height, impl_->samples)) {
    DrawTarget own = target;
    own.framebuffer = impl_->multisampled.Name();
    own.x = own.y = 0;
    impl_->painter.DrawScene(view, own);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, own.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glBlitFramebuffer(0, 0, target.width, target.height, target.x, target.y,
                      target.x + target.width, target.y + target.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  } else {
    impl_->painter.DrawScene(view, target);
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

}  // namespace ego
