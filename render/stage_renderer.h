// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/model/character.h"
#include "render/stage_view.h"

namespace ego {

/// Draws the stage: a calm dark room in which bodies are lit. Needs a current OpenGL 3.3 core
/// context on the calling thread from Create to the end; owns neither it nor a window, and reads
/// no file and no clock.
class StageRenderer {
 public:
  struct Options {
    /// Bytes of a TrueType or OpenType font for name plates. Empty or unreadable: a plain
    /// built-in face stands in.
    std::span<const std::uint8_t> font;
    int samples = 0;          // of multisampling; 0 or 1: none. Clamped to what the driver has
    int shadow_map_size = 0;  // texels across; 0: what suits the driver
    /// Pixels by which a body's surface may be off: meshes are as coarse as that allows. 0: all
    /// are drawn as loaded.
    float coarseness = 0.0f;
  };
  /// The sentence names the shader's file and line, or what the context lacks.
  static Result<StageRenderer> Create(const Options& options);

  StageRenderer(StageRenderer&&) noexcept;
  StageRenderer& operator=(StageRenderer&&) noexcept;
  ~StageRenderer();

  /// Uploads a character once. The renderer keeps its own copy of what it needs.
  CharacterId Load(const Character& character);
  /// Unknown ids are ignored.
  void Unload(CharacterId id);

  /// True when the driver draws on the processor (Mesa's llvmpipe), where every pixel costs:
  /// better without multisampling while things move.
  bool IsSoftware() const;
  void SetSamples(int samples);
  int Samples() const;

  /// Draws into the target's rectangle and touches no pixel outside it. Afterwards the target's
  /// framebuffer is bound; blending, depth and scissor tests and culling are off. An empty
  /// rectangle draws nothing.
  void Draw(const StageView& view, const DrawTarget& target);
  /// Draws into a picture of its own and returns it. Empty where width or height is not positive
  /// or beyond what the driver can draw.
  Image DrawImage(const StageView& view, int width, int height, float content_scale = 1.0f);

  /// The box around everything the figures show (offsets included, plates not), for
  /// Camera::Frame. Empty for an empty stage.
  Box3 Bounds(std::span<const Figure> figures);

 private:
  struct Impl;
  explicit StageRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ego
