// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "render/draw_list.h"
#include "render/gl/stage_buffers.h"
#include "render/gl/stage_programs.h"
#include "render/gl/surface.h"
#include "render/plate_layout.h"
#include "render/stage_view.h"
#include "render/text_atlas.h"

namespace ego::gl {

using CharacterBufferStore = std::map<std::uint32_t, CharacterBuffers>;

/// Draws a StageView in passes: shadow map, opaque bodies, floor and room behind them, what is
/// seen through from far to near, what is drawn over everything, glows and name plates.
class StagePainter {
 public:
  /// `shadow_map_size`: texels across; `coarseness`: pixels by which surfaces may be off. The
  /// sentence tells what the context lacks.
  static Result<StagePainter> Create(std::span<const std::uint8_t> font, int shadow_map_size,
                                     float coarseness);

  /// Poses and uploads what the view shows in a picture of this height and draws the shadow map.
  /// Characters and their buffers
  /// are used until DrawScene has returned.
  void Prepare(const StageView& view, int height, const CharacterStore& characters,
               const CharacterBufferStore& character_buffers);
  /// Draws what was prepared into the target's rectangle.
  void DrawScene(const StageView& view, const DrawTarget& target);

 private:
  explicit StagePainter(std::span<const std::uint8_t> font) : atlas_(font) {}

  enum class Draws { kLit, kDepth, kShadow };
  void DrawShadows();
  void DrawGroup(const DrawList::Group& group, Draws draws, const glm::mat4& clip);
  void DrawGroups(Pass pass);
  void DrawEdges();
  void UploadFloor(const Vec3& low, const Vec3& high);
  void DrawFloorAndRoom(const StageView& view, const DrawTarget& target);
  void DrawGlows(const Camera& camera);
  void DrawPlates(const StageView& view, const DrawTarget& target);
  void SetLight(const Program& program) const;
  const CharacterBuffers* BuffersOf(std::uint32_t character) const;
  GLuint ImageOf(const DrawList::Mesh& mesh) const;

  StagePrograms programs_;
  StageBuffers buffers_;
  ShadowTarget shadow_;
  int shadow_map_size_ = 0;
  float coarseness_ = 0.0f;
  TextAtlas atlas_;

  // Of the picture being drawn.
  const CharacterBufferStore* character_buffers_ = nullptr;
  DrawList list_;
  std::vector<PlateVertex> plate_vertices_;
  glm::mat4 view_projection_{1.0f};
  glm::mat4 shadow_matrix_{1.0f};
  glm::vec3 eye_{0.0f};
  bool shadows_ = false;
};

}  // namespace ego::gl
