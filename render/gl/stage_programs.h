// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/result.h"
#include "render/gl/program.h"

namespace ego::gl {

/// Every program that the stage is drawn with.
struct StagePrograms {
  Program body, body_textured;
  Program depth, depth_textured;
  Program ground, ground_shadowed, room, spot, plate, edge;

  /// The sentence names the shader's file and line.
  static Result<StagePrograms> Build();
};

}  // namespace ego::gl
